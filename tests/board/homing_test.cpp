// Homing with its stations, probing, babystep.

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

void get_ready(BoardDriver& driver) {
    driver.run_until(1);
    driver.meet_screen();
    driver.run_to_quiet();
}

std::vector<std::string> l1_bodies(const BoardDriver& driver, double from) {
    std::vector<std::string> out;
    for (const auto& line : driver.matching("L1 ", from)) {
        out.push_back(line.body);
    }
    return out;
}

}  // namespace

TEST_CASE("homing: the recorded stations, L12 and two L1 at its end after some 37.9 s") {
    BoardDriver driver;
    get_ready(driver);
    const double pressed = driver.now();
    driver.press("G28");
    driver.run_for(60);
    // No L1 while X and Y home: the position is 0 already.
    CHECK(join(l1_bodies(driver, pressed)) ==
          join({"L1 X0.000 Y0.000 Z10.000 F20", "L1 X198.200 Y160.000 Z15.000 F100",
                "L1 X198.200 Y160.000 Z2.500 F5", "L1 X198.200 Y160.000 Z2.500 F5"}));
    const auto l12 = driver.matching("L12", pressed);
    REQUIRE(l12.size() == 1);
    CHECK(l12[0].body == "L12 P0 S0");
    CHECK(l12[0].at - pressed == doctest::Approx(37.9).epsilon(0.02));
    const auto l1 = driver.matching("L1 ", pressed);
    CHECK(l1[2].at - l12[0].at == doctest::Approx(0.05).epsilon(0.01));
    CHECK(l1[3].at - l1[2].at == doctest::Approx(0.05).epsilon(0.01));
    CHECK(driver.number("motion.homed") == 1);
}

TEST_CASE("homing: MT:1 shows in the next slot 2, and the schedule loses exactly one round") {
    BoardDriver driver;
    get_ready(driver);
    const double pressed = driver.now();
    driver.press("G28");
    driver.run_for(80);
    const auto l3 = driver.matching("L3", pressed);
    REQUIRE(l3.size() > 10);
    CHECK(l3[0].at - pressed < 2.1);
    CHECK(l3[0].body.find(" MT:1 ") != std::string::npos);
    int longer = 0;
    for (std::size_t i = 1; i < l3.size(); ++i) {
        const double gap = l3[i].at - l3[i - 1].at;
        const bool lost = gap > 5;
        longer += lost ? 1 : 0;
        CHECK(gap == doctest::Approx(lost ? 3 * 2.09958 : 2 * 2.09958).epsilon(1e-5));
    }
    CHECK(longer == 1);
}

TEST_CASE("homing: where the place is known, X and Y run together, and all takes 23 s") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("G28");  // leaves the head at X 198.2, Y 160
    driver.run_for(70);
    const double pressed = driver.now();
    driver.press("G28");
    driver.run_for(60);
    const auto l12 = driver.matching("L12 P0 S0", pressed);
    REQUIRE(l12.size() == 1);
    CHECK(l12[0].at - pressed > 22);
    CHECK(l12[0].at - pressed < 24);
}

TEST_CASE("homing: single axes need all three before the machine counts as homed") {
    BoardDriver driver;
    get_ready(driver);
    for (const char* request : {"G28 X0", "G28 Y0"}) {
        driver.press(request);
        driver.run_for(30);
        CHECK(driver.number("motion.homed") == 0);
    }
    driver.press("G28 Z0");
    driver.run_for(30);
    CHECK(driver.number("motion.homed") == 1);
    CHECK(driver.matching("L12").empty());  // seen only at the end of a full run
    driver.press("M18");
    driver.run_for(1);
    CHECK(driver.number("motion.homed") == 0);
}

TEST_CASE("babystep: refused until homed, then absolute, two decimals; homing drops it") {
    BoardDriver driver;
    get_ready(driver);
    for (const char* request : {"M290 Z0.01", "M290 Z-0.01", "M290 Z0"}) {
        CHECK(join(driver.ask(request, 0.15)) == "L24 P5 A0.00\n");
    }
    driver.press("G28");
    driver.run_for(45);
    driver.run_to_quiet();
    CHECK(join(driver.ask("M290 Z0.15", 0.15)) == "L24 P5 A0.15\n");
    CHECK(join(driver.ask("M290 Z0.15", 0.15)) == "L24 P5 A0.15\n");
    CHECK(join(driver.ask("M290 Z-0.01", 0.15)) == "L24 P5 A-0.01\n");
    CHECK(join(driver.ask("M2140 S5", 0.15)) == "L24 P5 A-0.01\n");
    driver.press("M290 Z0.2");
    driver.press("G28");
    driver.run_for(0.2);
    CHECK(driver.number("position.z") == 0);
    driver.run_for(60);
    driver.run_to_quiet();
    CHECK(join(driver.ask("M2140 S5", 0.15)) == "L24 P5 A0.00\n");
}

TEST_CASE("babystep: never shows in L1") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("G28");
    driver.run_for(45);
    driver.press("M290 Z0.5");
    driver.run_for(1);
    driver.run_to_quiet();
    CHECK(join(driver.ask("M114", 0.15)) == "L1 X198.200 Y160.000 Z2.500 F5\n");
}

TEST_CASE("probing: nine points, each told by an L1 of travel and one of the height found plus 10") {
    // The stations and heights of the recording; the height of the last point was never seen on its wire.
    const std::vector<std::string> stations{
        "L1 X98.200 Y60.000 Z15.000 F100",   "L1 X98.200 Y60.000 Z12.555 F5",
        "L1 X203.200 Y60.000 Z12.555 F100",  "L1 X203.200 Y60.000 Z12.512 F5",
        "L1 X308.200 Y60.000 Z12.512 F100",  "L1 X308.200 Y60.000 Z12.495 F5",
        "L1 X308.200 Y171.000 Z12.495 F100", "L1 X308.200 Y171.000 Z12.520 F5",
        "L1 X203.200 Y171.000 Z12.520 F100", "L1 X203.200 Y171.000 Z12.528 F5",
        "L1 X98.200 Y171.000 Z12.528 F100",  "L1 X98.200 Y171.000 Z12.538 F5",
        "L1 X98.200 Y282.000 Z12.538 F100",  "L1 X98.200 Y282.000 Z12.523 F5",
        "L1 X203.200 Y282.000 Z12.523 F100", "L1 X203.200 Y282.000 Z12.523 F5",
        "L1 X308.200 Y282.000 Z12.523 F100", "L1 X308.200 Y282.000 Z12.523 F5"};
    // L1 has a slot every 2.1 s: what is seen depends on the moment, its order does not.
    std::set<std::string> seen;
    for (int phase = 0; phase < 14; ++phase) {
        BoardDriver driver;
        get_ready(driver);
        driver.press("G28");
        driver.run_for(45 + 0.15 * phase);
        const double start = driver.now();
        driver.host("G29");
        driver.run_for(100);
        std::size_t at = 0;
        for (const auto& line : driver.matching("L1 ", start)) {
            std::string told = line.body;  // under way the feed is that of the step
            const auto same_place = [&](const std::string& station) {
                return station.substr(0, station.find(" F")) == told.substr(0, told.find(" F"));
            };
            const auto hit =
                std::find_if(stations.begin() + static_cast<long>(at), stations.end(), same_place);
            CAPTURE(told);
            REQUIRE(hit != stations.end());
            at = static_cast<std::size_t>(hit - stations.begin());
            seen.insert(*hit);
        }
        CHECK(driver.number("motion.busy") == 0);
        // Recorded: 7.63 s per point.
        const auto l1 = driver.matching("L1 ", start);
        REQUIRE(!l1.empty());
        CHECK(l1.back().at - l1.front().at > 8 * 7.63 - 2.2);
        CHECK(l1.back().at - l1.front().at < 9 * 7.63 + 2.2);
    }
    CHECK(seen.size() >= 16);  // of the back row two stations are alike
}
