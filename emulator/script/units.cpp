#include "emulator/script/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "emulator/fault/quantity.h"

namespace fauxboard::script {
namespace {

using fault::Unit;

constexpr double longest_time_us = 1e15;  // thirty years

constexpr std::array<Unit, 1> plain{{{"", 1}}};
constexpr std::array<Unit, 1> degrees{{{"C", 1}}};
constexpr std::array<Unit, 4> lengths{{{"um", 0.001}, {"mm", 1}, {"cm", 10}, {"m", 1000}}};
constexpr std::array<Unit, 2> speeds{{{"mm/s", 1}, {"mm/min", 1 / 60.0}}};
constexpr std::array<Unit, 1> accelerations{{{"mm/s2", 1}}};
constexpr std::array<Unit, 1> resolutions{{{"steps/mm", 1}}};
constexpr std::array<Unit, 1> shares{{{"%", 1}}};
constexpr std::array<Unit, 2> currents{{{"mA", 1}, {"A", 1000}}};
constexpr std::array<Unit, 4> sizes{{{"bytes", 1}, {"B", 1}, {"kB", 1e3}, {"MB", 1e6}}};

/// The units that measure the same as this one.
std::span<const Unit> family_of(std::string_view unit) {
    const std::array<std::span<const Unit>, 10> families{
        plain,       degrees, lengths,  speeds, accelerations,
        resolutions, shares,  currents, sizes,  fault::time_units()};
    for (const std::span<const Unit> family : families) {
        if (std::any_of(family.begin(), family.end(), [&](const Unit& each) { return each.name == unit; })) {
            return family;
        }
    }
    return {};
}

}  // namespace

std::optional<double> quantity_from_text(std::string_view text, std::string_view unit) {
    const std::span<const Unit> family = family_of(unit);
    if (family.empty()) {  // a unit of its own
        const std::array<Unit, 1> own{{{unit, 1}}};
        return fault::parse_quantity(text, own);
    }
    const auto base = fault::parse_quantity(text, family);
    const auto wanted =
        std::find_if(family.begin(), family.end(), [&](const Unit& each) { return each.name == unit; });
    return base ? std::optional{*base / wanted->factor} : std::nullopt;
}

std::string quantity_example(std::string_view unit) {
    return fmt::format("\"{}{}\"", unit == "C" ? 200 : 10, unit);
}

std::optional<SimTime> time_from_text(std::string_view text) {
    const auto us = fault::parse_quantity(text, fault::time_units());
    if (!us || *us < 0 || *us > longest_time_us) {
        return std::nullopt;
    }
    return SimTime{std::llround(*us)};
}

std::string time_words(SimTime time) {
    const double seconds = machine::to_seconds(time);
    if (time < SimTime{1'000'000}) {
        return fmt::format("{:g} ms", seconds * 1000);
    }
    if (seconds < 60) {
        return fmt::format("{:.4g} s", seconds);
    }
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole < 3600) {
        return whole % 60 == 0 ? fmt::format("{} min", whole / 60)
                               : fmt::format("{} min {} s", whole / 60, whole % 60);
    }
    return whole % 3600 < 60 ? fmt::format("{} h", whole / 3600)
                             : fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace fauxboard::script
