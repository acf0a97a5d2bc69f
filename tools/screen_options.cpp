#include "tools/screen_options.h"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>

#include "tools/option_values.h"

namespace fauxboard::tools {
namespace {

void set_speed(ScreenOptions& options, const std::string& text) {
    const auto speed = host::parse_speed(text);
    if (!speed || speed->max) {
        throw CLI::ValidationError(
            "--speed", "'" + text +
                           "' is no speed for a screen; expected a number from 0.01 to 1000000, the same as "
                           "the board's (a screen cannot run at 'max': it waits for somebody)");
    }
    options.speed = *speed;
}

void set_timeout(ScreenOptions& options, const std::string& text) {
    const auto time = host::parse_duration(text);
    if (!time || *time == machine::SimTime{0}) {
        throw CLI::ValidationError("--timeout",
                                   "'" + text + "' is no time to wait; expected 500ms, 10s, 5min or seconds");
    }
    options.timeout = *time;
}

}  // namespace

void declare_screen_options(CLI::App& command, ScreenOptions& options) {
    CLI::Option_group* line = command.add_option_group("line", "Where the board is");
    line->add_option("--port", options.port, "Serial port, pseudo-terminal, or 'auto'")
        ->type_name("DEV|auto");
    line->add_option("--tcp", options.tcp, "Connect to a socket")
        ->type_name("HOST:PORT")
        ->check(wrong_address, "", "");
    line->add_option(
            "--control", options.control,
            "The screen that is part of a board, at its control channel (as given to `run --control`)")
        ->type_name("PATH");
    line->require_option(1);
    command
        .add_option("--screen", options.screen,
                    "The screen: a name of `fauxboard profiles`, or a file (geeetech-a30t)")
        ->type_name("NAME|FILE");
    add_baud(command, options.baud, "Bits per second of a serial port (115200)");
    command
        .add_option_function<std::string>(
            "--speed", [&options](const std::string& text) { set_speed(options, text); },
            "Virtual seconds per second, the same as the board's `run --speed` (1)")
        ->type_name("N");
    command
        .add_option_function<std::string>(
            "--timeout", [&options](const std::string& text) { set_timeout(options, text); },
            "How long to wait for the board's first word, in real time (10s)")
        ->type_name("T");
    command.add_option("--record", options.record, "Write every line of the wire to a recording")
        ->type_name("FILE");
}

}  // namespace fauxboard::tools
