#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "emulator/screen/judgement.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::screen {

/// A line as the screen took it.
struct Taken {
    Judgement judgement;                ///< number and time are left to the caller
    std::vector<const FrameCase*> how;  ///< the rules that took it; none when it was ignored

    bool restarts() const {
        return judgement.verdict == Verdict::would_crash ||
               std::any_of(how.begin(), how.end(), [](const FrameCase* one) { return one->restarts; });
    }
};

/// Reads one line (line end left off, no NUL in it) into `values`, with the search order, number readers and
/// limits of the profile, and says what became of it. Any bytes are fine. What a line by itself makes the
/// screen assume goes into `values`, too.
Taken take_line(const ScreenProfile& profile, std::string_view line, std::vector<Shown>& values);

/// The same for a line as it was received: a NUL ends its text, and one that fills the receiving ring is
/// lost.
Taken take_received(const ScreenProfile& profile, std::string_view line, std::vector<Shown>& values);

}  // namespace fauxboard::screen
