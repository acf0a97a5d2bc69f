#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/machine/sim_time.h"

namespace fauxboard::fault {

/// A unit and how much of the base unit it is.
struct Unit {
    std::string_view name;
    double factor;
};

/// us, ms, s, min, h; the base is the microsecond.
std::span<const Unit> time_units();
/// C; the base is the degree Celsius.
std::span<const Unit> temperature_units();
/// B/s, kB/s, baud (10 bits a byte); the base is the byte per second.
std::span<const Unit> rate_units();

/// "200ms", "1.5s": a decimal number and one of `units`, without a blank, in the base unit. Nothing for
/// anything else, also for a number without its unit.
std::optional<double> parse_quantity(std::string_view text, std::span<const Unit> units);

/// "1500ms": in the largest unit up to seconds that needs no fraction.
std::string time_text(machine::SimTime time);

}  // namespace fauxboard::fault
