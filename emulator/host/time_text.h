#pragma once

#include <optional>
#include <string_view>

#include "emulator/machine/sim_time.h"

namespace fauxboard::host {

/// How fast virtual time runs.
struct Speed {
    static constexpr double slowest = 0.01;
    static constexpr double fastest = 1e6;
    double factor = 1;  ///< virtual seconds per second, slowest..fastest
    bool max = false;   ///< never wait: jump to the next thing due; `factor` says nothing then
};

/// "1", "0.5", "max". Nothing for anything else and for numbers out of bounds.
std::optional<Speed> parse_speed(std::string_view text);

/// "500ms", "10s", "5min", "24h", "30d", a plain number is seconds; "1.5h" too. Nothing for anything else,
/// for negative and for more than 100 years.
std::optional<machine::SimTime> parse_duration(std::string_view text);

}  // namespace fauxboard::host
