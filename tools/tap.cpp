// `fauxboard tap`: listens in between two ports.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "emulator/host/clock.h"
#include "emulator/host/faulty_link.h"
#include "emulator/host/json_log.h"
#include "emulator/host/line_faults.h"
#include "emulator/host/recorder.h"
#include "emulator/host/tap.h"
#include "emulator/host/tap_end.h"
#include "emulator/host/tap_log.h"
#include "emulator/host/tap_talk.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/host_error.h"
#include "emulator/record/pcapng.h"
#include "tools/file_roles.h"
#include "tools/option_values.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using host::TapSide;
using machine::SimTime;

constexpr SimTime report_period{10'000'000};

struct TapOptions {
    std::vector<std::string> ends;
    unsigned baud = 115200;
    std::optional<TapSide> board;
    std::string record;
    std::string pcapng;
    std::vector<std::string> faults;  ///< as fault::fault_from_text() reads them
    SimTime duration = machine::never;
    host::TapLog::Options log;
    bool verbose = false;
    bool json = false;
};

/// Everything that one tap needs, in the order in which it must come and (backwards) go.
class TapRun final : public host::TapObserver {
  public:
    explicit TapRun(const TapOptions& options)
        : options_(options),
          ends_{host::parse_tap_end(options.ends[0]), host::parse_tap_end(options.ends[1])},
          log_(err_, options.log),
          clock_(host::make_clock(loop_, {})),
          alarm_(clock_->make_alarm([this] { wake(); })),
          signals_(loop_, link::ending_signals(), [this](int) { loop_.stop(); }) {}

    void operator()();

    void on_passed(SimTime now, TapSide from, std::string_view bytes) override {
        talk_->on_passed(now, from, bytes);
        arm();
    }
    void on_link(SimTime now, TapSide side, link::LinkState state, std::string_view why) override {
        talk_->on_link(now, side, state, why);
    }

  private:
    void set_up();
    void check_files() const;
    void add_faults();
    bool screen_is_b() const { return options_.board == TapSide::a; }
    void arm();
    nlohmann::ordered_json ready_end(TapSide side) const;
    void say_ready();
    void say(board::Level level, std::string_view text) { lines_.on_notice(clock_->now(), level, text); }
    void wake();
    void report();
    std::string delay_text() const;
    std::string side_text(TapSide side) const;
    const link::Link& line(TapSide side) const { return side == TapSide::a ? *a_ : *b_; }

    const TapOptions& options_;
    host::TapEnd ends_[2];
    link::EventLoop loop_;
    host::TextOutput out_{STDOUT_FILENO};
    host::TextOutput err_{STDERR_FILENO};
    host::TapLog log_;
    host::JsonLog json_{out_};
    host::Observers lines_;
    std::optional<host::Recorder> recorder_;
    std::optional<record::PcapngWriter> capture_;
    std::unique_ptr<host::Clock> clock_;
    std::unique_ptr<host::Alarm> alarm_;
    std::unique_ptr<link::Link> a_;
    std::unique_ptr<link::Link> b_;
    std::optional<host::FaultyLink> faulty_;  ///< around the screen's end
    std::optional<host::TapTalk> talk_;
    std::optional<host::Tap> tap_;
    link::Signals signals_;
    SimTime next_report_{report_period};
    std::uint64_t reported_ = 0;  ///< TapDelay::count() then
};

/// Before anything is opened: that may empty a file.
void TapRun::check_files() const {
    using Kind = host::TapEnd::Kind;
    FileRoles roles;
    for (const host::TapEnd& end : ends_) {
        if (end.kind == Kind::port && end.name != "auto") {
            roles.talks("an end", end.name);
        } else if (end.kind == Kind::pty) {
            roles.writes("the link to an end", end.name);
        }
    }
    roles.writes("the recording", options_.record);
    roles.writes("the capture", options_.pcapng);
}

void TapRun::set_up() {
    if (ends_[0] == ends_[1] && !ends_[0].name.empty()) {
        throw link::LinkError(fmt::format("Both ends are {}. Name two.", options_.ends[0]));
    }
    check_files();
    if (options_.json) {
        lines_.add(json_);
    } else {
        lines_.add(log_);
    }
    if (!options_.record.empty()) {
        recorder_.emplace(options_.record,
                          [this](SimTime, std::string_view text) { say(board::Level::warning, text); });
        lines_.add(*recorder_);
    }
    if (!options_.pcapng.empty()) {
        capture_.emplace(options_.pcapng, host::time_since_epoch(),
                         [this](std::string_view text) { say(board::Level::warning, text); });
    }
    a_ = host::make_tap_link(loop_, ends_[0], options_.baud);
    b_ = host::make_tap_link(loop_, ends_[1], options_.baud);
    add_faults();
    talk_.emplace(lines_, capture_ ? &*capture_ : nullptr, options_.board);
    tap_.emplace(faulty_ && !screen_is_b() ? *faulty_ : *a_, faulty_ && screen_is_b() ? *faulty_ : *b_,
                 *clock_, *this);
}

/// The screen's end misbehaves: what is shown and recorded is what the board says and gets.
void TapRun::add_faults() {
    if (options_.faults.empty()) {
        return;
    }
    faulty_.emplace(screen_is_b() ? *b_ : *a_, *clock_, fault::Direction::to_board);
    host::LineFaults only_line(*faulty_, nullptr);  // refuses those for another
    for (const std::string& spec : options_.faults) {
        only_line.add(fault::fault_from_text(spec));
    }
    faulty_->on_deed(
        [this](const fault::Deed& deed) { lines_.on_deed(clock_->now(), board::Channel::main, deed); });
}

nlohmann::ordered_json TapRun::ready_end(TapSide side) const {
    nlohmann::ordered_json out{{"link", line(side).kind()}, {"path", line(side).path()}};
    const host::TapEnd& end = ends_[static_cast<std::size_t>(side)];
    if (end.kind == host::TapEnd::Kind::pty && !end.name.empty()) {
        out["name"] = end.name;
    }
    return out;
}

void TapRun::say_ready() {
    const nlohmann::ordered_json ready{{"a", ready_end(TapSide::a)}, {"b", ready_end(TapSide::b)}};
    out_.write("ready " + ready.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n");
    err_.write(fmt::format("Listening in between A, {}, and B, {}. Ctrl-C ends it.\n", a_->describe(),
                           b_->describe()));
}

std::string TapRun::delay_text() const {
    const host::TapDelay& delay = tap_->delay();
    if (delay.count() == 0) {
        return "nothing passed on";
    }
    return fmt::format("passed on {} times, after {} us at least, {} us in the middle, {} us at most",
                       delay.count(), delay.min().count(), delay.median().count(), delay.max().count());
}

std::string TapRun::side_text(TapSide side) const {
    const link::LinkStats& from = tap_->stats(side);
    const link::LinkStats& to = tap_->stats(other(side));
    const char* const ways[] = {"A → B", "B → A"};
    return fmt::format("{} {} bytes read, {} passed on, {} lost, {} lines",
                       ways[static_cast<std::size_t>(side)], from.bytes_in, to.bytes_out, to.bytes_lost,
                       talk_->lines(side));
}

void TapRun::report() {
    if (tap_->delay().count() != reported_) {
        reported_ = tap_->delay().count();
        say(board::Level::info, delay_text());
    }
}

void TapRun::arm() {
    alarm_->at(std::min({talk_->due(), options_.duration, options_.verbose ? next_report_ : machine::never}));
}

void TapRun::wake() {
    const SimTime now = clock_->now();
    if (now >= options_.duration) {
        loop_.stop();
        return;
    }
    talk_->tick(now);
    if (options_.verbose && now >= next_report_) {
        report();
        next_report_ = now + report_period;
    }
    arm();
}

void TapRun::operator()() {
    set_up();
    clock_->start();
    tap_->open();
    say_ready();
    arm();
    clock_->run();
    tap_->close();
    talk_->finish();
    if (recorder_) {
        recorder_->finish(clock_->now());
    }
    if (capture_) {
        capture_->finish();
    }
    err_.write(fmt::format("After {:.3f} s: {}; {}; {}.\n", machine::to_seconds(clock_->now()),
                           side_text(TapSide::a), side_text(TapSide::b), delay_text()));
    if (faulty_) {
        for (const fault::FaultStatus& status : faulty_->list()) {
            err_.write(host::fault_sentence(status) + "\n");
        }
    }
}

ExitCode tap(const TapOptions& options) {
    if (options.ends.size() != 2) {
        return complain(
            "tap", ExitCode::usage,
            fmt::format("found {}; expected two ends, A and B, to listen in between: `fauxboard tap "
                        "/dev/ttyUSB0 pty=screen`, or a device, auto, tcp:HOST:PORT, "
                        "tcp-listen:HOST:PORT",
                        options.ends.empty() ? "none" : fmt::format("{}", fmt::join(options.ends, " "))));
    }
    try {
        TapRun{options}();
        return ExitCode::ok;
    } catch (const link::HostError& error) {
        return complain("tap", ExitCode::bad_input, error.what());
    } catch (const fault::FaultSpecError& error) {
        return complain("tap", ExitCode::usage, error.what());
    } catch (const link::LinkError& error) {
        return complain("tap", ExitCode::no_port, error.what());
    }
}

void declare(CLI::App& command, TapOptions& options) {
    command
        .add_option("ENDS", options.ends,
                    "Two ends, A and B: a device, auto, pty, pty=LINK, tcp:HOST:PORT (connects) or "
                    "tcp-listen:HOST:PORT")
        ->type_name("DEV DEV")
        ->required()
        ->expected(-1);
    add_baud(command, options.baud, "Bits per second of serial ports")->capture_default_str();
    command
        .add_option_function<std::string>(
            "--board",
            [&options](const std::string& text) { options.board = text == "A" ? TapSide::a : TapSide::b; },
            "Which end is the board (default: as is seen by what is said, else B)")
        ->type_name("A|B")
        ->check(one_of({"A", "B"}));
    command.add_option("--record", options.record, "Write every line to a recording")->type_name("FILE");
    command.add_option("--pcapng", options.pcapng, "Write a capture for Wireshark")->type_name("FILE");
    command
        .add_option(
            "--fault", options.faults,
            "Make the line misbehave: drop:to_screen,every=5 (see `describe faults`); may be repeated. "
            "Without --board, B is the board")
        ->type_name("SPEC")
        ->expected(1)
        ->take_all();
    command.add_flag("--decode", options.log.words, "Say in words what each line means");
    add_duration(command, options.duration, "Stop after this time");
    command.add_flag("--json", options.json, "The talk as JSON lines on stdout, instead of text on stderr");
    CLI::Option* verbose = command.add_flag("-v,--verbose", options.verbose,
                                            "Say every ten seconds how late bytes were passed on");
    command.add_flag("!-q,!--quiet", options.log.lines, "Log warnings and errors only")->excludes(verbose);
}

}  // namespace

void add_tap(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand("tap", "Listen in between two ports and pass everything on");
    const auto options = std::make_shared<TapOptions>();
    declare(*command, *options);
    command->callback([options, &exit] { exit = tap(*options); });
}

}  // namespace fauxboard::tools
