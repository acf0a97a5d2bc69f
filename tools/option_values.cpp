#include "tools/option_values.h"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "emulator/host/time_text.h"

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

CLI::Option* add_baud(CLI::App& command, unsigned& baud, const std::string& help) {
    return command.add_option("--baud", baud, help)->type_name("N")->check(CLI::Range(50U, 4'000'000U));
}

}  // namespace fauxboard::tools
