// `fauxboard send`: the screen's side of a line, one command after the other.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/host/clock.h"
#include "emulator/host/json_log.h"
#include "emulator/host/line_log.h"
#include "emulator/host/profile_files.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/link.h"
#include "emulator/link/ports.h"
#include "protocol/annotate.h"
#include "tools/option_values.h"
#include "tools/patience.h"
#include "tools/profile_words.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using machine::SimTime;

struct SendOptions {
    std::string port;
    std::string tcp;
    unsigned baud = 115200;
    bool bare = false;
    bool json = false;
    std::string profile;  ///< whose words are used; empty: the protocol's alone
    bool all = false;     ///< show what was said before, too
    unsigned wait_ms = 500;
    std::vector<std::string> commands;
};

/// What a pseudo-terminal kept for whoever comes is there at once.
constexpr SimTime settle = std::chrono::milliseconds(60);

/// A board that is just starting says one line a tick: over when it says none for so long, and waited for no
/// longer than that.
constexpr SimTime start_pause = std::chrono::milliseconds(120);
constexpr SimTime longest_start = std::chrono::milliseconds(1500);

/// A line that talks all the time (a printing board's) is quiet never: so many quiet times are enough.
constexpr int patience = 10;

bool is_framed(std::string_view command) {
    return command.size() > 1 && command[0] == 'N' &&
           (command[1] == '-' || std::isdigit(static_cast<unsigned char>(command[1])) != 0);
}

/// The line for a command, line end included.
std::string line_of(const std::string& command, bool bare) {
    return bare || is_framed(command) ? command + "\r\n" : protocol::frame(command);
}

/// A sentence about a command that cannot be meant; empty for one that can.
std::string objection(const std::string& command) {
    if (command.empty()) {
        return "an empty command";
    }
    if (std::any_of(command.begin(), command.end(),
                    [](char c) { return c == '\r' || c == '\n' || c == '\0'; })) {
        return "a command is one line";
    }
    const bool parameter = std::string_view("ABCDEFHIJKPQRSUVWXYZ").find(command[0]) != std::string::npos &&
                           command.find_first_not_of("0123456789.-", 1) == std::string::npos;
    return parameter
               ? fmt::format("'{0}' is a parameter; quote a command with its parameters: 'M104 {0}'", command)
               : std::string();
}

/// Sends the commands over an open link and shows the talk.
class Talk final : public link::LinkListener {
  public:
    /// `profile` may be null.
    Talk(const SendOptions& options, std::shared_ptr<const behaviour::Profile> profile, link::EventLoop& loop)
        : options_(options),
          loop_(loop),
          clock_(host::make_clock(loop, host::Speed{})),
          alarm_(clock_->make_alarm([this] { wake(); })),
          out_(STDOUT_FILENO, host::TextOutput::WhenFull::wait),
          json_(out_),
          text_(out_, host::Detail::verbose, 0),
          log_(options.json ? static_cast<host::LiveObserver&>(json_) : text_) {
        const auto words = [profile = std::move(profile)](board::Channel channel,
                                                          const protocol::DecodedLine& line) {
            std::string own = profile ? profile_words(*profile, channel, line) : std::string();
            const bool unknown = line.code == nullptr && line.direction == protocol::Direction::to_board;
            if (own.empty() && !profile && unknown && !line.code_text.empty()) {
                own = line.code_text + ": in no table; a profile's own words come with --profile";
            }
            return own;
        };
        json_.ask(words);
        text_.ask(words);
    }

    ExitCode run(link::Link& link) {
        link_ = &link;
        clock_->start();
        link.open(*this);
        quiet_until_ = clock_->now() + settle;
        limit_ = longest_start;
        alarm_->at(quiet_until_);
        clock_->run();
        link.close();
        return result_;
    }

    void on_bytes(std::string_view bytes) override {
        splitter_.feed(bytes, [this](std::string_view line) {
            if (!begun_ && !options_.all) {
                ++before_;
                return;
            }
            text_.call_peer(peer_.at(protocol::decode_line(line, protocol::Direction::to_screen)));
            log_.on_sent(clock_->now(), board::Channel::main, line);
            answered_ = true;
        });
        quiet_until_ = std::min(clock_->now() + (begun_ ? wait() : start_pause), limit_);
    }

    void on_state(link::LinkState state, std::string_view why) override {
        if (state != link::LinkState::up) {
            finish(complain("send", ExitCode::no_port, why));
        }
    }

  private:
    SimTime wait() const { return std::chrono::milliseconds(options_.wait_ms); }

    void finish(ExitCode result) {
        result_ = result;
        loop_.stop();
    }

    void next() {
        if (at_ == options_.commands.size()) {
            loop_.stop();
            return;
        }
        const std::string line = line_of(options_.commands[at_], options_.bare);
        const std::string_view body = std::string_view(line).substr(0, line.size() - 2);
        const SimTime now = clock_->now();
        text_.call_peer(peer_.at(protocol::decode_line(body, protocol::Direction::to_board)));
        log_.on_received(now, board::Channel::main, body, board::Verdict::accepted);
        link_->write(line);
        answered_ = false;
        quiet_until_ = now + wait();
        limit_ = now + patience * wait();
        alarm_->at(quiet_until_);
    }

    void wake() {
        if (clock_->now() < quiet_until_) {
            alarm_->at(quiet_until_);
            return;
        }
        if (!std::exchange(begun_, true)) {
            return begin();
        }
        judge(options_.commands[at_]);
        ++at_;
        next();
    }

    /// What was said to nobody in particular, at power-on say, is no answer.
    void begin() {
        if (before_ != 0 && !options_.json) {
            log_.on_notice(clock_->now(), board::Level::info,
                           fmt::format("{} line{} that had been said before left out; --all shows them",
                                       before_, before_ == 1 ? "" : "s"));
        }
        next();
    }

    void judge(const std::string& command) {
        const protocol::DecodedLine decoded = protocol::decode_line(command, protocol::Direction::to_board);
        if (!answered_ && decoded.code != nullptr && !decoded.code->answer.empty()) {
            result_ = complain("send", ExitCode::timed_out,
                               fmt::format("nothing came back for '{}' in {} ms; expected {}", command,
                                           options_.wait_ms, decoded.code->answer));
        }
    }

    const SendOptions& options_;
    link::EventLoop& loop_;
    std::unique_ptr<host::Clock> clock_;
    std::unique_ptr<host::Alarm> alarm_;
    host::TextOutput out_;
    host::JsonLog json_;
    host::LineLog text_;
    host::LiveObserver& log_;
    protocol::PeerName peer_;
    protocol::LineSplitter splitter_;
    link::Link* link_ = nullptr;
    std::size_t at_ = 0;
    std::size_t before_ = 0;  ///< lines that came before the first command
    bool begun_ = false;
    bool answered_ = false;
    SimTime quiet_until_{0};
    SimTime limit_{0};
    ExitCode result_ = ExitCode::ok;
};

ExitCode send(const SendOptions& options) {
    if (!options.bare) {
        for (const std::string& command : options.commands) {
            if (const std::string wrong = objection(command); !wrong.empty()) {
                return complain("send", ExitCode::usage, wrong);
            }
        }
    }
    try {
        link::EventLoop loop;
        const std::string port = options.port == "auto" ? link::pick_auto_port() : options.port;
        if (options.tcp.empty()) {
            wait_for_port(port);
        }
        const std::unique_ptr<link::Link> link = options.tcp.empty()
                                                     ? link::make_port_link(loop, port, options.baud)
                                                     : link::make_tcp_connect_link(loop, options.tcp);
        auto profile = options.profile.empty() ? nullptr : host::load_profile_by_name(options.profile);
        return Talk(options, std::move(profile), loop).run(*link);
    } catch (const behaviour::ProfileError& error) {
        return complain("send", ExitCode::bad_input, error.what());
    } catch (const link::LinkError& error) {
        return complain("send", ExitCode::no_port, error.what());
    }
}

}  // namespace

void add_send(CLI::App& app, ExitCode& exit) {
    CLI::App* command =
        app.add_subcommand("send", "Send commands as a screen would, and show what comes back");
    const auto options = std::make_shared<SendOptions>();
    CLI::Option_group* line = command->add_option_group("line", "Where the board is");
    line->add_option("--port", options->port, "Serial port, pseudo-terminal, or 'auto'")
        ->type_name("DEV|auto");
    line->add_option("--tcp", options->tcp, "Connect to a socket")
        ->type_name("HOST:PORT")
        ->check(wrong_address, "", "");
    line->require_option(1);
    add_baud(*command, options->baud, "Bits per second (115200)");
    command->add_flag("--bare", options->bare, "Send as it is, without prefix and checksum");
    command->add_option("--wait", options->wait_ms, "Quiet time that ends an answer, in ms (500)")
        ->type_name("MS")
        ->check(whole_between(1, 3'600'000));
    add_words_of(*command, options->profile);
    command->add_flag("--all", options->all, "Show what had been said before the first command, too");
    command->add_flag("--json", options->json, "The talk as JSON lines");
    command->add_option("COMMAND", options->commands, "'M104 S200': framed unless it is already")
        ->required()
        ->type_name("");
    command->callback([options, &exit] { exit = send(*options); });
}

}  // namespace fauxboard::tools
