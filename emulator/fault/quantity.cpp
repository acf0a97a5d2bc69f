#include "emulator/fault/quantity.h"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace fauxboard::fault {

std::span<const Unit> time_units() {
    static constexpr std::array<Unit, 6> units{
        {{"us", 1}, {"ms", 1e3}, {"s", 1e6}, {"min", 60e6}, {"h", 3600e6}, {"d", 86'400e6}}};
    return units;
}

std::span<const Unit> temperature_units() {
    static constexpr std::array<Unit, 1> units{{{"C", 1}}};
    return units;
}

std::span<const Unit> rate_units() {
    static constexpr std::array<Unit, 3> units{{{"B/s", 1}, {"kB/s", 1e3}, {"baud", 0.1}}};
    return units;
}

std::optional<double> parse_quantity(std::string_view text, std::span<const Unit> units) {
    double number = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    if (error != std::errc{} || !std::isfinite(number)) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    for (const Unit& unit : units) {
        if (text == unit.name) {
            return number * unit.factor;
        }
    }
    return std::nullopt;
}

std::string time_text(machine::SimTime time) {
    const auto us = time.count();
    if (us % 1'000'000 == 0) {
        return std::to_string(us / 1'000'000) + "s";
    }
    return us % 1000 == 0 ? std::to_string(us / 1000) + "ms" : std::to_string(us) + "us";
}

}  // namespace fauxboard::fault
