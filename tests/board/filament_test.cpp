// Loading, unloading, cleaning, and the filament detector.

#include <doctest/doctest.h>

#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

constexpr double piece_s = 0.7197;  // measured on a real board: 105 pieces

void get_ready(BoardDriver& driver) {
    driver.run_until(1);
    driver.meet_screen();
    driver.press("M104 S200");
    driver.run_for(160);
    driver.run_to_quiet();
}

std::string detector_in_l3(BoardDriver& driver) {
    const auto lines = driver.ask("M2101", 0.15);
    REQUIRE(!lines.empty());
    const std::string& l3 = lines.front();
    const std::size_t at = l3.find(" FT:");
    return l3.substr(at + 4, l3.find(' ', at + 4) - at - 4);
}

}  // namespace

TEST_CASE("loading: L12, L1 one tick later, then L1 every 0.7197 s until stopped") {
    BoardDriver driver;
    get_ready(driver);
    const double start = driver.now();
    driver.press_all({"M165 A1 B0 C0", "M2105 S2"});
    driver.run_for(22);
    const auto l12 = driver.matching("L12", start);
    REQUIRE(l12.size() == 1);
    CHECK(l12[0].body == "L12 P0 S2");
    const auto l1 = driver.matching("L1 ", start);
    REQUIRE(l1.size() > 25);
    CHECK(l1[0].at - l12[0].at == doctest::Approx(0.05).epsilon(0.001));
    const double first = l1[1].at - l1[0].at;  // shorter: the first L1 waited in the queue
    CHECK(first > 0.55);
    CHECK(first < piece_s);
    for (std::size_t i = 0; i < l1.size(); ++i) {
        CAPTURE(i);
        CHECK(l1[i].body == "L1 X0.000 Y0.000 Z0.000 F1");
        if (i >= 2) {
            CHECK(l1[i].at - l1[i - 1].at == doctest::Approx(piece_s).epsilon(1e-6));
        }
    }
    CHECK(driver.number("motors.enabled") == 1);
}

TEST_CASE("loading: a stop early in a piece ends it at once") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M2105 S2");
    driver.run_for(10);
    const auto pieces = driver.matching("L1 ", driver.now() - 1);
    driver.run_until(pieces.back().at + piece_s + 0.1);  // a piece has begun 0.1 s ago
    const double stop = driver.now();
    driver.press("M2105 S4");
    driver.run_for(5);
    const auto said = driver.bodies(stop, stop + 0.15);
    CHECK(join(said) == "L12 P0 S0\n");
    CHECK(driver.matching("L1 ", stop).empty());
}

TEST_CASE("loading: a stop late in a piece lets it end: one more L1, then L12") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M2105 S3");
    driver.run_for(10);
    const auto pieces = driver.matching("L1 ", driver.now() - 1);
    driver.run_until(pieces.back().at + piece_s + 0.5);
    const double stop = driver.now();
    driver.press("M2105 S4");
    driver.run_for(5);
    const auto l12 = driver.matching("L12", stop);
    REQUIRE(l12.size() == 1);
    CHECK(l12[0].body == "L12 P0 S0");
    CHECK(l12[0].at - stop > 0.15);
    CHECK(l12[0].at - stop < 0.35);  // recorded: 86, 118 and 224 ms
    const auto l1 = driver.matching("L1 ", stop);
    REQUIRE(l1.size() == 1);
    CHECK(l1[0].at < l12[0].at);
}

TEST_CASE("loading: motors and feed keep their values after a stop") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M2105 S5");
    driver.run_for(3);
    driver.press("M2105 S4");
    driver.run_for(60);
    CHECK(driver.number("motors.enabled") == 1);
    CHECK(driver.number("motion.feed") == 1);
    CHECK(driver.number("filament.running") == 0);
}

TEST_CASE("loading: once is one piece, then L12 S0") {
    for (const char* request : {"M2105 S0", "M2105 S1"}) {
        BoardDriver driver;
        get_ready(driver);
        const double start = driver.now();
        driver.press(request);
        driver.run_for(5);
        const auto l12 = driver.matching("L12", start);
        REQUIRE(l12.size() == 2);
        CHECK(l12[0].body == "L12 P0 S" + std::string(request).substr(7));
        CHECK(l12[1].body == "L12 P0 S0");
        CHECK(l12[1].at - start > piece_s);
        CHECK(driver.number("filament.running") == 0);
    }
}

TEST_CASE("loading: a cold nozzle is told, and nothing moves") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_to_quiet();
    const double start = driver.now();
    driver.press("M2105 S2");
    driver.run_for(10);
    CHECK(driver.matching("L18 P26 S12", start).size() == 1);
    CHECK(driver.matching("L1 ", start).size() <= 1);
    CHECK(driver.number("motors.enabled") == 0);
    CHECK(driver.number("filament.running") == 0);
}

TEST_CASE("loading: the other ways to stop, S4 while idle included, end in L12 S0 or nothing under way") {
    BoardDriver driver;
    get_ready(driver);
    const auto idle = driver.ask("M2105 S4");
    CHECK(join(idle) == "L12 P0 S0\n");
    driver.press("M2105 S2");
    driver.run_for(2);
    driver.press("M112");
    driver.run_for(2);
    CHECK(driver.number("filament.running") == 0);
    const double from = driver.now();
    driver.run_for(5);
    CHECK(driver.matching("L1 ", from).empty());
}

TEST_CASE("detector: FT is 255 switched off, else 1 with filament and 0 without") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    CHECK(detector_in_l3(driver) == "0");
    driver.world("filament in");
    CHECK(detector_in_l3(driver) == "1");
    driver.press("M2106 P0 S0");
    driver.run_for(0.3);
    CHECK(detector_in_l3(driver) == "255");
    driver.world("filament out");
    CHECK(detector_in_l3(driver) == "255");
    driver.press("M2106 P0 S1");
    driver.run_for(0.3);
    CHECK(detector_in_l3(driver) == "0");
}

TEST_CASE("detector: filament put in or taken out shows in the regular L3, not earlier") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(3.4);
    driver.world("filament in");
    driver.run_until(10);
    const auto lines = driver.between(3.4, 10);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].at == doctest::Approx(7.449).epsilon(0.001));
    CHECK(lines[0].body.find(" FT:1 ") != std::string::npos);
}

TEST_CASE("detector: filament out while printing is told and pauses; idle or switched off it is not") {
    for (const bool printing : {false, true}) {
        for (const bool on : {false, true}) {
            CAPTURE(printing);
            CAPTURE(on);
            BoardDriver driver;
            driver.run_until(1);
            driver.meet_screen();
            driver.world("filament in");
            driver.press(on ? "M2106 P0 S1" : "M2106 P0 S0");
            driver.run_for(0.5);
            if (printing) {
                driver.press_all({"M23 testpattern.gcode", "M24"});
                driver.run_for(1);
            }
            driver.world("filament out");
            const double out = driver.now();
            driver.run_for(printing && on ? 60 : 20);  // homing, under way, ends before it parks
            const std::size_t told = driver.matching("L18 P26 S0", out).size();
            CHECK(told == (printing && on ? 1 : 0));
            CHECK(driver.number("job.status") == (printing ? on ? 2 : 1 : 0));
        }
    }
}
