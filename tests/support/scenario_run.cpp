#include "tests/support/scenario_run.h"

#include <fmt/format.h>

#include <optional>

#include "emulator/host/board_display.h"
#include "emulator/host/clock.h"
#include "emulator/host/faulty_link.h"
#include "emulator/host/live_board.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/host/screen_plug.h"
#include "emulator/host/script_files.h"
#include "emulator/host/script_host.h"
#include "emulator/link/event_loop.h"
#include "emulator/machine/memory_volume.h"
#include "tests/support/memory_eeprom.h"

namespace fauxboard::testing {
namespace {

using host::SimTime;

/// Nobody at the other end.
struct NoLink final : link::Link {
    void open(link::LinkListener&) override {}
    void close() override {}
    void write(std::string_view) override {}
    link::LinkState state() const override { return link::LinkState::waiting; }
    const link::LinkStats& stats() const override { return counted; }
    std::string describe() const override { return "nobody"; }
    std::string kind() const override { return "none"; }
    std::string path() const override { return ""; }
    link::LinkStats counted;
};

struct Writer final : host::LiveObserver {
    explicit Writer(std::string& out) : text(out) {}
    void on_received(SimTime now, board::Channel, std::string_view line, board::Verdict) override {
        text += fmt::format("{} > {}\n", now.count(), line);
    }
    void on_sent(SimTime now, board::Channel, std::string_view line) override {
        text += fmt::format("{} < {}\n", now.count(), line);
    }
    void on_notice(SimTime, board::Level, std::string_view) override {}
    void on_event(SimTime now, machine::EventId event) override {
        text += fmt::format("{} ! {}\n", now.count(), event->name);
    }
    void on_link(SimTime, link::LinkState, std::string_view) override {}
    std::string& text;
};

}  // namespace

behaviour::SourceText shipped_scenario(std::string_view name) {
    return host::find_script(name);
}

behaviour::SourceText changed_scenario(std::string_view name,
                                       const std::function<void(behaviour::Json& root)>& change) {
    behaviour::SourceText source = shipped_scenario(name);
    behaviour::Json root = behaviour::Json::parse(source.text);
    change(root);
    source.text = root.dump(2);
    source.name = "changed.json";
    return source;
}

ScenarioRun play(const behaviour::SourceText& source, const ScenarioSetup& setup) {
    const script::Head head = script::read_head(source);
    const script::Cast cast =
        host::make_cast(head.profile.empty() ? "geeetech-a30t" : head.profile, head.screen);
    const auto scenario = script::load_scenario(source, host::script_finder(), cast, setup.arguments);

    ScenarioRun out;
    link::EventLoop loop;
    host::Speed speed;
    speed.max = true;
    const auto clock = host::make_clock(loop, speed);
    host::Observers observers;
    Writer writer(out.recording);
    observers.add(writer);
    std::optional<machine::MemoryVolume> card;
    MemoryEeprom eeprom;
    machine::Services services;
    services.eeprom = &eeprom;
    if (scenario->card) {
        services.sd = &card.emplace(*scenario->card);
    }
    board::Options options;
    options.pacing = setup.pacing;
    options.seed = setup.seed;
    options.observer = &observers;
    std::optional<touch::TouchScreen> own;
    if (cast.screen && cast.screen->display) {
        options.front = &own.emplace(cast.screen);
    }
    board::Board board(cast.profile, services, options);
    NoLink nobody;
    std::optional<host::ScreenPlug> plug;
    std::optional<host::BoardDisplay> display;
    if (own) {
        display.emplace(*own, board);
    } else if (cast.screen) {
        plug.emplace(cast.screen, *clock);
    }
    host::FaultyLink line(plug ? plug->board_end() : nobody, *clock, fault::Direction::to_board);
    host::LiveBoard live(board, line, *clock, &observers);
    host::ScriptHost script(
        {live, *clock, &line, plug ? &*plug : nullptr, [&loop] { loop.stop(); },
         [&out](std::string_view words) { out.notes.emplace_back(words); }, display ? &*display : nullptr},
        scenario, speed);
    observers.add(script);
    line.open(live);
    const SimTime duration = setup.duration_s > 0 ? machine::from_seconds(setup.duration_s) : machine::never;
    live.start(duration, [&] {
        script.interrupt("by --duration");
        loop.stop();
    });
    if (plug) {
        plug->start();
    }
    script.start();
    clock->run();
    out.outcome = script.player().outcome();
    out.junit = script::outcome_junit(*scenario, out.outcome);
    if (plug) {
        out.crashes = plug->screen().counters().crashes;
        for (const screen::Finding& finding : plug->screen().findings()) {
            out.findings.push_back(finding.first.sentence());
        }
    }
    return out;
}

ScenarioRun play_steps(std::string_view steps, bool with_screen, const ScenarioSetup& setup) {
    return play({"test.json", fmt::format(R"({{"name": "test", {}"steps": {}}})",
                                          with_screen ? "\"screen\": \"geeetech-a30t\", " : "", steps)},
                setup);
}

std::shared_ptr<const script::Scenario> load_steps(std::string_view steps) {
    return host::check_script({"test.json", fmt::format(R"({{"name": "test", "steps": {}}})", steps)});
}

}  // namespace fauxboard::testing
