// `fauxboard fleet`: many boards in one process, on one event loop.

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "emulator/host/profile_files.h"
#include "emulator/host/program_log.h"
#include "emulator/host/text_output.h"
#include "emulator/link/host_error.h"
#include "emulator/panel/panel.h"
#include "tools/board_unit.h"
#include "tools/commands.h"
#include "tools/file_roles.h"
#include "tools/fleet_file.h"
#include "tools/option_values.h"
#include "tools/ready_line.h"
#include "tools/report.h"
#include "tools/run_options.h"

namespace fauxboard::tools {
namespace {

struct FleetArguments {
    std::string file;
    std::optional<std::string> web;
    host::Speed speed;
    machine::SimTime duration = machine::never;
    bool quiet = false;
    LogOptions log;
};

/// Says of one board what a person has to know: with its name, warnings and errors unless asked for more.
class Troubles final : public host::LiveObserver {
  public:
    Troubles(host::TextOutput& err, std::string name, host::LogLevel least)
        : err_(err), name_(std::move(name)), least_(least) {}
    void on_received(host::SimTime, board::Channel, std::string_view, board::Verdict) override {}
    void on_sent(host::SimTime, board::Channel, std::string_view) override {}
    void on_notice(host::SimTime now, board::Level level, std::string_view text) override {
        if (host::log_level(level) >= least_) {
            err_.write(fmt::format("{}: {:.3f} s: {}\n", name_, machine::to_seconds(now), text));
        }
    }
    void on_link(host::SimTime now, link::LinkState, std::string_view why) override {
        on_notice(now, board::Level::info, why);
    }
    void on_world(host::SimTime now, std::string_view words) override {
        on_notice(now, board::Level::info, words);
    }

  private:
    host::TextOutput& err_;
    std::string name_;
    host::LogLevel least_;
};

/// All boards, in the order of their file.
class FleetRun {
  public:
    FleetRun(const FleetArguments& arguments, Fleet fleet)
        : arguments_(arguments),
          fleet_(std::move(fleet)),
          out_(STDOUT_FILENO),
          err_(STDERR_FILENO),
          signals_(loop_, link::ending_signals(), [this](int) { loop_.stop(); }) {}

    ExitCode operator()() {
        load_profiles();
        check_files();
        if (arguments_.log.wanted()) {
            log_file_.emplace(arguments_.log.for_file(),
                              [this](std::string_view text) { err_.write(std::string(text) + "\n"); });
        }
        for (FleetBoard& board : fleet_.boards) {
            add(board);
        }
        if (arguments_.web) {
            std::vector<panel::Panel::Shown> shown;
            for (std::size_t i = 0; i < members_.size(); ++i) {
                BoardUnit& unit = members_[i]->unit;
                shown.push_back({fleet_.boards[i].name, *unit.target(),
                                 [&unit](const std::string& text) { unit.say(board::Level::debug, text); }});
            }
            panel_.emplace(loop_, *arguments_.web, std::move(shown));
        }
        say_ready();
        for (const auto& member : members_) {  // the page is everybody's: told of once
            member->unit.warn_of_network(panel_ && member == members_.front() ? panel_->address() : "");
        }
        std::size_t running = members_.size();
        for (const auto& member : members_) {
            member->unit.start(arguments_.duration, [this, &running] {
                if (--running == 0) loop_.stop();
            });
        }
        loop_.run();
        for (const auto& member : members_) {
            if (member->unit.target() != nullptr) member->unit.target()->on_end();
        }
        panel_.reset();
        for (const auto& member : members_) {
            member->unit.close();
        }
        return ExitCode::ok;
    }

  private:
    /// One board with those who look at it.
    struct Member {
        Member(FleetRun& run, const FleetBoard& board, std::shared_ptr<const behaviour::Profile> profile)
            : troubles(run.err_, board.name, run.arguments_.log.stderr_level()),
              unit(run.loop_, board.options, std::move(profile), nullptr, observers) {
            if (!run.arguments_.quiet) observers.add(troubles);
            if (run.log_file_) {
                const LogOptions& wanted = run.arguments_.log;
                observers.add(log.emplace(
                    *run.log_file_, host::ProgramLog::Style{wanted.file_level(), wanted.json, board.name}));
                for (const std::string& words : first_words(board.options, *unit.profile())) {
                    log->say(machine::SimTime{0}, host::LogLevel::info, "program", words);
                }
            }
        }
        host::Observers observers;
        Troubles troubles;
        std::optional<host::ProgramLog> log;
        BoardUnit unit;
    };

    void load_profiles() {
        for (const FleetBoard& board : fleet_.boards) {
            auto& profile = profiles_[board.options.profile];
            if (!profile) {
                profile = host::load_profile_by_name(board.options.profile);
            }
        }
    }

    /// Before anything is opened: that may empty a file.
    void check_files() const {
        FileRoles roles;
        roles.reads("the fleet's file", arguments_.file);
        for (const auto& [name, profile] : profiles_) {
            roles.reads("the profile", profile->files);
        }
        roles.add_log(arguments_.log);
        for (const FleetBoard& board : fleet_.boards) {
            roles.add_board(board.options, " of " + board.name);
        }
    }

    void add(FleetBoard& board) {
        board.options.speed = arguments_.speed;
        Member& member = *members_.emplace_back(
            std::make_unique<Member>(*this, board, profiles_.at(board.options.profile)));
        member.unit.set_up();
        if (arguments_.web || !board.options.control.empty()) {
            member.unit.open_target([this] { loop_.stop(); });
        }
        member.unit.open();
    }

    void say_ready() {
        nlohmann::ordered_json ready{{"boards", nlohmann::ordered_json::array()}};
        for (std::size_t i = 0; i < members_.size(); ++i) {
            nlohmann::ordered_json one{{"name", fleet_.boards[i].name}};
            nlohmann::ordered_json lines = members_[i]->unit.ready();
            if (lines.contains("name")) {  // of its pty; here the name is the board's
                lines["pty"] = std::move(lines["name"]);
                lines.erase("name");
            }
            one.update(lines);
            ready["boards"].push_back(std::move(one));
        }
        if (panel_) {
            ready["web"] = panel_->address();
        }
        ready_.say(ready);
        err_.write(fmt::format(
            "This is fauxboard, an emulator: there are no real printers here.\n"
            "{} boards. Ctrl-C ends them.\n{}",
            members_.size(), panel_ ? "To look at them, open " + panel_->address() + "\n" : std::string()));
    }

    const FleetArguments& arguments_;
    Fleet fleet_;
    link::EventLoop loop_;
    host::TextOutput out_;
    host::TextOutput err_;
    std::optional<host::LogFile> log_file_;  ///< of all boards
    ReadyLine ready_{loop_, out_};
    std::map<std::string, std::shared_ptr<const behaviour::Profile>>
        profiles_;  ///< by what the file calls them
    std::vector<std::unique_ptr<Member>> members_;
    std::optional<panel::Panel> panel_;
    link::Signals signals_;
};

/// Each board takes two or three descriptors: as many as the system lets us have.
void allow_descriptors() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < limit.rlim_max) {
        limit.rlim_cur = limit.rlim_max;
        (void)::setrlimit(RLIMIT_NOFILE, &limit);
    }
}

ExitCode fleet(const FleetArguments& arguments) {
    allow_descriptors();
    try {
        return FleetRun{arguments, read_fleet(arguments.file)}();
    } catch (const behaviour::ProfileError& error) {
        return complain("fleet", ExitCode::bad_input, error.what());
    } catch (const link::HostError& error) {
        return complain("fleet", ExitCode::bad_input, error.what());
    } catch (const fault::FaultSpecError& error) {
        return complain("fleet", ExitCode::bad_input, error.what());
    } catch (const link::LinkError& error) {
        return complain("fleet", ExitCode::no_port, error.what());
    }
}

}  // namespace

void add_fleet(CLI::App& app, ExitCode& exit) {
    CLI::App* command =
        app.add_subcommand("fleet", "Be many boards in one process, each on lines of its own");
    const auto arguments = std::make_shared<FleetArguments>();
    command
        ->add_option("FILE", arguments->file,
                     "The boards, as JSON: {\"boards\": [{\"profile\": ..., \"count\": 20}]}")
        ->type_name("FILE.json")
        ->required();
    add_web(*command, arguments->web);
    add_speed(*command, arguments->speed, false);
    add_duration(*command, arguments->duration, "Stop after this virtual time");
    command->add_flag("-q,--quiet", arguments->quiet, "Say nothing of the boards' troubles");
    add_log(*command, arguments->log);
    command->callback([arguments, &exit] { exit = fleet(*arguments); });
}

}  // namespace fauxboard::tools
