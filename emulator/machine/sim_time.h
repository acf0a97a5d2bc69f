#pragma once

#include <chrono>

namespace fauxboard::machine {

/// Virtual time: microseconds since the world of one board began. The core never reads a clock; every time is
/// an argument. A board reset does not restart it (the heaters keep cooling), only the board's own schedule.
using SimTime = std::chrono::microseconds;

/// "No such moment": what `next_*()` functions return when nothing is due.
inline constexpr SimTime never = SimTime::max();

/// The first of several moments. It is asked for with every request: no list is made, and no loop runs.
template <class... Times>
constexpr SimTime earliest(SimTime first, Times... others) {
    ((first = others < first ? others : first), ...);
    return first;
}

/// Seconds as a double, for physics and for recordings.
inline constexpr double to_seconds(SimTime t) {
    return std::chrono::duration<double>(t).count();
}

/// The nearest microsecond to `s` seconds. `s` must be finite and within +-9e12.
inline constexpr SimTime from_seconds(double s) {
    return SimTime{static_cast<SimTime::rep>(s * 1e6 + (s < 0 ? -0.5 : 0.5))};
}

}  // namespace fauxboard::machine
