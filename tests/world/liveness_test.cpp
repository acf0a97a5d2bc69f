// The liveness matrix: every line in every state of the machine gets an answer to every harmless request.
// States stand in a table, and all faults of the printer are states as well; requests are what a line
// answers when the board is at rest.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/filament/printer.h"
#include "emulator/host/profile_files.h"
#include "emulator/world/cast.h"
#include "emulator/world/disk.h"
#include "emulator/world/stores.h"
#include "protocol/command.h"
#include "protocol/framing.h"

namespace fauxboard::world {
namespace {

using board::Channel;
using machine::SimTime;
using namespace std::chrono_literals;

constexpr std::array channels{Channel::main, Channel::host, Channel::network};
/// Within which a line answers, whatever the machine is doing: queues, ticks and a stalled main loop
/// included.
constexpr SimTime patience = 8s;

/// A board with a card, and somebody on each line.
class Bench {
  public:
    explicit Bench(const std::shared_ptr<const behaviour::Profile>& profile) : profile_(profile) {
        disk_.put("part.gco", small_print(400));
        disk_.put("waits.gco", "G28\nM0 wait\nG1 X10\n");
        disk_.put("endless.gco", std::string(3'000'000, 'x'));
        disk_.put("moves.gco", many_moves());
        machine::Services services;
        services.sd = &disk_;
        services.eeprom = &eeprom_;
        services.job_place = &place_;
        board_.emplace(profile, services, board::Options{});
        board_->connect(Channel::host, true);
        board_->power_on(SimTime{0});
        pass(30s);
    }

    void pass(SimTime time) {
        const SimTime end = now_ + time;
        for (SimTime due{0}; due <= end;) {
            due = board_->advance(end);
            take();
        }
        now_ = end;
    }
    void say(Channel channel, const std::string& body) {
        if (channel == Channel::network) {
            board_->receive_datagram(now_, 1, body);
        } else {
            const bool framed =
                channel == Channel::main && profile_->line.framing == behaviour::Framing::frames;
            board_->receive(now_, framed ? protocol::frame(body) : body + "\n", channel);
        }
        take();
    }
    void machine(const std::function<void(machine::Machine&)>& use) {
        board_->tinker(now_, use);
        take();
    }
    void print(std::string_view file, SimTime time = 5min) {
        machine([&](machine::Machine& m) {
            m.select_file(file);
            m.start_or_resume_job();
        });
        pass(time);
    }
    bool answers(Channel channel, const Probe& probe, SimTime within) {
        heard_[static_cast<std::size_t>(channel)].clear();
        say(channel, probe.request);
        const SimTime end = now_ + within;
        while (now_ < end && !probe.answered_by(heard(channel))) {
            pass(100ms);
        }
        return probe.answered_by(heard(channel));
    }
    /// What came since the last question.
    std::string_view heard(Channel channel) const { return heard_[static_cast<std::size_t>(channel)]; }
    Disk& disk() { return disk_; }
    machine::Machine& printer() { return board_->machine(); }
    SimTime now() const { return now_; }

  private:
    static std::string many_moves() {
        std::string out = "G28\n";
        for (int i = 0; i < 20'000; ++i) {
            out += i % 2 == 0 ? "G1 X50 F3000\n" : "G1 X51\n";
        }
        return out;
    }
    void take() {
        heard_[0] += board_->output(Channel::main);
        heard_[1] += board_->output(Channel::host);
        board_->clear_output();
        board_->take_datagrams([this](std::uint64_t, std::string_view bytes) { heard_[2] += bytes; });
    }

    std::shared_ptr<const behaviour::Profile> profile_;
    Disk disk_;
    Eeprom eeprom_;
    JobPlace place_;
    std::optional<board::Board> board_;
    SimTime now_{0};
    std::array<std::string, behaviour::channel_count> heard_;
};

struct State {
    std::string name;
    std::function<void(Bench&)> enter;
    /// A command of a host is under way: what hosts ask waits for that, as on a real board.
    bool own_command = false;
};

/// Whether the line's commands stand in the one row with those of the USB side.
bool takes_turns(const behaviour::Profile& profile, Channel channel) {
    return channel == Channel::host ||
           (channel == Channel::main && profile.line.framing == behaviour::Framing::commands);
}

/// What only a printer of filament can do; others stay as they are.
void filament_part(machine::Machine& machine, const std::function<void(filament::Printer&)>& use) {
    if (filament::Printer* const printer = machine::as<filament::Printer>(machine)) {
        use(*printer);
    }
}

/// Whether the request is one that waits until the machine has done what it is doing.
bool holds_up(const behaviour::Profile& profile, Channel channel, const Probe& probe) {
    protocol::Command command;
    const auto* const rules =
        protocol::parse_command(probe.request, command) ? profile.rules_for(channel, command) : nullptr;
    return channel == Channel::main && rules != nullptr &&
           std::any_of(rules->begin(), rules->end(), [](const behaviour::Rule& r) { return r.until_done; });
}

std::vector<State> states() {
    std::vector<State> all{
        {"at rest", [](Bench&) {}},
        {"heating",
         [](Bench& b) {
             b.machine([](machine::Machine& m) {
                 filament_part(
                     m, [](filament::Printer& p) { p.thermal.set_target(filament::HeaterId::nozzle, 200); });
             });
         }},
        {"homing",
         [](Bench& b) {
             b.machine(
                 [](machine::Machine& m) { filament_part(m, [](filament::Printer& p) { p.home(0); }); });
         }},
        {"printing", [](Bench& b) { b.print("part.gco"); }},
        {"printing many short moves", [](Bench& b) { b.print("moves.gco"); }},
        {"printing a line without end", [](Bench& b) { b.print("endless.gco", 1s); }},
        {"pausing",
         [](Bench& b) {
             b.print("part.gco");
             b.machine([](machine::Machine& m) { m.pause_job(); });
         }},
        {"paused",
         [](Bench& b) {
             b.print("part.gco");
             b.machine([](machine::Machine& m) { m.pause_job(); });
             b.pass(2min);
         }},
        {"waiting for the user", [](Bench& b) { b.print("waits.gco"); }},
        {"heating for the print", [](Bench& b) { b.print("part.gco", 10s); }},
        {"stopped",
         [](Bench& b) {
             b.print("part.gco");
             b.machine([](machine::Machine& m) { m.stop_job(); });
         }},
        {"printed", [](Bench& b) { b.print("part.gco", 24h); }},
        {"card out", [](Bench& b) { b.machine([](machine::Machine& m) { m.remove_card(0); }); }},
        {"card out while printing",
         [](Bench& b) {
             b.print("part.gco");
             b.machine([](machine::Machine& m) { m.remove_card(0); });
         }},
        {"disk fails while printing",
         [](Bench& b) {
             b.print("part.gco");
             b.disk().set_trouble(Disk::Trouble::read_fails);
         }},
        {"no filament while printing",
         [](Bench& b) {
             b.print("part.gco");
             b.machine([](machine::Machine& m) {
                 filament_part(m, [](filament::Printer& p) { p.set_filament(false); });
             });
         }},
        {"tuning a heater",
         [](Bench& b) {
             b.machine([](machine::Machine& m) {
                 filament_part(m,
                               [](filament::Printer& p) { p.start_tuning(filament::HeaterId::nozzle, 200); });
             });
         }},
        {"emergency stop",
         [](Bench& b) {
             b.print("part.gco");
             b.machine([](machine::Machine& m) { m.emergency_stop(); });
         }},
        {"upload begun by the network", [](Bench& b) { b.say(Channel::network, "M28 up.ctb"); }},
        {"host waits for heat", [](Bench& b) { b.say(Channel::host, "M109 S200"); }, true},
        {"host waits for a dwell", [](Bench& b) { b.say(Channel::host, "G4 S60"); }, true},
        {"host waits for moves",
         [](Bench& b) {
             for (int i = 0; i < 40; ++i)
                 b.say(Channel::host, i % 2 == 0 ? "G1 X100 F600" : "G1 X1");
         },
         true},
        {"host waits for the user", [](Bench& b) { b.say(Channel::host, "M0"); }, true},
        {"flooded",
         [](Bench& b) {
             for (int i = 0; i < 500; ++i)
                 b.say(Channel::main, "M105");
         }},
        {"half a line lies there", [](Bench& b) { b.say(Channel::main, "\n"); }},
    };
    for (const machine::FaultInfo* const sort : machine::fault_rows()) {
        all.push_back({"broken: " + std::string(sort->name), [sort](Bench& b) {
                           b.print("part.gco");
                           b.machine([&](machine::Machine& m) {
                               m.faults.add(b.now(), machine::default_request(*sort));
                           });
                           b.pass(1min);
                       }});
    }
    return all;
}

TEST_CASE("liveness: every line answers every harmless request in every state of the machine") {
    std::size_t cells = 0;
    std::size_t dead_on_purpose = 0;
    for (const host::ProfileEntry& entry : host::list_profiles()) {
        if (entry.name.ends_with("-base")) {
            continue;
        }
        const auto profile = host::load_profile_by_name(entry.name);
        std::array<std::vector<Probe>, behaviour::channel_count> probes;
        for (const Channel channel : channels) {
            probes[static_cast<std::size_t>(channel)] = probes_of(profile, channel);
        }
        for (const State& state : states()) {
            Bench bench(profile);
            state.enter(bench);
            bool held_up = false;  // by a request before, and with it all that come behind it
            for (const Channel channel : channels) {
                for (const Probe& probe : probes[static_cast<std::size_t>(channel)]) {
                    if (bench.printer().hung()) {
                        ++dead_on_purpose;  // this fault is a board whose program stands still
                        continue;
                    }
                    const bool turns = state.own_command && takes_turns(*profile, channel);
                    held_up = held_up || holds_up(*profile, channel, probe);
                    const bool waits = turns || (held_up && channel == Channel::main);
                    if (turns) {
                        bench.machine([](machine::Machine& m) { m.user_continues(); });
                    }
                    const bool answered = bench.answers(channel, probe, waits ? SimTime{1h} : patience);
                    CHECK_MESSAGE(answered,
                                  fmt::format("{}, {}: {} on the {} line wants \"{}\" and hears \"{}\"",
                                              entry.name, state.name, probe.request,
                                              board::other_end(channel), probe.answer, bench.heard(channel)));
                    ++cells;
                }
            }
        }
    }
    MESSAGE(cells << " cells; " << dead_on_purpose << " more of boards that hang on purpose");
    CHECK(cells > 1000);
}

}  // namespace
}  // namespace fauxboard::world
