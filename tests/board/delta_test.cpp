// A delta printer of the same protocol: a profile, and no line of C++.

#include <doctest/doctest.h>

#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

constexpr const char* geometry = " H260.00 O0.00 R95.00 D215.00 F145.00\n";

}  // namespace

TEST_CASE("delta: manual leveling tells the geometry, steps by 0.1 mm, and homes with S4 and S13") {
    BoardDriver driver("smartto-delta");
    driver.run_until(1);
    driver.meet_screen();
    const auto ask = [&](const char* request) {
        driver.run_to_quiet();
        return join(driver.ask(request, 0.15));
    };
    const std::string flat = std::string(" X0.00 Y0.00 Z0.00") + geometry;
    CHECK(ask("M2107 S0") == "raw:M2107 Z:10.00\nL10 S10.00" + flat);
    driver.run_for(40);
    CHECK(driver.number("motion.homed") == 1);
    CHECK(driver.number("position.z") == 10);
    CHECK(ask("M2107 S9") == "raw:M2107 Z:9.90\nL10 S9.90" + flat);
    CHECK(ask("M2107 S10") == "raw:M2107 Z:10.00\nL10 S10.00" + flat);
    CHECK(ask("M2107 S6") == "raw:M2107 Z:10.50\nL10 S10.50" + flat);
    CHECK(ask("M2107 S1") == "raw:M2107 ok\nL10 S10.50" + flat);
    CHECK(ask("M2107 S12 X-0.5 Z0.25") == std::string("L10 S10.50 X-0.50 Y0.00 Z0.25") + geometry);
    driver.run_for(20);
    for (const char* request : {"M2107 S4", "M2107 S13"}) {
        CAPTURE(request);
        driver.press("G1 X100 F6000");
        driver.run_for(5);
        driver.press(request);
        driver.run_for(60);
        CHECK(driver.number("position.x") == 0);
        CHECK(driver.number("motion.homed") == 1);
    }
}

TEST_CASE("delta: its geometry is stored and comes back as the factory's with M502") {
    BoardDriver driver("smartto-delta");
    driver.run_until(1);
    driver.press_all({"M2107 S12 X-0.5", "M500"});
    driver.run_for(1);
    driver.world("board reset");
    driver.run_for(1);
    CHECK(driver.number("delta.endstop.x") == -0.5);
    driver.press("M502");
    driver.run_for(0.3);
    CHECK(driver.number("delta.endstop.x") == 0);
    CHECK(driver.number("delta.rod") == 215);
}
