#include "tools/option_values.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "emulator/behaviour/nearest.h"
#include "emulator/link/host_port.h"
#include "emulator/link/link.h"

namespace fauxboard::tools {
namespace {

/// All of `text` as a number; nothing when it is none.
template <class Number>
std::optional<Number> whole_text(std::string_view text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
}

template <class Number>
CLI::Validator between(std::string_view kind, std::int64_t least, std::int64_t most) {
    return {[=](const std::string& text) {
                const auto number = whole_text<Number>(text);
                const bool fits =
                    number && *number >= static_cast<Number>(least) && *number <= static_cast<Number>(most);
                return fits ? std::string()
                            : fmt::format("'{}' is no {} from {} to {}", text, kind, least, most);
            },
            "", ""};
}

}  // namespace

CLI::Validator whole_between(std::int64_t least, std::int64_t most) {
    return between<std::int64_t>("whole number", least, most);
}

CLI::Validator number_between(std::int64_t least, std::int64_t most) {
    return between<double>("number", least, most);
}

std::optional<std::uint64_t> parse_size(std::string_view text) {
    constexpr std::string_view units = "kmgt";
    unsigned shift = 0;
    if (!text.empty()) {
        const auto unit = units.find(static_cast<char>(text.back() | ' '));
        shift = unit == std::string_view::npos ? 0 : static_cast<unsigned>(unit + 1) * 10;
        text.remove_suffix(shift == 0 ? 0 : 1);
    }
    const auto number = whole_text<std::uint64_t>(text);
    const bool fits = number && *number <= std::numeric_limits<std::uint64_t>::max() >> shift;
    return fits ? std::optional(*number << shift) : std::nullopt;
}

void add_duration(CLI::App& command, machine::SimTime& duration, const std::string& help) {
    command
        .add_option_function<std::string>(
            "--duration",
            [&duration](const std::string& text) {
                const auto time = host::parse_duration(text);
                if (!time) {
                    throw CLI::ValidationError(
                        "--duration",
                        "'" + text + "' is no time; expected 500ms, 10s, 5min, 24h, 30d or seconds");
                }
                duration = *time;
            },
            help + ": 500ms, 10s, 5min, 24h, 30d")
        ->type_name("T");
}

void add_speed(CLI::App& command, host::Speed& speed, bool may_jump) {
    command
        .add_option_function<std::string>(
            "--speed",
            [&speed, may_jump](const std::string& text) {
                const auto read = host::parse_speed(text);
                if (!read || (read->max && !may_jump)) {
                    throw CLI::ValidationError("--speed", "'" + text +
                                                              "' is no speed; expected a number from 0.01 "
                                                              "to 1000000" +
                                                              (may_jump ? ", or max" : ""));
                }
                speed = *read;
            },
            may_jump ? "Virtual seconds per second; 'max' never waits" : "Virtual seconds per second")
        ->type_name(may_jump ? "N|max" : "N");
}

void add_web(CLI::App& command, std::optional<std::string>& web) {
    command
        .add_option_function<std::string>(
            "--web",
            [&web](const std::string& where) {
                web = where.empty() ? "127.0.0.1:0" : where;
                if (const std::string wrong = wrong_address(web->substr(0, web->find('/'))); !wrong.empty()) {
                    throw CLI::ValidationError("--web", wrong);
                }
            },
            "Show it in a browser; the address is told. For this computer alone, on a free port and with a "
            "new secret "
            "in the address, unless you say otherwise")
        ->type_name("[HOST:PORT[/SECRET]]")
        ->expected(0, 1)
        ->default_str("");
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& help) {
    command
        .add_option_function<std::string>(
            "--seed",
            [&seed](const std::string& text) {
                const auto read = whole_text<std::uint64_t>(text);
                if (!read) {
                    throw CLI::ValidationError(
                        "--seed", "'" + text + "' is no seed; expected a whole number of up to 64 bits");
                }
                seed = *read;
            },
            help + " (default: " + std::to_string(seed) + ")")
        ->type_name("N");
}

CLI::Validator one_of(std::vector<std::string> names) {
    return {[names = std::move(names)](const std::string& text) {
                if (std::find(names.begin(), names.end(), text) != names.end()) {
                    return std::string();
                }
                const std::vector<std::string_view> known(names.begin(), names.end());
                const std::string_view nearest = behaviour::nearest(text, known);
                return fmt::format("found '{}'; expected {}{}", text, fmt::join(known, " or "),
                                   nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
            },
            "", ""};
}

std::string wrong_address(const std::string& text) {
    try {
        static_cast<void>(link::parse_host_port(text));
        return {};
    } catch (const link::LinkError& error) {
        return error.what();
    }
}

CLI::Option* add_baud(CLI::App& command, unsigned& baud, const std::string& help) {
    return command.add_option("--baud", baud, help)->type_name("N")->check(whole_between(50, 4'000'000));
}

}  // namespace fauxboard::tools
