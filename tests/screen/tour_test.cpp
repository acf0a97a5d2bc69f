#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "emulator/screen/tour_report.h"
#include "protocol/framing.h"
#include "tests/screen/harness.h"
#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

/// All sentences of what was not met.
std::string complaints(const TourRun& run) {
    std::string out;
    for (const screen::TourResult& result : run.results) {
        if (result.verdict != screen::TourVerdict::met) out += result.sentence + '\n';
    }
    return out;
}

void show_if_wanted(const TourRun& run) {
    if (std::getenv("FAUXBOARD_SHOW_TOUR") != nullptr) {
        std::cout << screen::tour_table(run.results) << screen::findings_text(run.findings) << run.seconds
                  << " s\n";
    }
}

}  // namespace

TEST_CASE("the tour of the A30T's screen presses every button, and the board meets every expectation") {
    const TourRun run = run_tour("geeetech-a30t", shipped_profile("geeetech-a30t"), 7200);
    show_if_wanted(run);
    CHECK(run.done);
    CHECK(run.results.size() == run.total);
    CHECK(complaints(run) == "");
    CHECK(run.counters.crashes == 0);
}

TEST_CASE("the tour of the A30's screen presses every button, and the board meets every expectation") {
    const TourRun run = run_tour("geeetech-a30", shipped_profile("geeetech-a30"), 7200);
    show_if_wanted(run);
    CHECK(run.done);
    CHECK(run.results.size() == run.total);
    CHECK(complaints(run) == "");
    CHECK(run.counters.crashes == 0);
}

TEST_CASE("a board with one reply broken makes the tour fail with a sentence that names it") {
    const auto broken = [](const std::string& requests) {
        const std::string json =
            R"({"name": "broken", "extends": "geeetech-a30t", "requests": )" + requests + "}";
        const auto find = [](std::string_view name,
                             std::string_view) -> std::optional<behaviour::SourceText> {
            std::ifstream in(FAUXBOARD_SOURCE_DIR "/profiles/" + std::string(name) + ".json");
            return behaviour::SourceText{std::string(name),
                                         std::string(std::istreambuf_iterator<char>(in), {})};
        };
        return run_tour("geeetech-a30t", behaviour::load_profile({"broken.json", json}, find), 7200);
    };
    SUBCASE("another frame than the one asked for") {
        const TourRun run = broken(R"({"M2139": {"send": "L24.jerk"}})");
        CHECK(run.done);
        CHECK(run.results.size() == run.total);
        CHECK(complaints(run).starts_with(
            "Setting/Add-on: sent \"M2139\"; expected L23 within 0.5 s; came \"L24 P3 A7.00 B7.00 C0.50 "
            "D5.00\"\n"));
    }
    SUBCASE("a wrong value") {
        const TourRun run = broken(R"({"M2107": {"when": {"S": 6}, "send": "L10"}})");
        CHECK(complaints(run).find(
                  "Control/Leveling/manual level/Z up 0.5: sent \"M2107 S6\"; expected the line "
                  "\"M2107 Z:...\" within 0.5 s, and L10 where leveling.z is ") != std::string::npos);
    }
    SUBCASE("no reply") {
        const TourRun run = broken(R"({"M115": {"send": null}})");
        CHECK(complaints(run) ==
              "Setting/About: sent \"M115\", \"N-0 M2134 FW:V1.02.xx\"; expected L9 within 0.5 s; came \"L9 "
              "DN:GEEETECH-A30T;DM:A30T;SN:ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ;FV:V1.xx.03;PV:320.00 x 320.00 x "
              "420.00;HV:V1.6;\"\n");
    }
    SUBCASE("a reply where none must be") {
        const TourRun run = broken(R"({"M500": {"send": "L9"}})");
        CHECK(complaints(run).starts_with(
            "Control/Motion Param/Store settings: sent \"M500\"; expected silence; came \"L9 DN:"));
    }
}

TEST_CASE("a tour against a board that is off ends, and says so of every button") {
    screen::Screen screen(shipped_screen("geeetech-a30t"));
    screen.power_on(SimTime{0});
    screen::Tour tour(screen);
    SimTime now{0};
    for (int calls = 0; !tour.done() && calls < 1'000'000; ++calls) {
        const SimTime next = tour.advance(now);
        screen.clear_output();
        now = std::max(now + SimTime{1}, next);
    }
    CHECK(tour.done());
    CHECK(tour.results().size() == tour.total());
    CHECK(!tour.passed());
    int on_the_way = 0;
    for (const screen::TourResult& result : tour.results()) {
        CHECK(!result.sentence.empty());
        // What was pressed in vain on the way there has a name as well.
        on_the_way += result.sentence.find("; before it: ") == std::string::npos ? 0 : 1;
        CHECK(result.sentence.find("; before it: :") == std::string::npos);
        const bool quiet = result.expected == std::vector<std::string>{"silence"};
        CHECK_MESSAGE((result.verdict == screen::TourVerdict::met) == quiet, result.sentence);
    }
    CHECK(on_the_way > 0);
}

TEST_CASE("a status that was on its way when a button was pressed hides no button from the tour") {
    const auto press = [](bool corrected) {
        screen::Screen screen(shipped_screen("geeetech-a30t"));
        screen.power_on(SimTime{0});
        screen::Tour tour(screen, {"CAS", "CAS - up"}, SimTime{0});
        const auto status = [&](SimTime at, int sensor) {
            screen.receive(
                at, protocol::frame(fmt::format(
                        "L3 PS:0 VL:0 MT:0 FT:0 AL:1 ST:{} WF:0 MR:100 FN: PG:0 TM:0 LA:0 LC:0", sensor)));
        };
        std::optional<SimTime> pressed;
        for (SimTime now{0}; !tour.done() && now < std::chrono::minutes(1);
             now += std::chrono::milliseconds(10)) {
            tour.advance(now);
            if (!pressed && screen.output().find("M2120 P9 S0") != std::string_view::npos) {
                pressed = now;
                status(now, 1);  // as it was before
            }
            if (corrected && pressed && now == *pressed + std::chrono::milliseconds(4200)) {
                status(now, 0);
            }
            screen.clear_output();
        }
        CHECK(tour.done());
        return tour.results();
    };
    const std::vector<screen::TourResult> late = press(true);
    REQUIRE(late.size() == 2);
    CHECK(late[1].verdict == screen::TourVerdict::met);
    const std::vector<screen::TourResult> never = press(false);
    REQUIRE(never.size() == 2);
    CHECK(never[1].verdict == screen::TourVerdict::not_pressed);
    CHECK(never[1].sentence.find("it is when leveling.sensor is 0, and it is 1") != std::string::npos);
}

TEST_CASE("reports: table, JSON, JUnit") {
    std::vector<screen::TourResult> results(2);
    results[0] = {"Control/Move/X+ (30mm)", {"G91"},
                  {"L1 within 6 s"},        {"L1 X30"},
                  screen::TourVerdict::met, SimTime{2'000'000},
                  SimTime{100'000},         "fine"};
    results[1] = {"Printing",
                  {"M20 LCD"},
                  {"L7"},
                  {"L9 SN:\xff<&>\""},
                  screen::TourVerdict::not_met,
                  SimTime{3'000'000},
                  SimTime{500'000},
                  "Printing: sent \"M20 LCD\"; came \"<&>\""};
    CHECK(
        screen::tour_table(results) ==
        "Button                  Verdict          Took  Sent                                  Came\n"
        "Control/Move/X+ (30mm)  met            0.10 s  G91                                   L1 X30\n"
        "Printing                not met        0.50 s  M20 LCD                               L9 SN:ÿ<&>\"\n"
        "\n2 buttons: 1 met, 1 not met, 0 not pressed\n"
        "Printing: sent \"M20 LCD\"; came \"<&>\"\n");
    const auto json = nlohmann::json::parse(screen::tour_json("geeetech-a30t", results));
    CHECK(json.at("passed") == false);
    CHECK(json.at("buttons") == 2);
    CHECK(json.at("not_met") == 1);
    CHECK(json.at("results").at(1).at("came").at(0) == "L9 SN:ÿ<&>\"");
    CHECK(json.at("results").at(0).at("took_s") == doctest::Approx(0.1));
    CHECK(screen::tour_junit("geeetech-a30t", results) ==
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
          "<testsuite name=\"tour of geeetech-a30t\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\" "
          "time=\"0.600\">\n"
          "  <testcase classname=\"geeetech-a30t.Control/Move\" name=\"Control/Move/X+ (30mm)\" "
          "time=\"0.100\"></testcase>\n"
          "  <testcase classname=\"geeetech-a30t.Main\" name=\"Printing\" time=\"0.500\">\n"
          "    <failure type=\"not met\" message=\"Printing: sent &quot;M20 LCD&quot;; came "
          "&quot;&lt;&amp;&gt;&quot;\"/>\n"
          "  </testcase>\n"
          "</testsuite>\n</testsuites>\n");
}
