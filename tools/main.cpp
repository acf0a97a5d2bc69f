// The `fauxboard` command: its subcommands, help, and what its exit code tells.

#include <fcntl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/source.h"
#include "emulator/host/profile_files.h"
#include "emulator/link/host_error.h"
#include "emulator/link/link.h"
#include "tools/command_tree.h"
#include "tools/commands.h"
#include "tools/help_formatter.h"
#include "tools/report.h"
#include "tools/version.h"

namespace fauxboard::tools {
namespace {

constexpr const char* what_it_is =
    "fauxboard stands in for a 3D printer's control board: plug a real touch screen into this computer, or\n"
    "point a program at it, and it answers as the printer would. It is not a printer. Nothing heats, "
    "nothing\n"
    "moves.";

constexpr const char* examples =
    R"(Examples:
  fauxboard run --port auto              a real screen on the only USB-TTL adapter
  fauxboard run --pty=/tmp/screen        a pseudo-terminal for a program, with a name
  fauxboard run --tcp 127.0.0.1:4000     a socket
  fauxboard run --script day-of-bad-luck --speed max   a scenario, as a test
  fauxboard send --port /tmp/screen M105   ask it for its temperatures
  fauxboard profiles                     the boards it can be
  fauxboard COMMAND --help               all about one command

Exit codes:
  0   done
  1   it ran, and the answer is no: a difference, a wrong profile, an expectation not met,
      a scenario that failed
  2   the command line is wrong
  3   a profile, scenario, recording, folder or file to work with is missing or wrong
  4   a port, socket or link name cannot be opened
  5   nothing came in the time allowed; a wait of a scenario was in vain
  6   the other end went away before it answered
  7   the scenario was ended before it was through: by a signal, by --duration
  70  a bug in fauxboard: please report it)";

/// A descriptor closed by our caller would be given to the first port that we open, and text meant for people
/// would go out on it.
void fill_standard_descriptors() {
    for (const int fd : {0, 1, 2}) {
        if (::fcntl(fd, F_GETFD) == -1 && errno == EBADF) {
            ::open("/dev/null", O_RDWR);  // takes the lowest free number: fd
        }
    }
}

/// A folder that is not there, or empty, helps nobody, and whoever named it should know.
void warn_of_profile_folders() {
    for (const std::string& useless : host::useless_profile_folders()) {
        complain({}, ExitCode::ok, "FAUXBOARD_PROFILES names " + useless);
    }
}

int run_app(int argc, char** argv) {
    CLI::App app{what_it_is, "fauxboard"};
    ExitCode exit = ExitCode::ok;
    app.formatter(std::make_shared<HelpFormatter>());  // first, since the subcommands inherit it
    app.set_version_flag("--version", version_text);
    app.require_subcommand(1);
    add_run(app, exit);
    add_fleet(app, exit);
    add_send(app, exit);
    add_replay(app, exit);
    add_screen(app, exit);
    add_tap(app, exit);
    add_decode(app, exit);
    add_ctl(app, exit);
    add_check(app, exit);
    add_describe(app, exit);
    add_sliced(app, exit);
    add_ports(app, exit);
    add_profiles(app, exit);
    add_new(app, exit);
    add_manual(app, exit);
    add_soak(app, exit);
    app.footer(examples);  // last, since the subcommands made before inherit none of it
    warn_of_profile_folders();
    const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (const std::string wrong = unknown_word(app, words); !wrong.empty()) {
        complain({}, ExitCode::usage, wrong);
        return static_cast<int>(ExitCode::usage);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success) == 0 ? static_cast<int>(ExitCode::ok) : static_cast<int>(ExitCode::internal);
    } catch (const CLI::ParseError& error) {
        print_error(wrong_use(app, error.what()));  // may hold what was given: it goes the way of all text
        return static_cast<int>(ExitCode::usage);
    }
    return static_cast<int>(exit);
}

/// What a descriptor or a disk that breaks can do to a program is an error that its caller handles, not its
/// end.
void ignore_deadly_signals() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // a file as large as RLIMIT_FSIZE allows is then like a full disk
}

/// Out of memory is one of the system's errors. Whatever has to be done then has to do without any.
[[noreturn]] void end_without_memory() {
    constexpr std::string_view sentence = "fauxboard: There is not enough memory for this.\n";
    (void)!::write(STDERR_FILENO, sentence.data(), sentence.size());
    std::_Exit(static_cast<int>(ExitCode::bad_input));
}

/// Destructors that need memory end here when there is none.
[[noreturn]] void terminated() {
    if (const std::exception_ptr error = std::current_exception()) {
        try {
            std::rethrow_exception(error);
        } catch (const std::bad_alloc&) {
            end_without_memory();
        } catch (...) {
        }
    }
    std::abort();
}

template <class Error>
bool is(const std::exception& error) {
    return dynamic_cast<const Error*>(&error) != nullptr;
}

/// The last word on an error that no subcommand handled. What is wrong with a file or a line is no bug,
/// wherever it comes from.
ExitCode last_word(const std::exception& error) {
    if (is<std::bad_alloc>(error)) {
        end_without_memory();
    }
    if (is<behaviour::ProfileError>(error) || is<link::HostError>(error)) {
        return complain("", ExitCode::bad_input, error.what());
    }
    if (is<link::LinkError>(error)) {
        return complain("", ExitCode::no_port, error.what());
    }
    return complain("", ExitCode::internal, std::string("a bug, please report it: ") + error.what());
}

}  // namespace
}  // namespace fauxboard::tools

int main(int argc, char** argv) {
    std::set_terminate(fauxboard::tools::terminated);
    try {
        fauxboard::tools::ignore_deadly_signals();
        fauxboard::tools::fill_standard_descriptors();
        return fauxboard::tools::run_app(argc, argv);
    } catch (const std::exception& error) {
        return static_cast<int>(fauxboard::tools::last_word(error));
    } catch (...) {
        fauxboard::tools::complain("", fauxboard::tools::ExitCode::internal,
                                   "a bug, please report it: an exception of unknown kind");
    }
    return static_cast<int>(fauxboard::tools::ExitCode::internal);
}
