#include "emulator/host/time_text.h"

#include <array>
#include <charconv>
#include <system_error>
#include <utility>

namespace fauxboard::host {
namespace {

constexpr double max_seconds = 100.0 * 365 * 24 * 3600;

/// The number at the start of `text`, which it is taken off; plain decimal only.
std::optional<double> take_number(std::string_view& text) {
    double number = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    if (error != std::errc{} || !(number >= 0 && number < 1e30)) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

}  // namespace

std::optional<Speed> parse_speed(std::string_view text) {
    if (text == "max") {
        return Speed{.factor = 1, .max = true};
    }
    const auto number = take_number(text);
    if (!number || !text.empty() || *number < Speed::slowest || *number > Speed::fastest) {
        return std::nullopt;
    }
    return Speed{.factor = *number, .max = false};
}

std::optional<machine::SimTime> parse_duration(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, double>, 7> units{
        {{"", 1}, {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60}, {"h", 3600}, {"d", 86'400}}};
    const auto number = take_number(text);
    if (!number) {
        return std::nullopt;
    }
    for (const auto& [unit, seconds] : units) {
        if (text == unit && *number * seconds <= max_seconds) {
            return machine::from_seconds(*number * seconds);
        }
    }
    return std::nullopt;
}

}  // namespace fauxboard::host
