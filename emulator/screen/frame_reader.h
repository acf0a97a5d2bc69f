#pragma once

#include <string_view>
#include <vector>

#include "emulator/screen/judgement.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::screen {

/// A line as the screen took it.
struct Taken {
    Judgement judgement;             ///< number and time are left to the caller
    const FrameCase* how = nullptr;  ///< the rule that took it; null when it was ignored
};

/// Reads one line (line end left off, no NUL in it) into `values`, with the search order, number readers and
/// limits of the profile, and says what became of it. Any bytes are fine.
Taken take_line(const ScreenProfile& profile, std::string_view line, std::vector<Shown>& values);

/// The same for a line as it was received: a NUL ends its text, and one that fills the receiving ring is
/// lost.
Taken take_received(const ScreenProfile& profile, std::string_view line, std::vector<Shown>& values);

}  // namespace fauxboard::screen
