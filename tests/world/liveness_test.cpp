// The liveness matrix: every line, and the control channel, in every state of the machine gets an answer to
// every harmless request. States stand in tables (machine_states.cpp); requests of a line are what it answers
// when the board is at rest.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "emulator/host/profile_files.h"
#include "emulator/world/cast.h"
#include "protocol/command.h"
#include "tests/world/live_bench.h"
#include "tests/world/machine_states.h"

namespace fauxboard::world {
namespace {

using namespace std::chrono_literals;

constexpr std::array channels{Channel::main, Channel::host, Channel::network};
/// Within which a line answers, whatever the machine is doing: queues, ticks and a stalled main loop
/// included.
constexpr SimTime patience = 8s;
/// Some boards hang when datagrams come faster.
constexpr SimTime between_datagrams = 200ms;
/// The control channel answers at once. The last is for boards with a screen of their own.
constexpr std::array control_requests{R"({"id": 7, "op": "status"})",   R"({"id": 7, "op": "get"})",
                                      R"({"id": 7, "op": "describe"})", R"({"id": 7, "op": "talk"})",
                                      R"({"id": 7, "op": "drawing"})",  R"({"id": 7, "op": "page"})"};

struct Count {
    std::size_t cells = 0;
    std::size_t states = 0;
    std::size_t requests = 0;
    std::size_t dead_on_purpose = 0;  ///< this fault is a board whose program stands still
};

/// Whether the line's commands stand in the one row with those of the USB side.
bool takes_turns(const behaviour::Profile& profile, Channel channel) {
    return channel == Channel::host ||
           (channel == Channel::main && profile.line.framing == behaviour::Framing::commands);
}

/// Whether the request is one that waits until the machine has done what it is doing.
bool holds_up(const behaviour::Profile& profile, Channel channel, const Probe& probe) {
    protocol::Command command;
    const auto* const rules =
        protocol::parse_command(probe.request, command) ? profile.rules_for(channel, command) : nullptr;
    return channel == Channel::main && rules != nullptr &&
           std::any_of(rules->begin(), rules->end(), [](const behaviour::Rule& r) { return r.until_done; });
}

bool answers(LiveBench& bench, Channel channel, const Probe& probe, SimTime within) {
    bench.forget(channel);
    bench.say(channel, probe.request);
    const SimTime end = bench.now() + within;
    while (bench.now() < end && !probe.answered_by(bench.heard(channel))) {
        bench.pass(100ms);
    }
    const bool answered = probe.answered_by(bench.heard(channel));
    bench.pass(channel == Channel::network ? between_datagrams : SimTime{0});
    return answered;
}

/// The matrix of one board.
class Matrix {
  public:
    explicit Matrix(std::string name) : name_(std::move(name)), profile_(host::load_profile_by_name(name_)) {
        count_.requests = control_requests.size() - (profile_->screen.empty() ? 1 : 0);
        for (const Channel channel : channels) {
            probes_[static_cast<std::size_t>(channel)] = probes_of(profile_, channel);
            count_.requests += probes_[static_cast<std::size_t>(channel)].size();
        }
    }

    Count fill() {
        LiveBench model(profile_);
        for (const State& state : states_of(model)) {
            LiveBench bench(profile_);
            state.enter(bench);
            if (state.prints) {
                CHECK_MESSAGE(bench.printing(), fmt::format("{} is not {}", name_, state.name));
            }
            ++count_.states;
            ask_on_lines(bench, state);
            ask_control(bench, state);
        }
        return count_;
    }

  private:
    void ask_on_lines(LiveBench& bench, const State& state) {
        bool held_up = false;  // by a request before, and with it all that come behind it
        for (const Channel channel : channels) {
            for (const Probe& probe : probes_[static_cast<std::size_t>(channel)]) {
                if (bench.printer().hung()) {
                    ++count_.dead_on_purpose;
                    continue;
                }
                const bool turns = state.own_command && takes_turns(*profile_, channel);
                held_up = held_up || holds_up(*profile_, channel, probe);
                const bool waits = turns || (held_up && channel == Channel::main);
                if (turns) {
                    bench.machine([](machine::Machine& m) { m.user_continues(); });
                }
                const bool answered = answers(bench, channel, probe, waits ? SimTime{1h} : patience);
                CHECK_MESSAGE(answered,
                              fmt::format("{}, {}: {} on the {} line wants \"{}\" and hears \"{}\"", name_,
                                          state.name, probe.request, board::other_end(channel), probe.answer,
                                          bench.heard(channel)));
                ++count_.cells;
            }
        }
    }

    /// It has nothing to do with the board's program, and answers when that stands still, too.
    void ask_control(LiveBench& bench, const State& state) {
        for (std::size_t i = 0; i + (bench.has_screen() ? 0 : 1) < control_requests.size(); ++i) {
            const char* const request = control_requests[i];
            const std::string_view heard = bench.ask(request);
            const bool answered = heard.find(R"("id":7)") != std::string_view::npos &&
                                  heard.find(R"("ok":true)") != std::string_view::npos;
            CHECK_MESSAGE(answered, fmt::format("{}, {}: {} on the control channel hears \"{}\"", name_,
                                                state.name, request, heard));
            ++count_.cells;
        }
    }

    std::string name_;
    std::shared_ptr<const behaviour::Profile> profile_;
    std::array<std::vector<Probe>, behaviour::channel_count> probes_;
    Count count_;
};

TEST_CASE("liveness: every line answers every harmless request in every state of the machine") {
    std::size_t cells = 0;
    std::string told;
    for (const host::ProfileEntry& entry : host::list_profiles()) {
        if (entry.name.ends_with("-base")) {
            continue;
        }
        const Count count = Matrix(entry.name).fill();
        told += fmt::format("\n{:<22}{:>4} states{:>4} requests{:>6} cells{:>4} that hang on purpose",
                            entry.name, count.states, count.requests, count.cells, count.dead_on_purpose);
        CHECK(count.cells + count.dead_on_purpose == count.states * count.requests);
        cells += count.cells;
    }
    MESSAGE(cells << " cells" << told);
    CHECK(cells > 10'000);
}

}  // namespace
}  // namespace fauxboard::world
