// M109 and M190: the board's main loop stands still until the temperature is there.

#include <doctest/doctest.h>

#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

void get_ready(BoardDriver& driver) {
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(10);
}

/// Reports every 2.0 s, but one in 25 after 1.2 s: a counter of one byte that wraps.
void check_reports(const std::vector<BoardDriver::Line>& l2, double start) {
    REQUIRE(l2.size() > 30);
    CHECK(l2[0].at - start == doctest::Approx(2.0).epsilon(0.01));
    std::size_t since_hiccup = 0;
    int hiccups = 0;
    for (std::size_t i = 1; i < l2.size(); ++i) {
        const double gap = l2[i].at - l2[i - 1].at;
        if (gap < 1.5) {
            CHECK(gap == doctest::Approx(1.2).epsilon(0.001));
            CHECK((hiccups == 0 || since_hiccup == 25));
            since_hiccup = 0;
            ++hiccups;
        } else {
            CHECK(gap == doctest::Approx(2.0).epsilon(0.001));
            ++since_hiccup;
        }
    }
    CHECK(hiccups >= 1);
}

}  // namespace

TEST_CASE("M190 from the host: one L3, L2 every 2 s, the schedule frozen, L12 at its end") {
    BoardDriver driver;
    get_ready(driver);
    const double start = driver.now();
    driver.host("M190 S50");
    driver.run_for(400);
    const auto l12 = driver.matching("L12 P0 S0", start);
    REQUIRE(l12.size() == 1);
    const double end = l12[0].at;
    CHECK(end - start == doctest::Approx(160).epsilon(0.05));  // recorded: 159.9 s
    CHECK(driver.matching("L3", start, end).size() == 1);
    CHECK(driver.matching("L3", start, end)[0].at - start < 0.06);
    check_reports(driver.matching("L2", start, end), start);
    CHECK(driver.between(start, end).size() ==
          driver.matching("L2", start, end).size() + 1);  // nothing else at all
    // The schedule goes on where it stopped.
    const auto after = driver.matching("L3", end);
    REQUIRE(after.size() > 10);
    CHECK(after[0].at - end < 4.6);
    CHECK(after[2].at - after[1].at == doctest::Approx(4.19916).epsilon(1e-4));
}

TEST_CASE("M109 from the host: two L3 at its start, no L12 at its end") {
    BoardDriver driver;
    get_ready(driver);
    driver.heat_nozzle(100);
    const double start = driver.now();
    driver.host("M109 S200");
    driver.run_for(0.2);
    const auto l3 = driver.matching("L3", start);
    REQUIRE(l3.size() == 2);
    CHECK(l3[1].at - l3[0].at == doctest::Approx(0.05).epsilon(0.01));
    driver.run_for(300);
    CHECK(driver.number("heating.waiting") == 0);
    CHECK(driver.matching("L12", start).empty());
    const double first = driver.matching("L3", start + 1)[0].at;
    check_reports(driver.matching("L2", start, first - 1), start);
    CHECK(driver.number("heaters.nozzle.true") > 190);
}

TEST_CASE("while it waits the board answers as fast as ever") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("G28");
    driver.run_for(50);
    driver.host("M190 S60");
    driver.run_for(5.3);
    REQUIRE(driver.number("heating.waiting") == 1);
    for (const char* request : {"M290 Z0.05", "M290 Z0.10", "M2140 S5"}) {
        const double pressed = driver.now();
        driver.press(request);
        driver.run_for(0.11);
        const auto lines = driver.matching("L24 P5", pressed);
        REQUIRE(lines.size() == 1);
        CHECK(lines[0].at - pressed >= 0.0499);
        CHECK(lines[0].at - pressed <= 0.105);
    }
    CHECK(driver.matching("L24 P5").back().body == "L24 P5 A0.10");
    CHECK(driver.number("heating.waiting") == 1);
}

TEST_CASE("from the screen, M109 and M190 also get their L2 at once") {
    for (const char* request : {"M109 S200", "M190 S50"}) {
        BoardDriver driver;
        get_ready(driver);
        const double pressed = driver.now();
        driver.press(request);
        driver.run_for(0.5);
        CHECK(driver.matching("L2", pressed).size() == 1);
        CHECK(driver.number("heating.waiting") == 1);
    }
}

TEST_CASE("a wait ends with M108, with M112, or when the target is taken away; the schedule goes on") {
    for (const char* request : {"M108", "M112", "M104 S0"}) {
        CAPTURE(request);
        BoardDriver driver;
        get_ready(driver);
        driver.host("M109 S200");
        driver.run_for(10);
        REQUIRE(driver.number("heating.waiting") == 1);
        driver.press(request);
        driver.run_for(1);
        CHECK(driver.number("heating.waiting") == 0);
        const double from = driver.now();
        driver.run_for(10);
        CHECK(driver.matching("L3", from).size() >= 2);
    }
}

TEST_CASE("no wait for a target that is reached already, or for none") {
    BoardDriver driver;
    get_ready(driver);
    for (const char* line : {"M109 S0", "M190 S0", "M109", "M190 S20"}) {
        CAPTURE(line);
        driver.host(line);
        driver.run_for(0.1);
        CHECK(driver.number("heating.waiting") == 0);
    }
}
