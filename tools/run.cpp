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
#include "emulator/host/clock.h"
#include "emulator/host/control_server.h"
#include "emulator/host/eeprom_file.h"
#include "emulator/host/faulty_link.h"
#include "emulator/host/folder_card.h"
#include "emulator/host/job_place_file.h"
#include "emulator/host/json_log.h"
#include "emulator/host/line_log.h"
#include "emulator/host/live_board.h"
#include "emulator/host/network_line.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/profile_watch.h"
#include "emulator/host/recorder.h"
#include "emulator/host/screen_plug.h"
#include "emulator/host/script_host.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/host_error.h"
#include "emulator/link/ports.h"
#include "emulator/link/udp_socket.h"
#include "emulator/machine/memory_volume.h"
#include "tools/commands.h"
#include "tools/report.h"
#include "tools/run_options.h"
#include "tools/run_script.h"

namespace fauxboard::tools {
namespace {

using link::LinkState;
using machine::SimTime;

/// What a person can still follow, per second. A real line has some twenty at most.
constexpr double log_lines_per_second = 100;
constexpr std::chrono::milliseconds ready_retry{50};

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
          profile_(scenario_ ? scenario_->cast.profile : host::load_profile_by_name(options.profile)),
          clock_(host::make_clock(loop_, options.speed)),
          signals_(loop_, link::ending_signals, [this](int number) { on_signal(number); }),
          watch_(loop_, [this] { reload(); }) {}

    ExitCode operator()();

  private:
    static double log_rate(const host::Speed& speed) {
        return speed.max ? 0 : log_lines_per_second / speed.factor;
    }
    void set_up();
    void set_up_disks(machine::Services& services);
    link::Link& make_wire();
    std::unique_ptr<link::Link> make_link();
    void open_script();
    ExitCode outcome();
    std::unique_ptr<link::Link> make_host_link();
    void open_control();
    void open_network();
    void say_ready();
    void see_ready_off();
    void warn_of_network();
    void say(board::Level level, std::string_view text);
    void reload();
    void say_summary();
    void on_signal(int number);

    const RunOptions& options_;
    std::shared_ptr<const script::Scenario> scenario_;
    link::EventLoop loop_;
    host::TextOutput out_;
    host::TextOutput err_;
    host::LineLog log_;
    host::JsonLog json_;
    host::Observers observers_;
    std::shared_ptr<const behaviour::Profile> profile_;
    std::optional<host::FolderCard> card_;
    std::optional<host::FolderCard> udisk_;
    std::optional<machine::MemoryVolume> scenario_card_;
    std::optional<host::EepromFile> eeprom_;
    std::optional<host::JobPlaceFile> job_place_;
    std::optional<host::Recorder> recorder_;
    std::unique_ptr<host::Clock> clock_;
    std::unique_ptr<link::Link> wire_;  ///< the line as it is, if it leads out of this process
    std::optional<host::ScreenPlug> plug_;
    std::optional<host::FaultyLink> link_;
    std::unique_ptr<link::Link> host_link_;  ///< the board's USB port
    std::optional<board::Board> board_;
    std::optional<host::LiveBoard> live_;
    std::unique_ptr<link::UdpSocket> udp_;
    std::optional<host::NetworkLine> network_;
    std::optional<host::ControlServer> control_;
    std::optional<host::ScriptHost> script_;
    link::Timer ready_retry_{loop_, [this] { see_ready_off(); }};
    link::Signals signals_;
    host::ProfileWatch watch_;
};

void Run::say(board::Level level, std::string_view text) {
    observers_.on_notice(live_ ? live_->now() : SimTime{0}, level, text);
}

link::Link& Run::make_wire() {
    if (!options_.screen.empty()) {
        return plug_.emplace(scenario_->cast.screen, *clock_).board_end();
    }
    wire_ = make_link();
    return *wire_;
}

std::unique_ptr<link::Link> Run::make_link() {
    if (!options_.tcp.empty()) {
        return link::make_tcp_listen_link(loop_, options_.tcp);
    }
    if (!options_.port.empty()) {
        const std::string port = options_.port == "auto" ? link::pick_auto_port() : options_.port;
        return link::make_port_link(loop_, port, options_.baud != 0 ? options_.baud : profile_->line.baud);
    }
    return link::make_pty_link(loop_, options_.pty_name);
}

std::unique_ptr<link::Link> Run::make_host_link() {
    const HostLine& line = options_.host;
    if (!line.tcp.empty()) {
        return link::make_tcp_listen_link(loop_, line.tcp);
    }
    if (!line.port.empty()) {
        return link::make_port_link(loop_, line.port, line.baud);
    }
    return link::make_pty_link(loop_, line.pty_name);
}

void Run::set_up() {
    log_.call_peer(profile_->line.peer);
    observers_.add(log_);
    const auto trouble = [this](std::string_view text) { say(board::Level::error, text); };
    if (!options_.record.empty()) {
        recorder_.emplace(options_.record, [trouble](SimTime, std::string_view text) { trouble(text); });
        observers_.add(*recorder_);
    }
    machine::Services services;
    set_up_disks(services);
    if (!options_.eeprom.empty()) {
        // The place first: it is what tells that another board has both.
        services.job_place = &job_place_.emplace(host::JobPlaceFile::beside(options_.eeprom), trouble);
        services.eeprom = &eeprom_.emplace(options_.eeprom, trouble);
    }
    board::Options options;
    options.pacing = options_.pacing;
    options.seed = options_.seed;
    options.observer = &observers_;
    board_.emplace(profile_, services, options);
    link_.emplace(make_wire(), *clock_, fault::Direction::to_board);
    for (const std::string& text : options_.faults) {
        const fault::FaultSpec spec = fault::fault_from_text(text);
        if (!fault::is_for_printer(spec)) {
            link_->add(spec);
        } else if (board_->machine().faults.add(SimTime{0}, fault::to_request(spec)) == 0) {
            throw fault::FaultSpecError({fmt::format("fault \"{}\": {}", text,
                                                     board_->machine().faults.refusal(*spec.kind->printer))});
        }
    }
    live_.emplace(*board_, *link_, *clock_, &observers_);
}

void Run::set_up_disks(machine::Services& services) {
    if (!options_.sd.empty()) {
        services.sd = &card_.emplace(options_.sd);
    } else if (scenario_ && scenario_->card) {
        services.sd = &scenario_card_.emplace(*scenario_->card);
    }
    if (!options_.udisk.empty()) {
        if (!profile_->machine->udisk_port) {
            throw link::HostError(
                fmt::format("The board of the profile {} has no port for a U-disk. Leave --udisk out, or say "
                            "\"machine\": {{\"udisk_port\": true}} in a profile of your own that extends it.",
                            profile_->name));
        }
        services.udisk = &udisk_.emplace(options_.udisk, "the U-disk");
    }
}

void Run::open_control() {
    if (options_.control.empty()) {
        return;
    }
    control_.emplace(
        host::ControlServer::Parts{loop_, *board_, *live_, *clock_, *link_, &*link_, [this] { loop_.stop(); },
                                   [this](std::string_view text) { say(board::Level::info, text); }});
    observers_.add(*control_);
    control_->open(options_.control);
}

void Run::open_script() {
    if (!scenario_) {
        return;
    }
    script_.emplace(
        host::ScriptHost::Parts{*live_, *clock_, &*link_, plug_ ? &*plug_ : nullptr, [this] { loop_.stop(); },
                                [this](std::string_view text) { say(board::Level::info, text); }},
        scenario_, options_.speed);
    observers_.add(*script_);
}

/// How the scenario ended; without one all is well.
ExitCode Run::outcome() {
    if (!script_) {
        return ExitCode::ok;
    }
    script_->interrupt("from outside");
    board_->refresh(board_->time());
    script::Json faults = script::Json::array();
    for (const fault::FaultStatus& status : link_->list()) {
        faults.push_back(fault::status_to_json(status));
    }
    for (const machine::Fault& broken : board_->machine().faults.list()) {
        faults.push_back(fault::printer_fault_to_json(broken));
    }
    return tell_outcome(options_, script_->player(), *board_, faults, out_, err_);
}

void Run::open_network() {
    if (!options_.udp.empty()) {
        udp_ = link::make_udp_socket(loop_, options_.udp);
        udp_->open(network_.emplace(*live_, *udp_, &observers_));
    }
}

void Run::say_ready() {
    nlohmann::ordered_json ready{
        {"profile", profile_->name}, {"link", link_->kind()}, {"path", link_->path()}};
    if (!options_.pty_name.empty()) {
        ready["name"] = options_.pty_name;
    }
    if (host_link_) {
        ready["host"] = {{"link", host_link_->kind()}, {"path", host_link_->path()}};
        if (!options_.host.pty_name.empty()) {
            ready["host"]["name"] = options_.host.pty_name;
        }
    }
    if (control_) {
        ready["control"] = options_.control;
    }
    if (udp_) {
        ready["udp"] = udp_->path();
    }
    out_.keep("ready " + ready.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n");
    see_ready_off();
    if (options_.json) {
        observers_.add(json_);  // not before: the ready line is the first
    }
    err_.write(
        fmt::format("This is fauxboard, an emulator: there is no real printer here.\n"
                    "{} on {}{}. Ctrl-C ends it.\n",
                    profile_->title.empty() ? profile_->name : profile_->title, link_->describe(),
                    host_link_ ? ", its USB port on " + host_link_->describe() : std::string()));
}

/// Until the line that scripts wait for has been taken. Where it never can be, nobody should wait.
void Run::see_ready_off() {
    if (!out_.flush()) {
        return ready_retry_.after(ready_retry);
    }
    const int error = out_.error();
    if (error != 0 && error != EPIPE && error != EBADF) {  // a closed stdout wants to hear nothing
        throw link::HostError(fmt::format("The line \"ready\" cannot be written to stdout ({}).",
                                          std::system_category().message(error)));
    }
}

/// Who binds beyond this computer may not know that anybody can then drive the board.
void Run::warn_of_network() {
    std::vector<std::string> open{link_->kind() == "tcp" ? link_->path() : ""};
    open.push_back(host_link_ && host_link_->kind() == "tcp" ? host_link_->path() : "");
    open.push_back(udp_ ? udp_->path() : "");
    for (const std::string& path : open) {
        if (!path.empty() && link::reaches_network(path)) {
            say(board::Level::warning,
                fmt::format("{} can be reached from other computers; whoever reaches it can drive this board",
                            path));
        }
    }
}

void Run::reload() {
    try {
        auto profile = host::load_profile_by_name(options_.profile);
        watch_.watch(profile->files);
        profile_ = profile;
        live_->reload(std::move(profile));
        if (control_) {
            control_->on_reload();
        }
        say(board::Level::info, "the changed profile is in force");
    } catch (const behaviour::ProfileError& error) {
        say(board::Level::error, "the changed profile is wrong, the one before stays in force:");
        for (const behaviour::Problem& problem : error.problems()) {
            say(board::Level::error, problem.sentence());
        }
    } catch (const std::exception& error) {  // of the system: out of memory, say
        say(board::Level::error,
            fmt::format("the changed profile cannot be loaded ({}), the one before stays in force",
                        error.what()));
    }
}

void Run::say_summary() {
    const board::Counters& c = board_->counters();
    const link::LinkStats& l = link_->stats();
    err_.write(
        fmt::format("After {:.3f} s: {} lines heard, {} said, on all lines. Bad frames {}, too long {}, "
                    "unknown codes {}, "
                    "no rule {}, requests lost {}, messages lost {}, cut {}. Bytes of the main line: in {}, "
                    "out {}, lost {}.\n",
                    machine::to_seconds(live_->now()), c.lines_received, c.lines_sent, c.bad_frames,
                    board_->lines_too_long(), c.unknown_codes, c.unmatched, c.requests_lost, c.messages_lost,
                    c.lines_cut, l.bytes_in, l.bytes_out, l.bytes_lost));
    for (const fault::FaultStatus& status : link_->list()) {
        err_.write(host::fault_sentence(status) + "\n");
    }
    for (const machine::Fault& broken : board_->machine().faults.list()) {
        err_.write(fault::printer_fault_sentence(broken) + "\n");
    }
}

void Run::on_signal(int number) {
    if (script_) {
        script_->interrupt("by " + link::signal_name(number));
    }
    loop_.stop();
}

ExitCode Run::operator()() {
    set_up();
    open_control();
    open_script();
    open_network();
    link_->open(*live_);
    if (options_.host.wanted()) {
        host_link_ = make_host_link();
        host_link_->open(live_->attach(board::Channel::host, *host_link_));
    }
    say_ready();
    warn_of_network();
    if (options_.reload && !scenario_) {  // which was checked against this one
        watch_.watch(profile_->files);
        if (!watch_.works()) {
            say(board::Level::info,
                "this system does not tell of changed files; changes of the profile are "
                "not noticed");
        }
    }
    live_->start(options_.duration, [this] {
        if (script_) {
            script_->interrupt("by --duration");
        }
        loop_.stop();
    });
    if (plug_) {
        plug_->start();
    }
    if (script_) {
        script_->start();
    }
    clock_->run();
    if (control_) {
        control_->close();
    }
    if (udp_) {
        udp_->close();
    }
    link_->close();
    if (plug_) {
        plug_->close();
    }
    if (host_link_) {
        host_link_->close();
    }
    log_.finish(live_->now());
    say_summary();
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
        return complain("run", ExitCode::bad_input, error.what());
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
