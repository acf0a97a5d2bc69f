// The schedule: what the board says without being asked, and when.

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

constexpr double round_s = 2.09958;  // seven slots of 299.94 ms; recorded: 2.0996 s

/// All gaps between the lines are this long.
void check_period(const std::vector<BoardDriver::Line>& lines, double period_s) {
    for (std::size_t i = 1; i < lines.size(); ++i) {
        CAPTURE(lines[i].at);
        CHECK(lines[i].at - lines[i - 1].at == doctest::Approx(period_s).epsilon(1e-6));
    }
}

}  // namespace

TEST_CASE("schedule: L3 every second round, 4.199 s; L21 every round until M2134, then never") {
    BoardDriver driver;
    driver.run_until(16.5);
    const auto l21 = driver.matching("L21 P0 S0");
    CHECK(l21.size() == 8);
    CHECK(l21[0].at == doctest::Approx(1.7496).epsilon(0.001));
    check_period(l21, round_s);
    driver.press("M2134 FW:V1.02.xx");
    driver.run_until(120);
    const auto l3 = driver.matching("L3", 1);
    CHECK(l3.size() == 28);
    CHECK(l3[0].at == doctest::Approx(3.2495).epsilon(0.001));
    check_period(l3, 2 * round_s);
    CHECK(driver.matching("L21", 16.5).empty());
    CHECK(driver.matching("L9", 16.5).size() == 1);
}

TEST_CASE("schedule: a cold, idle board says nothing but L3") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(4000);
    for (const auto& line : driver.between(4, 4000)) {
        REQUIRE(line.body.starts_with("L3 "));
    }
    CHECK(driver.matching("L3", 4).size() == 951);
}

TEST_CASE("schedule: motors on or off brings L3 in the next slot 2, and its pause counts anew from there") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(7.6);  // L3 at 3.25 and 7.45
    driver.press("M17");
    driver.run_until(19.9);
    driver.press("M18");  // before the slot at 20.05, which would be a silent one
    driver.run_until(40);
    const auto l3 = driver.matching("L3", 7.6);
    REQUIRE(l3.size() == 8);
    CHECK(l3[0].at == doctest::Approx(7.449 + round_s).epsilon(0.001));
    CHECK(l3[0].body.find(" MT:1 ") != std::string::npos);
    CHECK(l3[1].at - l3[0].at == doctest::Approx(2 * round_s).epsilon(1e-6));
    const auto off = driver.matching("L3", 19.9, 23);
    REQUIRE(off.size() == 1);
    CHECK(off[0].at == doctest::Approx(3.2495 + 8 * round_s).epsilon(0.001));
    CHECK(off[0].body.find(" MT:0 ") != std::string::npos);
    check_period(driver.matching("L3", off[0].at), 2 * round_s);
}

TEST_CASE("schedule: a changed mixing ratio waits for the next L3, and L22 follows that by one slot") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(3.5);  // right after an L3: the next round is a silent one
    driver.press("M165 A0 B1 C0");
    driver.run_until(30);
    const auto l22 = driver.matching("L22", 3.5);
    REQUIRE(l22.size() == 1);
    CHECK(l22[0].body == "L22 MS:0 MR:25600 SP:100 EP:100 SH:0.00 EH:0.00");
    const auto l3 = driver.matching("L3", 3.5);
    CHECK(l22[0].at - l3[0].at == doctest::Approx(0.29994).epsilon(1e-6));
    CHECK(l3[0].body.find(" MR:25600 ") != std::string::npos);

    driver.press("M165 A0 B2 C0");  // the same ratio once more
    driver.run_until(60);
    CHECK(driver.matching("L22", 30).empty());
}

TEST_CASE("schedule: a ratio told by a reply is not told again by the schedule") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(5);
    driver.press("M2135 P25600");
    driver.run_until(20);
    CHECK(driver.matching("L22", 5).size() == 1);
}

TEST_CASE("schedule: L1 in slot 0, only while the planned position differs from the last one told") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(4);
    driver.press("G1 X10 F600");
    driver.run_until(30);
    const auto l1 = driver.matching("L1", 4);
    REQUIRE(l1.size() == 1);
    CHECK(l1[0].body == "L1 X10.000 Y0.000 Z0.000 F10");
    // Recorded: L1 comes 1.491 s behind an L3, which is five slots.
    CHECK(l1[0].at - driver.matching("L3", 3, 4)[0].at == doctest::Approx(round_s - 2 * 0.29994));
    driver.press_all({"G91", "G1 X-10", "G90"});
    driver.run_until(60);
    CHECK(driver.matching("L1", 30).size() == 1);
}

TEST_CASE("schedule: L2 in slot 1 while a printed temperature is 1.0 or more away from the last one told") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(43.4);
    CHECK(driver.matching("L2", 5).empty());
    driver.press("M104 S200.0");
    driver.run_until(130);
    const auto l2 = driver.matching("L2", 43.4);
    // Recorded: 65 of 67 slots while heating.
    CHECK(l2.size() >= 37);
    CHECK(l2[0].at - 43.4 < 0.105);  // the reply, at once
    for (std::size_t i = 1; i < l2.size(); ++i) {
        const double slots = (l2[i].at - 0.54989 - 0.29994) / round_s;
        CHECK(slots == doctest::Approx(std::round(slots)).epsilon(1e-4));
    }
}

TEST_CASE("schedule: replies do not move it") {
    BoardDriver plain;
    BoardDriver asked;
    for (BoardDriver* driver : {&plain, &asked}) {
        driver->run_until(1);
        driver->meet_screen();
        for (int i = 0; i < 200; ++i) {
            driver->run_for(0.33);
            if (driver == &asked) {
                driver->press(i % 2 == 0 ? "M2140 S5" : "M115");
            }
        }
    }
    const auto l3 = plain.matching("L3");
    const auto busy = asked.matching("L3");
    REQUIRE(l3.size() == busy.size());
    for (std::size_t i = 0; i < l3.size(); ++i) {
        CHECK(busy[i].at - l3[i].at >= 0);
        CHECK(busy[i].at - l3[i].at <= 0.0501);  // it may wait one tick behind a reply in the queue
    }
}
