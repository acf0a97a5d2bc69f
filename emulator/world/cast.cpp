#include "emulator/world/cast.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "emulator/behaviour/action_words.h"
#include "emulator/board/board.h"
#include "emulator/sliced/sample.h"
#include "emulator/world/disk.h"
#include "protocol/command.h"
#include "protocol/framing.h"

namespace fauxboard::world {
namespace {

using behaviour::Channel;
using machine::SimTime;

constexpr std::uint32_t highest_code = 9999;
constexpr SimTime settling{30'000'000};  ///< boot, and whatever comes by itself at first
constexpr SimTime patience{2'000'000};

struct Harmless {
    std::string_view request;
    /// By what its answers begin where they depend on the state of the machine: a job, a card.
    std::array<std::string_view, 4> states{};
};

/// Requests that change nothing and that boards answer. The first one that a line answers is its probe.
constexpr std::array<Harmless, 14> harmless{
    {{"M105"},
     {"M4002"},
     {"M115"},
     {"M4000"},
     {"M27", {"SD printing byte ", "SD N:", "Not SD printing"}},
     {"M114"},
     {"M2133"},
     {"M119"},
     {"M31"},
     {"M20", {"Begin file list", "begin file list", "No media", "SD: fail"}},
     {"M4001"},
     {"M4006"},
     {"M503"},
     {"M220"}}};

/// What hosts send that no profile need know: the machine carries it out as in a file.
constexpr auto usual = std::to_array<std::string_view>(
    {"G0",   "G1",   "G2",   "G3",   "G4",   "G28",  "G90",  "G91",  "G92",  "M0",   "M17",
     "M18",  "M82",  "M83",  "M84",  "M104", "M106", "M107", "M109", "M117", "M140", "M190",
     "M201", "M203", "M204", "M205", "M220", "M221", "M400", "M600", "T0",   "T1"});

std::string framed(const behaviour::Profile& profile, Channel channel, std::string_view body) {
    return channel == Channel::main && profile.line.framing == behaviour::Framing::frames
               ? protocol::frame(body)
               : std::string(body) + "\n";
}

/// What a fresh board says on a line within the patience, after that request or after none.
std::vector<std::string> said(const std::shared_ptr<const behaviour::Profile>& profile, Channel channel,
                              std::string_view body) {
    board::Board board(profile, {}, {});
    board.connect(channel, true);
    board.power_on(SimTime{0});
    std::string heard;
    bool hearing = false;
    const auto run_to = [&](SimTime end) {
        for (SimTime due{0}; due <= end;) {
            due = board.advance(end);
            heard += hearing ? board.output(channel) : std::string_view{};
            board.clear_output();
            board.take_datagrams([&](std::uint64_t, std::string_view bytes) {
                heard += channel == Channel::network ? bytes : std::string_view{};
            });
        }
    };
    run_to(settling);
    hearing = true;
    if (!body.empty() && channel == Channel::network) {
        board.receive_datagram(settling, 1, body);
    } else if (!body.empty()) {
        board.receive(settling, framed(*profile, channel, body), channel);
        heard += board.output(channel);
        board.clear_output();
    }
    run_to(settling + patience);
    std::vector<std::string> lines;
    while (!heard.empty()) {
        const std::size_t end = std::min(heard.find('\n'), heard.size() - 1);
        std::string line = heard.substr(0, end);
        line.erase(line.find_last_not_of('\r') + 1);
        lines.push_back(std::move(line));
        heard.erase(0, end + 1);
    }
    return lines;
}

/// The words by which a line is known whatever its values are: "N-0 L2 B:" of "N-0 L2 B:22.0 ...".
std::string head_of(const std::string& line) {
    std::size_t end = line.starts_with("N-0 ") ? 4 : 0;
    end = std::min(line.find_first_of(" :", end), line.size() - 1) + 1;
    return line.substr(0, end);
}

bool knows(const behaviour::Profile& profile, Channel channel, const std::string& code) {
    protocol::Command command;
    return protocol::parse_command(code, command) && profile.rules_for(channel, command) != nullptr;
}

/// A fresh board with the files on its card, and a print that was begun by them.
class Trial final : private board::Observer {
  public:
    Trial(const std::shared_ptr<const behaviour::Profile>& profile, Disk& disk, const std::string& file)
        : board_(profile, services(disk), options()) {
        board_.power_on(SimTime{0});
        run_to(settling);
        for (const std::string& words : words_to_print(file)) {
            try {
                for (const behaviour::ActionCall& call : behaviour::parse_action_words(words, *profile)) {
                    board_.act(settling, call);
                }
            } catch (const behaviour::ActionWordsError&) {
                continue;  // not of this machine
            }
        }
        run_to(settling + to_begin);
    }
    /// What it came to; nothing when it did not begin or did not reach its end.
    std::optional<Tally> ended() {
        for (SimTime time = settling; watch_.begun() && !watch_.ended() && time < to_end; time += a_piece) {
            run_to(time);
        }
        return watch_.ended();
    }

  private:
    static constexpr SimTime to_begin = std::chrono::minutes(1);
    static constexpr SimTime to_end = std::chrono::hours(6);
    static constexpr SimTime a_piece = std::chrono::minutes(1);

    static machine::Services services(Disk& disk) {
        machine::Services out;
        out.sd = &disk;
        return out;
    }
    board::Options options() {
        board::Options out;
        out.observer = this;
        return out;
    }
    void on_received(SimTime, Channel, std::string_view, board::Verdict) override {}
    void on_sent(SimTime, Channel, std::string_view) override {}
    void on_notice(SimTime, board::Level, std::string_view) override {}
    void on_event(SimTime, machine::EventId event) override { watch_.see(event, board_.machine()); }
    void run_to(SimTime end) {
        for (SimTime due{0}; due <= end;) {
            due = board_.advance(end);
            board_.clear_output();
        }
    }

    PrintWatch watch_;
    board::Board board_;
};

/// Which of its files such a board prints: those that are called as one is that it prints to its end.
void find_prints(Cast& cast) {
    const auto ending = [](const std::string& path) { return path.substr(path.find('.')); };
    Disk disk;
    for (const auto& [path, content] : cast.files) {
        disk.put(path, content);
    }
    for (const char* path : {"cold.gco", "part.cbddlp", "panel.cbddlp"}) {
        if (const std::optional<Tally> tally = Trial(cast.profile, disk, path).ended(); tally) {
            cast.proof = {path, *tally};
            if (ending(path) == ending("part.cbddlp")) {
                cast.proof.tally[1] = sliced::Sample{}.layers;  // what the file holds, whatever came of it
            }
            break;
        }
    }
    for (const auto& [path, content] : cast.files) {
        if (!cast.proof.file.empty() && ending(path) == ending(cast.proof.file)) {
            cast.prints.push_back(path);
        }
    }
}

std::map<std::string, std::string> files() {
    sliced::Sample of_panel;  // one board prints nothing that is not of its panel's size
    of_panel.width = 1440;
    of_panel.height = 2560;
    return {{"part.gco", small_print(12)},
            {"long.gco", small_print(400)},
            {"empty.gco", ""},
            {"cold.gco", cold_print()},
            {"asks.gco", "G28\nG1 X20 F3000\nM0 take it off\nG1 X40\nM0\nG1 X60\n"},
            {"part.cbddlp", sliced::make_sample({})},
            {"panel.cbddlp", sliced::make_sample(of_panel)}};
}

}  // namespace

Cast make_cast(std::shared_ptr<const behaviour::Profile> profile,
               std::shared_ptr<const screen::ScreenProfile> screen) {
    Cast cast;
    for (const char letter : std::string_view("MGT")) {
        for (std::uint32_t number = 0; number <= highest_code; ++number) {
            const std::string code = letter + std::to_string(number);
            if (knows(*profile, Channel::main, code)) {
                cast.requests.push_back(code);
            }
            if (knows(*profile, Channel::host, code) ||
                std::find(usual.begin(), usual.end(), code) != usual.end()) {
                cast.commands.push_back(code);
            }
        }
    }
    for (const Channel channel : {Channel::main, Channel::host, Channel::network}) {
        const std::vector<Probe> probes = probes_of(profile, channel);
        cast.probes[static_cast<std::size_t>(channel)] =
            probes.empty() ? std::nullopt : std::optional(probes.front());
    }
    cast.files = files();
    cast.profile = std::move(profile);
    find_prints(cast);
    cast.screen = std::move(screen);
    return cast;
}

Cast make_cast(std::shared_ptr<const script::Scenario> scenario) {
    Cast cast = make_cast(scenario->cast.profile, scenario->cast.screen);
    if (scenario->card) {
        for (const machine::BuiltInEntry& entry : *scenario->card) {
            if (!entry.folder) {
                cast.files[entry.name] = entry.content;
            }
        }
    }
    cast.scenario = std::move(scenario);
    return cast;
}

std::vector<Probe> probes_of(const std::shared_ptr<const behaviour::Profile>& profile, Channel channel) {
    std::vector<Probe> probes;
    const std::vector<std::string> by_itself = said(profile, channel, {});
    for (const Harmless& each : harmless) {
        for (const std::string& line : said(profile, channel, each.request)) {
            if (std::find(by_itself.begin(), by_itself.end(), line) == by_itself.end() && !line.empty()) {
                Probe probe{std::string(each.request), head_of(line), {}};
                std::copy_if(each.states.begin(), each.states.end(), std::back_inserter(probe.or_else),
                             [](std::string_view begin) { return !begin.empty(); });
                probes.push_back(std::move(probe));
                break;
            }
        }
    }
    return probes;
}

bool Probe::answered_by(std::string_view heard) const {
    const auto holds = [heard](std::string_view part) { return heard.find(part) != std::string_view::npos; };
    return holds(answer) || std::any_of(or_else.begin(), or_else.end(), holds);
}

std::string small_print(unsigned layers) {
    std::string out =
        ";LAYER_COUNT:" + std::to_string(layers) + "\nM140 S50\nM104 S200\nM109 S200\nG28\nG92 E0\n";
    double e = 0;
    for (unsigned layer = 0; layer < layers; ++layer) {
        fmt::format_to(std::back_inserter(out), ";LAYER:{}\nG1 Z{:.2f} F600\n", layer, 0.2 * (layer + 1));
        for (int side = 0; side < 8; ++side) {
            e += 0.4;
            fmt::format_to(std::back_inserter(out), "G1 X{} Y{} E{:.3f} F3000\n", 50 + side % 3 * 20,
                           50 + side % 5 * 10, e);
        }
    }
    return out + "M104 S0\nM140 S0\nM84\n";
}

std::string cold_print() {
    std::string out = "G21\nG90\nG28\nG1 Z5 F600\n";
    for (int move = 0; move < 60; ++move) {
        fmt::format_to(std::back_inserter(out), "G1 X{} Y{} F3000\n", 50 + move % 7, 50 + move % 11);
    }
    return out + "M84\n";
}

}  // namespace fauxboard::world
