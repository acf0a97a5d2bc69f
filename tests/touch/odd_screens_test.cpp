// Right screens with odd values: whole numbers alone, languages that there are not, pages that open one
// another.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/touch/bench.h"

namespace fauxboard::testing {
namespace {

using Json = nlohmann::ordered_json;

/// The made-up screen with these put at their JSON pointers; null takes out what stands there.
std::string with(const std::vector<std::pair<std::string, Json>>& changes) {
    Json json = Json::parse(made_up_screen);
    for (const auto& [at, value] : changes) {
        const Json::json_pointer pointer(at);
        if (value.is_null()) {
            json[pointer.parent_pointer()].erase(pointer.back());
        } else {
            json[pointer] = value;
        }
    }
    return json.dump();
}

}  // namespace

TEST_CASE("whole numbers take no point, and no more digits than there is room for") {
    TouchBench bench(with({{"/pages/Number/entry/decimals", 0}, {"/pages/Number/entry/most", 2}}));
    bench.set("speed.percent", 40);
    bench.run_for(1);
    const auto typed = [&](const std::vector<std::string>& keys) {
        bench.tap("Speed");
        for (const std::string& key : keys) {
            REQUIRE(bench.tap(key).empty());
        }
        const std::string shown = bench.texts();
        bench.tap("Back");
        return shown;
    };
    CHECK(typed({}) == "40\n");
    CHECK(typed({"."}) == "40\n");
    CHECK(typed({"5", ".", "2"}) == "52\n");
    CHECK(typed({"5", "2", "1"}) == "52\n");
    CHECK(typed({"AC", "-/+"}) == "0\n");
}

TEST_CASE("a language that there is not is the first one") {
    for (const double language : {-1.0, 2.0, 64.0, 1e9}) {
        CAPTURE(language);
        TouchBench bench(with({{"/values/tongue/start", language}}));
        bench.run_for(1);
        CHECK(bench.scene().title == "MAIN");
    }
    TouchBench bench(with({{"/values/tongue/start", 1}}));
    bench.run_for(1);
    CHECK(bench.scene().title == "ГЛАВНАЯ");
}

TEST_CASE("a touch beside the glass, of no time, of more than an hour") {
    TouchBench bench;
    bench.run_for(1);
    for (const auto& [x, y] : {std::pair{-1, 0}, {0, -1}, {200, 0}, {0, 100}}) {
        CHECK(bench.screen.touch(bench.now, x, y, SimTime{1000}).why.find("is not on the screen") !=
              std::string::npos);
    }
    for (const SimTime time : {SimTime{0}, SimTime{-1}, SimTime{3'600'000'001}}) {
        CHECK(bench.screen.touch(bench.now, 10, 30, time).why == "A touch lasts from a moment to an hour.");
    }
    CHECK(bench.screen.touch(bench.now, 10, 30, SimTime{3'600'000'000}).why.empty());
}

TEST_CASE("pages that open one another without end come to rest, and the screen goes on") {
    TouchBench bench(with({{"/pages/Main/buttons/Nothing/leads_to", "Ping"},
                           {"/pages/Ping", {{"title", "PING"}, {"on_open", {{"leads_to", "Pong"}}}}},
                           {"/pages/Pong",
                            {{"title", "PONG"},
                             {"on_open", {{"leads_to", "Ping"}}},
                             {"buttons", {{"Out", {{"at", {0, 0, 50, 20}}, {"leads_to", "Main"}}}}}}}}));
    bench.run_for(1);
    bench.tap("Nothing");
    const std::string page = bench.page();
    CHECK((page == "Ping" || page == "Pong"));
    const auto why = bench.tap("Out");
    CHECK(why.empty() == (page == "Pong"));
}

TEST_CASE("a screen that notes no touch and never idles; a cover has no control") {
    TouchBench bench(
        with({{"/display/touch_x", nullptr},
              {"/display/touch_y", nullptr},
              {"/display/power_on", nullptr},
              {"/pages/Main/buttons/Nothing/leads_to", "Saver"},
              {"/pages/Main/buttons/Dead", {{"at", {100, 20, 50, 20}}, {"leads_to", "Main"}}},
              {"/pages/Main/buttons/Ask/leads_to", "Secret"},
              {"/pages/Secret/buttons", {{"Before", {{"at", {0, 0, 50, 20}}, {"leads_to", "<before>"}}}}},
              {"/boxes/Sure?", nullptr},
              {"/translations", nullptr},
              {"/display/languages", nullptr},
              {"/boxes/Done", nullptr},
              {"/idle", nullptr}}));
    bench.run_for(1);
    const double sound = bench.field("addons.sound");
    bench.tap(10, 30);
    CHECK(bench.field("addons.sound") == 1 - sound);
    bench.run_for(100'000);
    CHECK(bench.page() == "Main");
    bench.tap("Dead");  // to the page that is open already: what was before stays
    bench.tap("Ask");
    CHECK(bench.page() == "Secret");
    bench.tap("Before");
    CHECK(bench.page() == "Main");
    bench.tap("Nothing");
    CHECK(bench.page() == "Saver");
    CHECK(bench.tap("Sound") ==
          "There is no control \"Sound\" on the page Saver; it has none: a touch anywhere lifts it.");
    bench.tap(10, 30);
    CHECK(bench.page() == "Main");
    CHECK(bench.scene().find("") == nullptr);
}

}  // namespace fauxboard::testing
