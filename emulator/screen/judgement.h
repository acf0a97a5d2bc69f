#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/machine/sim_time.h"

namespace fauxboard::screen {

using machine::SimTime;

/// What a screen makes of a line, from harmless to fatal.
enum class Verdict : std::uint8_t {
    ok,            ///< taken as it was meant
    ignored,       ///< the screen does nothing with it
    part_missed,   ///< keys that stand on the line are not found, because of their order or of one missing
    cut,           ///< a text or the line is longer than the screen's room for it
    rest_dropped,  ///< a value out of bounds: it and what follows is not taken
    misread,       ///< taken, but as something else than was meant
    restarts,      ///< the screen starts anew, for it is told to
    timed_out,     ///< no line: what the screen waits for does not come, and it gives up waiting
    runs_ahead,  ///< an acknowledgement too many: the screen no longer waits for the answer that it thinks of
    stalls,      ///< the screen waits for something else and does not react to touches until it comes
    jams,        ///< the screen never reads again
    would_crash,  ///< the screen's processor faults and the screen starts anew
};

inline constexpr std::size_t verdict_count = 12;

/// "ok", "ignored", "part missed", "cut", "rest dropped", "misread", "restarts", "timed out", "runs ahead",
/// "stalls", "jams", "would crash".
std::string_view verdict_words(Verdict verdict);

/// A value that a line set, as it was then.
struct Carried {
    std::size_t value = 0;
    double number = 0;
    std::string text;
};

/// One received line, judged.
struct Judgement {
    std::uint64_t number = 0;  ///< counts received lines from 1
    SimTime at{0};             ///< when the screen took it up
    std::string line;          ///< as received, line end left off
    std::string frame;         ///< "L3", "M2121 start:"; empty where the screen sees none
    Verdict verdict = Verdict::ok;
    std::string why;               ///< why, unless ok; several reasons are parted by "; "
    std::vector<Carried> carried;  ///< the values it set, in the order of the line

    /// "L18 P26 S15: would crash: the page table ends at 14"
    std::string sentence() const;
};

/// One kind of finding, with the line that showed it first.
struct Finding {
    Judgement first;
    std::uint64_t times = 0;
};

}  // namespace fauxboard::screen
