#include "emulator/host/live_screen.h"

#include "emulator/host/screen_files.h"
#include "protocol/framing.h"
#include "tests/host/live_helpers.h"

namespace fauxboard::host::test {
namespace {

using protocol::frame;

struct User final : ScreenUser {
    std::vector<std::string> judged;
    std::vector<std::string> links;
    SimTime next = machine::never;
    int turns = 0;

    SimTime on_turn(SimTime) override {
        ++turns;
        return std::exchange(next, machine::never);
    }
    void on_judged(const screen::Judgement& judgement) override { judged.push_back(judgement.line); }
    void on_link(link::LinkState, std::string_view why) override { links.emplace_back(why); }
};

struct Bench {
    explicit Bench(std::string_view name = "geeetech-a30t")
        : screen(load_screen_by_name(name)), live(screen, link, clock, &witness, &user) {
        link.open(live);
        live.start();
    }
    Witness witness;
    User user;
    FakeLink link;
    HandClock clock;
    screen::Screen screen;
    LiveScreen live;
};

TEST_CASE("it says its hello at the start, and hears from the first byte on") {
    Bench b;
    CHECK(b.link.all() == "log Geeetech LCD OK\r\n");
    CHECK(b.witness.received == std::vector<std::string>{"log Geeetech LCD OK"});
    CHECK(b.live.line_time(b.live.now()) == 0s);
    b.live.on_bytes(frame("L1 X12.000 Y0.000 Z0.000 F50"));
    b.clock.pass(20ms);
    CHECK(b.screen.number("position.x") == 12);
    CHECK(b.user.judged.size() == 1);
    CHECK(b.witness.sent.size() == 1);
    CHECK(b.live.lines_heard() == 1);
    const auto& values = b.screen.profile().values;
    CHECK(b.live.told(values.find("position.x").value()));
    CHECK_FALSE(b.live.told(values.find("nozzle.current").value()));
}

TEST_CASE("a touch leaves at once") {
    Bench b;
    b.clock.pass(5s);
    b.link.messages.clear();
    CHECK(b.live.press("Control/Filament/Hotend on").pressed);
    CHECK(b.link.wrote("N-0 M104 S200"));
    CHECK_FALSE(b.live.press("no such button").pressed);
}

TEST_CASE("it answers by itself, and falls back to the main page in its own time") {
    Bench b;
    b.live.on_bytes(frame("L21 P0 S0"));
    b.clock.pass(100ms);
    CHECK(b.link.wrote("M2134 FW:"));
    CHECK(b.live.press("Setting/Add-on/Sound on").pressed);
    CHECK(b.screen.page().path == "Setting/Add-on");
    b.clock.pass(16s);
    CHECK(b.screen.page().path == "Main");
}

TEST_CASE("what is handed over in one go does not run over the buffer of the screen") {
    Bench b;
    std::string flood;
    for (int i = 0; i < 400; ++i)
        flood += frame("L1 X" + std::to_string(i) + ".000 Y0.000 Z0.000 F50");
    for (std::size_t at = 0; at < flood.size(); at += 4096)
        b.live.on_bytes(std::string_view(flood).substr(at, 4096));
    b.clock.pass(2s);
    CHECK(b.screen.counters().lines_received == 400);
    CHECK(b.screen.counters().bytes_lost == 0);
    CHECK(b.screen.number("position.x") == 399);
    CHECK(b.user.judged.size() == 400);
}

TEST_CASE("a flood without end stays within bounds, and the screen works on") {
    Bench b;
    const std::string junk(4096, 'x');
    for (int i = 0; i < 2000; ++i)
        b.live.on_bytes(junk);
    CHECK(b.live.bytes_dropped() > 0);
    b.clock.pass(200s);  // at the pace of a line, a mebibyte takes a while
    b.live.on_bytes("\r\n" + frame("L1 X7.000 Y0.000 Z0.000 F50"));
    b.clock.pass(1s);
    CHECK(b.screen.number("position.x") == 7);
}

TEST_CASE("its user is called at the time it asked for, and hears of the link") {
    Bench b;
    b.user.next = b.live.now() + 3s;
    b.clock.pass(0s);
    const int turns = b.user.turns;
    b.clock.pass(2'999ms);
    CHECK(b.user.turns == turns);
    b.clock.pass(1ms);
    CHECK(b.user.turns == turns + 1);
    b.link.go(link::LinkState::waiting, "gone");
    CHECK(b.user.links == std::vector<std::string>{"gone"});
    CHECK(b.witness.links == std::vector<std::string>{"gone"});
}

TEST_CASE("a few presses: each judged by what comes back, and the first that cannot be pressed ends it") {
    Bench b;
    b.clock.pass(1s);
    screen::Tour tour(b.screen, {"Control/Filament/Hotend on", "Sound on", "nonsense", "Sound off"}, 0s);
    b.live.lead(&tour);
    b.clock.pass(100ms);
    REQUIRE(b.link.wrote("M104 S200"));
    b.live.on_bytes(frame("L2 B:22.0 /0.0 /0 T0:21.5 /200.0 /1 SD:0 F0:0 F2:0 R:100 FR:50"));
    b.clock.pass(10s);
    CHECK(tour.done());
    CHECK_FALSE(tour.passed());
    REQUIRE(tour.results().size() == 3);
    CHECK_MESSAGE(tour.results()[0].verdict == screen::TourVerdict::met, tour.results()[0].sentence);
    CHECK(tour.results()[1].verdict == screen::TourVerdict::not_met);
    CHECK(tour.results()[1].sentence ==
          "Setting/Add-on/Sound on: sent \"M2139 P0 S1\"; expected L23 where addons.sound is 1 within 0.5 s; "
          "came nothing");
    CHECK(tour.results()[2].verdict == screen::TourVerdict::not_pressed);
    CHECK(tour.results()[2].sentence.find("there is no button \"nonsense\"") != std::string::npos);
}

TEST_CASE("slack: a reply may be late by so much, and no more") {
    for (const bool in_time : {true, false}) {
        Bench b;
        b.clock.pass(1s);
        screen::Tour tour(b.screen, {"Setting/Add-on/Sound on"}, 2s);
        b.live.lead(&tour);
        b.clock.pass(100ms);
        b.live.on_bytes(frame("L23 SE:0 BE:1 BP:50 CE:0 HE:0 SP:0 ST:10 HC:0 HO:0"));  // the page's
        b.clock.pass(in_time ? 2'300ms : 2'600ms);
        b.live.on_bytes(frame("L23 SE:1 BE:1 BP:50 CE:0 HE:0 SP:0 ST:10 HC:0 HO:0"));
        b.clock.pass(1s);
        CHECK(tour.done());
        CHECK(tour.passed() == in_time);
        b.clock.pass(60s);  // the screen lives on when its tour is over
        CHECK(b.screen.page().path == "Main");
    }
}

TEST_CASE("screens by name") {
    const auto screens = list_screens();
    CHECK(std::any_of(screens.begin(), screens.end(),
                      [](const ProfileEntry& entry) { return entry.name == "geeetech-a30"; }));
    std::string sentence;
    try {
        load_screen_by_name("geeetech-a30x");
    } catch (const behaviour::ProfileError& error) {
        sentence = error.what();
    }
    CHECK(sentence.find("there is no screen of this name; known: btt-tft geeetech-a30 geeetech-a30t") !=
          std::string::npos);
    CHECK_THROWS_AS(load_screen_by_name("/missing/screen.json"), behaviour::ProfileError);
}

}  // namespace
}  // namespace fauxboard::host::test
