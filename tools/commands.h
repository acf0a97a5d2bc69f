#pragma once

#include <CLI/App.hpp>

namespace fauxboard::tools {

/// What the program's exit tells a script. Documented in `fauxboard --help` and the README.
enum class ExitCode : int {
    ok = 0,
    failed = 1,       ///< it ran, and the answer is no: a difference, a wrong profile, an expectation not met
    usage = 2,        ///< the command line itself is wrong
    bad_input = 3,    ///< a profile, recording or script to work with is missing or wrong
    no_port = 4,      ///< a port, socket or link name cannot be opened
    timed_out = 5,    ///< nothing came in the time allowed
    gone = 6,         ///< the other end went away before it answered
    interrupted = 7,  ///< the scenario was ended before it was through
    internal = 70,    ///< a bug: please report it
};

/// Each subcommand lives in one file and adds itself. Its callback leaves its result in `exit`.
void add_run(CLI::App& app, ExitCode& exit);
void add_fleet(CLI::App& app, ExitCode& exit);
void add_send(CLI::App& app, ExitCode& exit);
void add_replay(CLI::App& app, ExitCode& exit);
void add_screen(CLI::App& app, ExitCode& exit);
void add_tap(CLI::App& app, ExitCode& exit);
void add_decode(CLI::App& app, ExitCode& exit);
void add_ctl(CLI::App& app, ExitCode& exit);
void add_check(CLI::App& app, ExitCode& exit);
void add_describe(CLI::App& app, ExitCode& exit);
void add_sliced(CLI::App& app, ExitCode& exit);
void add_ports(CLI::App& app, ExitCode& exit);
void add_profiles(CLI::App& app, ExitCode& exit);
/// `manual` and `completion`.
void add_manual(CLI::App& app, ExitCode& exit);
/// `new`: a small profile, screen or scenario to start from.
void add_new(CLI::App& app, ExitCode& exit);
void add_soak(CLI::App& app, ExitCode& exit);

}  // namespace fauxboard::tools
