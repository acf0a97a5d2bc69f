// `fauxboard run`: one board, live on a line.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <vector>

#include "emulator/fault/printer_fault.h"
#include "emulator/host/json_log.h"
#include "emulator/host/line_faults.h"
#include "emulator/host/line_log.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/profile_watch.h"
#include "emulator/host/program_log.h"
#include "emulator/host/recorder.h"
#include "emulator/host/script_host.h"
#include "emulator/link/host_error.h"
#include "emulator/panel/panel.h"
#include "protocol/command.h"
#include "tools/board_unit.h"
#include "tools/commands.h"
#include "tools/file_roles.h"
#include "tools/profile_changes.h"
#include "tools/profile_words.h"
#include "tools/progress.h"
#include "tools/ready_line.h"
#include "tools/report.h"
#include "tools/run_options.h"
#include "tools/run_script.h"

namespace fauxboard::tools {
namespace {

/// What a person can still follow, per second. A real line has some twenty at most.
constexpr double log_lines_per_second = 100;

constexpr std::chrono::milliseconds progress_pause{200};

/// Everything that one run needs, in the order in which it must come and (backwards) go.
class Run {
  public:
    /// `scenario` may be null.
    Run(const RunOptions& options, std::shared_ptr<const script::Scenario> scenario)
        : options_(options),
          scenario_(std::move(scenario)),
          out_(STDOUT_FILENO),
          err_(STDERR_FILENO),
          log_(err_, options.json ? host::Detail::quiet : options.detail, log_rate(options.speed)),
          json_(out_),
          unit_(loop_, options,
                scenario_ ? scenario_->cast.profile : host::load_profile_by_name(options.profile),
                scenario_.get(), observers_),
          signals_(loop_, link::ending_signals(), [this](int number) { on_signal(number); }),
          watch_(loop_, [this] { reload(); }) {}

    ExitCode operator()();

  private:
    static double log_rate(const host::Speed& speed) {
        return speed.max ? 0 : log_lines_per_second / speed.factor;
    }
    void set_up();
    void check_files() const;
    void open_log();
    void open_script();
    ExitCode outcome();
    void say_ready();
    void watch_profile();
    void reload();
    void on_signal(int number);
    bool is_long_work() const;
    void show_progress();

    const RunOptions& options_;
    std::shared_ptr<const script::Scenario> scenario_;
    link::EventLoop loop_;
    host::TextOutput out_;
    host::TextOutput err_;
    host::LineLog log_;
    host::JsonLog json_;
    std::optional<host::LogFile> log_file_;
    std::optional<host::ProgramLog> program_log_;
    host::Observers observers_;
    std::optional<host::Recorder> recorder_;
    BoardUnit unit_;
    std::optional<panel::Panel> panel_;
    std::optional<host::ScriptHost> script_;
    ReadyLine ready_{loop_, out_};
    link::Signals signals_;
    host::ProfileWatch watch_;
    link::Timer progress_timer_{loop_, [this] { show_progress(); }};
    Progress progress_;
    ProfileChanges changes_{options_.profile};
};

/// Before anything is opened: that may empty a file.
void Run::check_files() const {
    FileRoles roles;
    roles.reads("the profile", unit_.profile()->files);
    if (scenario_) {
        roles.reads("the scenario", scenario_->files);
    }
    if (scenario_ && scenario_->cast.screen) {
        roles.reads("the screen", scenario_->cast.screen->files);
    }
    roles.add_log(options_.log);
    roles.add_board(options_);
}

void Run::set_up() {
    check_files();
    log_.call_peer(unit_.profile()->line.peer);
    const auto own = [this](board::Channel channel, const protocol::DecodedLine& line) {
        return profile_words(*unit_.profile(), channel, line);
    };
    log_.ask(own);
    json_.ask(own);
    observers_.add(log_);
    open_log();
    if (!options_.record.empty()) {
        recorder_.emplace(options_.record, [this](machine::SimTime, std::string_view text) {
            unit_.say(board::Level::error, text);
        });
        observers_.add(*recorder_);
    }
    unit_.set_up();
    if (!options_.control.empty() || options_.web) {
        unit_.open_target([this] { loop_.stop(); });
    }
}

/// Of the program's own doings. Where it is off nothing is told to it.
void Run::open_log() {
    const LogOptions& wanted = options_.log;
    if (wanted.file.empty() && wanted.level) {
        log_.tell_own(*wanted.level);
    }
    if (!wanted.wanted()) {
        return;
    }
    log_file_.emplace(wanted.for_file(),
                      [this](std::string_view text) { unit_.say(board::Level::error, text); });
    observers_.add(
        program_log_.emplace(*log_file_, host::ProgramLog::Style{wanted.file_level(), wanted.json, ""}));
    for (const std::string& words : first_words(options_, *unit_.profile())) {
        program_log_->say(machine::SimTime{0}, host::LogLevel::info, "program", words);
    }
}

void Run::open_script() {
    if (!scenario_) {
        return;
    }
    script_.emplace(
        host::ScriptHost::Parts{
            unit_.live(), unit_.clock(), &unit_.faults(), unit_.plug(), [this] { loop_.stop(); },
            [this](std::string_view text) { unit_.say(board::Level::info, text); }, unit_.display()},
        scenario_, options_.speed);
    observers_.add(*script_);
    if (unit_.target() != nullptr) {
        unit_.target()->show(script_->player());
    }
}

/// How the scenario ended; without one all is well.
ExitCode Run::outcome() {
    if (!script_) {
        return ExitCode::ok;
    }
    script_->interrupt("from outside");
    unit_.board().refresh(unit_.board().time());
    script::Json faults = script::Json::array();
    for (const fault::FaultStatus& status : unit_.faults().list()) {
        faults.push_back(fault::status_to_json(status));
    }
    for (const machine::Fault& broken : unit_.board().machine().faults.list()) {
        faults.push_back(fault::printer_fault_to_json(broken));
    }
    return tell_outcome(options_, script_->player(), unit_.board(), faults, out_, err_);
}

void Run::say_ready() {
    nlohmann::ordered_json ready = unit_.ready();
    if (panel_) {
        ready["web"] = panel_->address();
    }
    ready_.say(ready);
    if (options_.json) {
        observers_.add(json_);  // not before: the ready line is the first
    }
    const behaviour::Profile& profile = *unit_.profile();
    err_.write(fmt::format(
        "This is fauxboard, an emulator: there is no real printer here.\n"
        "{}{}. Ctrl-C ends it.\n{}",
        profile.title.empty() ? profile.name : fmt::format("{} ({})", profile.title, profile.name),
        unit_.where(), panel_ ? "To look at it, open " + panel_->address() + "\n" : std::string()));
}

void Run::watch_profile() {
    watch_.watch(unit_.profile()->files);
    if (!watch_.works()) {
        unit_.say(board::Level::info,
                  "this system does not tell of changed files; changes of the profile are "
                  "not noticed");
    }
}

void Run::reload() {
    try {
        auto profile = host::load_profile_by_name(options_.profile);
        watch_.watch(profile->files);
        unit_.reload(std::move(profile));
        unit_.say(board::Level::info, "the changed profile is in force" + changes_.what_waits());
    } catch (const behaviour::ProfileError& error) {
        unit_.say(board::Level::error, "the changed profile is wrong, the one before stays in force:");
        for (const behaviour::Problem& problem : error.problems()) {
            unit_.say(board::Level::error, problem.sentence());
        }
    } catch (const std::exception& error) {  // of the system: out of memory, say
        unit_.say(board::Level::error,
                  fmt::format("the changed profile cannot be loaded ({}), the one before stays in force",
                              error.what()));
    }
}

void Run::on_signal(int number) {
    if (script_) {
        script_->interrupt("by " + link::signal_name(number));
    }
    loop_.stop();
}

/// It comes to an end by itself, and nothing else tells how far it is.
bool Run::is_long_work() const {
    const bool silent = options_.json || options_.detail == host::Detail::quiet;
    return silent && (script_ || options_.duration != machine::never);
}

void Run::show_progress() {
    const double now = machine::to_seconds(unit_.live().now());
    std::string text = fmt::format("{:.0f} s of the board's time", now);
    if (options_.duration != machine::never) {
        text += fmt::format(", {:.0f} %", 100 * now / machine::to_seconds(options_.duration));
    }
    if (const machine::Job& job = unit_.board().machine().job; job.active()) {
        text += fmt::format("; print {} %", job.progress_percent());
    }
    progress_.say(text);
    progress_timer_.after(progress_pause);
}

ExitCode Run::operator()() {
    set_up();
    open_script();
    unit_.open();
    if (options_.web) {
        panel_.emplace(loop_, *options_.web,
                       std::vector{panel::Panel::Shown{
                           unit_.profile()->name, *unit_.target(),
                           [this](const std::string& text) { unit_.say(board::Level::debug, text); }}});
    }
    say_ready();
    unit_.warn_of_network(panel_ ? panel_->address() : std::string());
    if (options_.reload && !scenario_) {  // which was checked against this one
        watch_profile();
    }
    unit_.start(options_.duration, [this] {
        if (script_) {
            script_->interrupt("by --duration");
        }
        loop_.stop();
    });
    if (script_) {
        script_->start();
    }
    if (is_long_work()) {
        progress_timer_.after(progress_pause);
    }
    unit_.clock().run();
    progress_timer_.cancel();
    progress_.clear();
    if (unit_.target() != nullptr) {
        unit_.target()->on_end();
    }
    panel_.reset();
    unit_.close();
    if (recorder_) {
        recorder_->finish(unit_.live().now());
    }
    log_.finish(unit_.live().now());
    const std::string summary = unit_.summary();
    err_.write(summary);
    if (program_log_) {
        for (std::size_t at = 0, end = 0; (end = summary.find('\n', at)) != std::string::npos; at = end + 1) {
            program_log_->say(unit_.live().now(), host::LogLevel::info, "program",
                              std::string_view(summary).substr(at, end - at));
        }
    }
    return outcome();
}

ExitCode run(RunOptions& options) {
    try {
        auto scenario = plan_script(options);
        return Run{options, std::move(scenario)}();
    } catch (const behaviour::ProfileError& error) {
        return complain("run", ExitCode::bad_input, error.what());
    } catch (const link::HostError& error) {
        return complain("run", ExitCode::bad_input, error.what());
    } catch (const fault::FaultSpecError& error) {
        return complain("run", ExitCode::usage, error.what());
    } catch (const link::LinkError& error) {
        return complain("run", ExitCode::no_port, error.what());
    }
}

}  // namespace

void add_run(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand("run", "Be a control board, live on a line");
    const auto options = std::make_shared<RunOptions>();
    declare_run_options(*command, *options);
    command->callback([options, command, &exit] {
        options->profile_given = command->count("--profile") != 0;
        options->line_given =
            command->count("--port") + command->count("--tcp") + command->count("--pty") != 0;
        exit = run(*options);
    });
}

}  // namespace fauxboard::tools
