#include "tools/run_options.h"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <stdexcept>

#include "tools/option_values.h"

namespace fauxboard::tools {
namespace {

void declare_line(CLI::App& command, RunOptions& options) {
    CLI::Option* port =
        command.add_option("--port", options.port, "Serial port, or 'auto' for the only USB adapter")
            ->type_name("DEV|auto");
    CLI::Option* tcp =
        command.add_option("--tcp", options.tcp, "Listen for one client instead; port 0 takes a free one")
            ->type_name("HOST:PORT")
            ->check(wrong_address, "", "");
    CLI::Option* pty = command
                           .add_option("--pty", options.pty_name,
                                       "A pseudo-terminal (the default), with a name of your choice")
                           ->type_name("[=LINK]")
                           ->expected(0, 1);
    port->excludes(tcp)->excludes(pty);
    tcp->excludes(pty);
    command
        .add_option(
            "--udp", options.udp,
            "The board's network module beside the line: datagrams on this port (the boards have 3000)")
        ->type_name("HOST:PORT")
        ->check(wrong_address, "", "");
    add_baud(command, options.baud, "Bits per second (default: the profile's)");
    command.add_flag_callback(
        "--no-pacing", [&options] { options.pacing = false; },
        "Reply at once instead of on the board's transmit tick");
}

void declare_script(CLI::App& command, RunOptions& options) {
    CLI::Option* script =
        command
            .add_option("--script", options.script,
                        "Play a scenario, a name or a file, and end with it: exit code 0 when it passed")
            ->type_name("NAME|FILE");
    CLI::Option* screen =
        command
            .add_option("--screen", options.screen,
                        "With a virtual touch screen in this process instead of a line (default: what the "
                        "scenario says)")
            ->type_name("NAME|FILE")
            ->needs(script);
    for (const char* line : {"--port", "--tcp", "--pty"}) {
        screen->excludes(command.get_option(line));
    }
    command.add_option("--param", options.params, "A parameter of the scenario: name=value; may be repeated")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->take_all()
        ->needs(script)
        ->check([](const std::string& text) {
            return text.find('=') == std::string::npos ? "'" + text + "': expected name=value"
                                                       : std::string{};
        });
    command.add_option("--junit", options.junit, "Write the scenario's outcome as JUnit's XML")
        ->type_name("FILE")
        ->needs(script);
    command
        .add_option(
            "--report", options.report,
            "Write the scenario's outcome as JSON: steps, last talk, and the board's state at the end")
        ->type_name("FILE")
        ->needs(script);
}

/// The USB side, where a host program prints through the board while the screen shows it.
void declare_host_line(CLI::App& command, RunOptions& options) {
    CLI::Option* pty =
        command
            .add_option_function<std::string>(
                "--host-pty",
                [&options](const std::string& name) {
                    options.host.pty = true;
                    options.host.pty_name = name;
                },
                "The board's USB port for a host program: a pseudo-terminal, with a name of your choice")
            ->type_name("[=LINK]")
            ->expected(0, 1)
            ->default_str("");
    CLI::Option* port =
        command.add_option("--host-port", options.host.port, "The same on a serial port")->type_name("DEV");
    CLI::Option* tcp =
        command.add_option("--host-tcp", options.host.tcp, "The same for one client of a socket")
            ->type_name("HOST:PORT")
            ->check(wrong_address, "", "");
    pty->excludes(port)->excludes(tcp);
    port->excludes(tcp);
    command.add_option("--host-baud", options.host.baud, "Bits per second of --host-port")
        ->type_name("N")
        ->check(whole_between(50, 4'000'000))
        ->capture_default_str()
        ->needs(port);
}

/// After both lines.
void declare_speed_of_peers(CLI::App& command, RunOptions& options) {
    command.add_flag(
        "--exact-baud", options.exact_baud,
        "A peer that sets a pseudo-terminal to another speed than the board's hears garbage, and "
        "is heard as garbage, as on a real line (default: it is only told of)");
}

void declare_time(CLI::App& command, RunOptions& options) {
    add_speed(command, options.speed, true);
    add_duration(command, options.duration, "Stop after this virtual time");
    add_seed(command, options.seed, "Of all noise: the same seed and input give the same bytes");
}

void declare_talk(CLI::App& command, RunOptions& options) {
    command.add_option("--record", options.record, "Write every line of the wire to a recording")
        ->type_name("FILE");
    command
        .add_option("--control", options.control,
                    "Open a control channel, apart from the line: a Unix socket for `fauxboard ctl`")
        ->type_name("PATH");
    add_web(command, options.web);
    command.add_flag("--json", options.json, "The log as JSON lines on stdout, instead of text on stderr");
    CLI::Option* verbose = command.add_flag_callback(
        "-v,--verbose", [&options] { options.detail = host::Detail::verbose; }, "Log all there is");
    command
        .add_flag_callback(
            "-q,--quiet", [&options] { options.detail = host::Detail::quiet; },
            "Log warnings and errors only")
        ->excludes(verbose);
    add_log(command, options.log);
}

}  // namespace

void declare_run_options(CLI::App& command, RunOptions& options) {
    command.add_option("--profile", options.profile, "The board: a name of `fauxboard profiles`, or a file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
    declare_line(command, options);
    declare_host_line(command, options);
    declare_speed_of_peers(command, options);
    command.add_option("--sd", options.sd, "Folder that is the SD card (default: a small built-in card)")
        ->type_name("DIR");
    command
        .add_option("--udisk", options.udisk,
                    "Folder that is the U-disk, of a board with a port for one (default: none)")
        ->type_name("DIR");
    command
        .add_option("--eeprom", options.eeprom,
                    "File that keeps the board's settings, and beside it FILE.job the place of a print "
                    "(default: none)")
        ->type_name("FILE");
    command
        .add_option("--panel", options.panel,
                    "Folder for what the UV panel of a board that has one shows: a PNG each, and panel.jsonl")
        ->type_name("DIR");
    command
        .add_option(
            "--spi", options.spi,
            "The wires to that panel, as records: into a file (FILE.pcapng for Wireshark), or to somebody "
            "who may answer for the FPGA")
        ->type_name("FILE|pty[=LINK]|HOST:PORT");
    declare_script(command, options);
    declare_time(command, options);
    declare_talk(command, options);
    command
        .add_option("--fault", options.faults,
                    "Make the line misbehave, or break the printer: drop:to_screen,every=5, jam:at=60s (see "
                    "`describe "
                    "faults`); may be repeated")
        ->type_name("SPEC")
        ->expected(1)
        ->take_all();
    command.add_flag_callback(
        "--no-reload", [&options] { options.reload = false; },
        "Do not take a changed profile into force while running");
}

}  // namespace fauxboard::tools
