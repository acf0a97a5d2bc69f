#include <doctest/doctest.h>

#include "tests/touch/bench.h"

namespace fauxboard::testing {
namespace {

double beeps(TouchBench& bench) {
    const auto& profile = bench.screen.profile();
    return bench.screen.standpoint(bench.board.machine()).values[*profile.values.find("beeps")].number;
}

double value(TouchBench& bench, std::string_view name) {
    const auto& profile = bench.screen.profile();
    return bench.screen.standpoint(bench.board.machine()).values[*profile.values.find(name)].number;
}

const screen::SceneControl& control(const screen::Scene& scene, std::string_view name) {
    const auto* found = scene.find(name);
    REQUIRE(found != nullptr);
    return *found;
}

}  // namespace

TEST_CASE("a contact is a press from the fourth look at the sensor on") {
    // Wherever between two looks the finger comes down: under 48 ms is never a press, from 80 ms on always
    // one.
    for (double shift = 0; shift < 0.032; shift += 0.0047) {
        TouchBench bench;
        bench.run_for(1 + shift);
        const double sound = bench.field("addons.sound");
        bench.tap(10, 30, 0.047);
        CHECK(beeps(bench) == 0);
        CHECK(bench.field("addons.sound") == sound);
        bench.tap(10, 30, 0.080);
        CHECK(beeps(bench) == 1);
        CHECK(bench.field("addons.sound") == 1 - sound);
    }
}

TEST_CASE("a control acts on release, and after a long press not at all") {
    TouchBench bench;
    bench.run_for(1);
    const double sound = bench.field("addons.sound");
    REQUIRE(bench.screen.touch(bench.now, 10, 30, SimTime{1'000'000}).why.empty());
    bench.run_for(0.9);
    CHECK(beeps(bench) == 1);
    CHECK(bench.field("addons.sound") == sound);
    bench.run_for(0.2);
    CHECK(bench.field("addons.sound") == 1 - sound);
    bench.tap("Sound", 1.6);
    CHECK(bench.field("addons.sound") == sound);
    bench.tap("Sound", 1.8);
    CHECK(bench.field("addons.sound") == sound);
    CHECK(beeps(bench) == 3);
}

TEST_CASE("a control without an action beeps, a dead one and none at all do not") {
    TouchBench bench;
    bench.run_for(1);
    const double sound = bench.field("addons.sound");
    bench.tap("Nothing");
    CHECK(beeps(bench) == 1);
    bench.tap("Dead");
    bench.tap(199, 99);
    CHECK(beeps(bench) == 1);
    CHECK(bench.field("addons.sound") == sound);
    CHECK_FALSE(control(bench.scene(), "Dead").enabled);
}

TEST_CASE("what is held acts while the finger is down, once") {
    TouchBench bench;
    bench.run_for(1);
    bench.tap("Hold", 2.4);
    CHECK(value(bench, "held") == 0);
    bench.tap("Hold", 2.6);
    CHECK(value(bench, "held") == 1);
    bench.tap("Hold", 9);
    CHECK(value(bench, "held") == 2);
    CHECK(beeps(bench) == 5);  // one at each press, a second when it acts
}

TEST_CASE("a box stands over a dead page, and its buttons close it before they act") {
    TouchBench bench;
    bench.run_for(1);
    bench.tap("Ask");
    CHECK(bench.page() == "Main");
    CHECK(bench.box() == "Question");
    CHECK(bench.scene().box->lines == std::vector<std::string>{"Really?", "Think."});
    CHECK(bench.scene().box->buttons == std::vector<std::string>{"Yes", "No"});
    CHECK(bench.tap("Sound").starts_with("There is no control \"Sound\" on the box \"Question\""));
    const double before = beeps(bench);
    bench.tap(10, 30);
    CHECK(beeps(bench) == before);
    bench.tap("No");
    CHECK(bench.box().empty());
    CHECK(value(bench, "off") == 0);
    bench.tap("Ask");
    bench.tap("Yes");
    CHECK(value(bench, "off") == 1);
    CHECK(bench.box() == "Completed");
    bench.tap("OK");
    CHECK(bench.box().empty());
    CHECK(bench.page() == "Main");
}

TEST_CASE("an event opens its box in place of the one that is open") {
    TouchBench bench;
    bench.run_for(1);
    bench.world("card in");
    bench.tap("Ask");
    bench.world("card out");
    CHECK(bench.box() == "Card");
    bench.world("card in");
    CHECK(bench.box().empty());
    CHECK(bench.page() == "Main");
}

TEST_CASE("numbers are typed as on the firmware's keys") {
    TouchBench bench;
    bench.set("speed.percent", 40);
    bench.run_for(1);
    struct Case {
        std::vector<std::string> keys;
        std::string shown;
    };
    const std::vector<Case> cases{
        {{}, "40.000"},
        {{"2"}, "2"},
        {{"2", "5", ".", "5"}, "25.5"},
        {{"."}, "0."},
        {{".", ".", "5"}, "0.5"},
        {{"Erase"}, "40.00"},
        {{"Erase", "1"}, "40.001"},
        {{"Erase", "."}, "40.00"},
        {{"AC"}, "0"},
        {{"AC", "5"}, "5"},
        {{"0", "0", "5"}, "5"},
        {{"1", "Erase"}, "0"},
        {{"1", "2", "5", "0", "1", "2", "5"}, "125012"},
        {{"5", "-/+"}, "-5"},
        {{"5", "-/+", "-/+"}, "5"},
        {{"5", "-/+", "Erase"}, "0"},
    };
    for (const Case& one : cases) {
        bench.tap("Speed");
        REQUIRE(bench.page() == "Number");
        for (const std::string& key : one.keys) {
            REQUIRE(bench.tap(key).empty());
        }
        CHECK(bench.texts() == one.shown + "\n");
        bench.tap("Back");
    }
    CHECK(bench.field("speed.percent") == 40);
    bench.tap("Speed");
    bench.tap("1");
    bench.tap("2");
    bench.tap("0");
    bench.tap("OK");
    CHECK(bench.page() == "Main");
    CHECK(bench.field("speed.percent") == 120);
    CHECK(bench.has_text("120%"));
}

TEST_CASE("without a touch for the delay a cover falls over page and box, and the next touch only lifts it") {
    TouchBench bench;
    bench.run_for(1);
    bench.run_for(3600);
    CHECK(bench.page() == "Main");  // 0 is never
    bench.tap("Saver");
    bench.tap("Ask");
    bench.run_for(4.8);
    CHECK(bench.page() == "Main");
    bench.run_for(0.3);
    CHECK(bench.page() == "Saver");
    CHECK(bench.tap("Nothing").find("a touch anywhere lifts it") != std::string::npos);
    CHECK(bench.box().empty());
    const double before = beeps(bench);
    bench.tap(10, 30);
    CHECK(bench.page() == "Main");
    CHECK(bench.box() == "Question");
    CHECK(beeps(bench) == before);
    CHECK(value(bench, "held") == 7);
    bench.run_for(6);
    REQUIRE(bench.page() == "Saver");
    bench.world("card out");
    CHECK(bench.page() == "Saver");  // its box waits below
    bench.world("card in");
    CHECK(bench.page() == "Main");
    CHECK(bench.box().empty());
}

TEST_CASE("texts change with the language, whole templates and words alike") {
    TouchBench bench;
    bench.set("addons.sound", 1);
    bench.run_for(1);
    CHECK(bench.has_text("Sound On"));
    bench.tap("Russian");
    CHECK(bench.has_text("Звук Вкл"));
    CHECK(bench.scene().title == "ГЛАВНАЯ");
    bench.tap("Ask");
    CHECK(bench.box() == "Вопрос");
    bench.tap("Да");  // by label
    CHECK(bench.box() == "Completed");
}

TEST_CASE("a turned glass turns the touches and the places with it") {
    TouchBench bench;
    bench.run_for(1);
    const auto places = [&](std::string_view name) {
        const behaviour::Json page = page_json(bench.scene());
        for (const auto& one : page["controls"]) {
            if (one["name"] == name) return one;
        }
        return behaviour::Json();
    };
    CHECK(places("Sound")["x"] == 0);
    CHECK(places("Sound")["y"] == 20);
    bench.tap("Turn");
    CHECK(places("Sound")["x"] == 150);
    CHECK(places("Sound")["y"] == 60);
    bench.set("addons.sound", 0);
    bench.tap(155, 65);
    CHECK(bench.field("addons.sound") == 1);
    CHECK(bench.tap("Sound").empty());
    CHECK(bench.field("addons.sound") == 0);
}

TEST_CASE("a page is told as programs expect it") {
    TouchBench bench;
    bench.run_for(1);
    bench.tap("Ask");
    CHECK(page_json(bench.scene()) == behaviour::Json::parse(R"({
      "page": "Main", "title": "MAIN",
      "texts": ["100%", "Sound Off", "Nothing", "Dead", "Hold", "Ask", "Speed", "Russian", "Turn", "Saver"],
      "box": {"caption": "Question", "text": "Really?\nThink.", "buttons": ["Yes", "No"]},
      "controls": [
        {"name": "Yes", "x": -20, "y": 69, "w": 110, "h": 36, "label": "Yes", "enabled": true},
        {"name": "No", "x": 109, "y": 69, "w": 110, "h": 36, "label": "No", "enabled": true}]
    })"));
}

TEST_CASE("a finger that is down at power-on is felt by what the screen opens with") {
    TouchBench bench;
    REQUIRE(bench.screen.touch(bench.now, 190, 5, SimTime{3'000'000}).why.empty());
    bench.run_for(0.5);
    bench.board.power_on(bench.now);
    CHECK(bench.page() == "Secret");
    bench.board.power_on(bench.now + SimTime{5'000'000});
    CHECK(bench.page() == "Main");
}

TEST_CASE("touches wait for one another, and not without end") {
    TouchBench bench;
    bench.run_for(1);
    const double sound = bench.field("addons.sound");
    for (int i = 0; i < 3; ++i) {
        REQUIRE(bench.screen.touch(bench.now, 10, 30, SimTime{120'000}).why.empty());
    }
    bench.run_for(2);
    CHECK(bench.field("addons.sound") == 1 - sound);
    CHECK(beeps(bench) == 3);
    std::string why;
    for (int i = 0; i < 100 && why.empty(); ++i) {
        why = bench.screen.touch(bench.now, 10, 30, SimTime{120'000}).why;
    }
    CHECK(why == "Too many touches wait for this one.");
    CHECK(bench.screen.touch(bench.now, 200, 0, SimTime{1000}).why ==
          "200, 0 is not on the screen, which has 200 x 100 pixels.");
    CHECK(bench.tap("Sond").starts_with(
        "There is no control \"Sond\" on the page Main (did you mean \"Sound\"?); it has Sound, Nothing,"));
}

}  // namespace fauxboard::testing
