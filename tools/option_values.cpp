#include "tools/option_values.h"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

namespace fauxboard::tools {

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
            "--web", [&web](const std::string& where) { web = where.empty() ? "127.0.0.1:0" : where; },
            "Show it in a browser; the address is told. For this computer alone, on a free port and with a "
            "new secret "
            "in the address, unless you say otherwise")
        ->type_name("[HOST:PORT[/SECRET]]")
        ->expected(0, 1)
        ->default_str("");
}

CLI::Option* add_baud(CLI::App& command, unsigned& baud, const std::string& help) {
    return command.add_option("--baud", baud, help)->type_name("N")->check(CLI::Range(50U, 4'000'000U));
}

}  // namespace fauxboard::tools
