#include "tools/screen_session.h"

#include <fmt/format.h>

#include <csignal>

#include "emulator/host/screen_files.h"
#include "emulator/link/host_error.h"
#include "emulator/link/ports.h"
#include "tools/file_roles.h"
#include "tools/patience.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

/// Of real time: what a busy computer may be late with a reply.
constexpr double late_s = 1;

/// Before anything is opened: that may empty a file.
void check_files(const ScreenOptions& options) {
    FileRoles roles;
    if (options.control.empty()) {
        roles.reads("the screen", host::load_screen_by_name(options.screen)->files);
    }
    roles.talks("the line", options.port == "auto" ? std::string() : options.port);
    roles.writes("the control channel", options.control);
    roles.writes("the recording", options.record);
    roles.writes("the JUnit report", options.junit);
    roles.writes("the picture", options.png);
}

}  // namespace

ScreenSession::ScreenSession(const ScreenOptions& options)
    : options_(options),
      screen_(host::load_screen_by_name(options.screen)),
      clock_(host::make_clock(loop_, options.speed)),
      signals_(loop_, link::ending_signals(), [this](int) {
          interrupted_ = true;
          finish(ExitCode::failed);
      }) {
    if (!options.record.empty()) {
        recorder_.emplace(options.record, [](host::SimTime, std::string_view text) {
            complain("screen", ExitCode::bad_input, text);
        });
        observers_.add(*recorder_);
    }
    link_ = make_link();
}

std::unique_ptr<link::Link> ScreenSession::make_link() {
    if (!options_.tcp.empty()) {
        return link::make_tcp_connect_link(loop_, options_.tcp);
    }
    const std::string port = options_.port == "auto" ? link::pick_auto_port() : options_.port;
    wait_for_port(port);
    return link::make_port_link(loop_, port, options_.baud);
}

ExitCode ScreenSession::run(host::ScreenUser& user) {
    live_.emplace(screen_, *link_, *clock_, &observers_, &user);
    link_->open(*live_);
    live_->start();
    clock_->run();
    link_->close();
    if (recorder_) {
        recorder_->finish(clock_->now());
    }
    return result_;
}

void ScreenSession::finish(ExitCode code) {
    result_ = code;
    loop_.stop();
}

void ScreenSession::fail(ExitCode code, std::string_view sentence) {
    finish(complain("screen", code, sentence));
}

host::SimTime ScreenSession::first_word_due() const {
    return screen_.profile().line.deaf +
           machine::from_seconds(machine::to_seconds(options_.timeout) * options_.speed.factor);
}

host::SimTime ScreenSession::slack() const {
    return machine::from_seconds(late_s * std::max(0.0, options_.speed.factor - 1));
}

std::string ScreenSession::silence_sentence() const {
    return fmt::format(
        "nothing came from the board on {} in {:g} s. Is it on, is its speed {} bit/s, are RX and TX "
        "crossed? "
        "--timeout waits longer",
        link_->describe(), machine::to_seconds(options_.timeout), options_.baud);
}

ExitCode guard_screen(const ScreenOptions& options, const std::function<ExitCode()>& body) {
    try {
        check_files(options);
        return body();
    } catch (const behaviour::ProfileError& error) {
        return complain("screen", ExitCode::bad_input, error.what());
    } catch (const link::HostError& error) {
        return complain("screen", ExitCode::bad_input, error.what());
    } catch (const link::LinkError& error) {
        return complain("screen", ExitCode::no_port, error.what());
    }
}

}  // namespace fauxboard::tools
