// What the firmware 0.08 has beyond 0.01: a calibration of the touch sensor, a clock chip, a fan of the
// board.

#include <doctest/doctest.h>

#include <string>

#include "emulator/fault/printer_fault.h"
#include "emulator/fault/spec.h"
#include "tests/touch/mks_bench.h"

namespace fauxboard::testing {
namespace {

constexpr std::string_view own = "mks-dlp-0.08";

/// From power-on to the main page, and then loads these settings.
void start_with(MksBench& bench, const std::string& acfg) {
    bench.stick.entries = {{"a.acfg", acfg}};
    bench.run_to_main();
    bench.act(R"({"setup.load": {"name": "a.acfg"}})");
    bench.run_for(5);
    REQUIRE(bench.box() == "Completed");
    REQUIRE(bench.tap("OK") == "");
}

void open_calibration(MksBench& bench) {
    REQUIRE(bench.tap("Service") == "");
    REQUIRE(bench.tap("Page down") == "");
    REQUIRE(bench.tap("Touch calibration") == "");
    REQUIRE(bench.page() == "Touch calibration");
}

void tap_targets(MksBench& bench) {
    bench.tap(432, 160);
    bench.tap(240, 288);
    bench.tap(48, 32);
    bench.run_for(1);
}

TEST_CASE("0.08: a touch sensor that is off misses its controls until it is calibrated, and that is kept") {
    MksBench bench({}, own);
    bench.run_to_main();
    open_calibration(bench);
    bench.board.tinker(bench.now, [&](machine::Machine& machine) {
        machine.faults.add(bench.now, fault::to_request(fault::fault_from_text("touch_shifted:x=60,y=-20")));
    });
    tap_targets(bench);
    CHECK(bench.box_text() == "Sensor calibration completed.");
    CHECK(bench.field("setup.touch_xx") == doctest::Approx(1));
    CHECK(bench.field("setup.touch_x0") == doctest::Approx(-60));
    CHECK(bench.field("setup.touch_y0") == doctest::Approx(20));
    CHECK(bench.tap("OK") == "");
    CHECK(bench.page() == "Service");
    bench.tap(436, 280);  // Page down
    bench.tap(20, 110);   // Touch calibration, at its edge
    CHECK(bench.page() == "Touch calibration");
    bench.tap(240, 160, 2);  // held: out of there
    CHECK(bench.page() == "Service");

    bench.power_cycle();
    CHECK(bench.field("setup.touch_x0") == doctest::Approx(-60));
    CHECK(bench.tap("Info") == "");
    CHECK(bench.page() == "Info");
    CHECK(bench.tap("Back") == "");
    // The sensor is right again: now the calibration is wrong.
    bench.act(R"({"fault.clear": {"fault": "touch_shifted"}})");
    bench.run_for(0.1);
    bench.tap(250, 218);  // Info
    CHECK(bench.page() == "Service");
}

TEST_CASE(
    "0.08: a finger on the glass at power-on forgets the calibration, but in the corner of the console") {
    for (const bool corner : {false, true}) {
        CAPTURE(corner);
        MksBench bench({}, own);
        bench.run_to_main();
        bench.set("setup.touch_x0", -60);
        bench.act(R"({"setup.save": {}})");
        bench.run_for(1);
        bench.screen.touch(bench.now, corner ? 470 : 100, corner ? 10 : 100, SimTime{3'000'000});
        bench.board.power_on(bench.now);
        bench.run_for(5);
        CHECK(bench.page() == "Console");
        bench.power_cycle();
        CHECK(bench.field("setup.touch_x0") == (corner ? -60 : 0));
    }
}

TEST_CASE("0.08: a calibration in one line begins anew; one of a turned glass is right as well") {
    MksBench bench({}, own);
    bench.run_to_main();
    open_calibration(bench);
    for (const int x : {100, 200, 300}) {
        bench.tap(x, 100);
    }
    bench.run_for(1);
    CHECK(bench.page() == "Touch calibration");
    CHECK(bench.box().empty());
    CHECK(bench.field("setup.touch_x0") == 0);
    bench.set("setup.rotate_display", 1);
    bench.tap(479 - 432, 319 - 160);
    bench.tap(479 - 240, 319 - 288);
    bench.tap(479 - 48, 319 - 32);
    bench.run_for(1);
    CHECK(bench.box_text() == "Sensor calibration completed.");
    CHECK(bench.field("setup.touch_xx") == doctest::Approx(1));
    CHECK(bench.field("setup.touch_x0") == doctest::Approx(0).epsilon(1e-3));
    CHECK(bench.tap("OK") == "");
    CHECK(bench.tap("Page down") == "");
}

TEST_CASE("0.08: a calibration held too long changes nothing") {
    MksBench bench({}, own);
    bench.run_to_main();
    open_calibration(bench);
    bench.tap(432, 160);
    bench.tap(200, 200, 2);
    CHECK(bench.page() == "Service");
    CHECK(bench.field("setup.touch_xx") == 1);
    CHECK(bench.field("setup.touch_x0") == 0);
}

TEST_CASE("0.08: the external clock is set, too, and a box says when it is not") {
    MksBench bench({}, own);
    start_with(bench, "[General]\nuse_external_clock = 1\n");
    bench.act(R"({"clock.set": {"year": 2021, "month": 6, "day": 1, "hour": 12, "minute": 30}})");
    CHECK(bench.box().empty());
    bench.set("clock.hour", 5);  // the board's own clock goes wrong: it has no battery
    bench.power_cycle();
    CHECK(bench.field("clock.hour") == 12);

    bench.act(R"({"fault.set": {"fault": "clock_dead"}})");
    bench.run_for(0.1);
    CHECK(bench.field("clock.external") == 0);
    REQUIRE(bench.tap("Service") == "");
    REQUIRE(bench.tap("Settings") == "");
    REQUIRE(bench.tap("Clock/Calendar") == "");
    REQUIRE(bench.tap("Hour up") == "");
    REQUIRE(bench.tap("OK") == "");
    CHECK(bench.box() == "Warning!");
    CHECK(bench.box_text() == "External clock setting error!");
    CHECK(bench.field("clock.hour") == 13);
    CHECK(bench.tap("OK") == "");
    CHECK(bench.page() == "Settings");
    bench.act(R"({"fault.clear": {"fault": "clock_dead"}})");
    bench.power_cycle();
    CHECK(bench.field("clock.hour") == 12);  // as it was told last
}

TEST_CASE("0.08: who does not use the external clock hears nothing of it") {
    MksBench bench({}, own);
    bench.run_for(0.2);
    CHECK(bench.has_text("PERIFERY INITIALIZATION..."));
    CHECK(bench.text_field("board.step") == "clock");
    bench.run_to_main();
    bench.act(R"({"fault.set": {"fault": "clock_dead"}})");
    bench.run_for(0.1);
    bench.act(R"({"clock.set": {"year": 2021, "month": 6, "day": 1, "hour": 12, "minute": 30}})");
    CHECK(bench.box().empty());
    bench.set("setup.use_external_clock", 1);
    bench.act(R"({"setup.save": {}})");
    bench.run_for(1);
    bench.board.power_on(bench.now);
    bench.run_for(0.2);
    CHECK(bench.has_text("EXTERNAL CLOCK ..."));
}

TEST_CASE("0.08: the board's own fan") {
    struct Mode {
        const char* value;
        bool idle;
        bool lit;
    };
    for (const Mode& mode :
         {Mode{"0", false, false}, Mode{"1", false, true}, Mode{"2", true, true}, Mode{"7", false, false}}) {
        CAPTURE(mode.value);
        MksBench bench({}, own);
        start_with(bench, std::string("[Printing]\nmb_fan_mode = ") + mode.value + "\n");
        CHECK(bench.field("fan.board") == mode.idle);
        bench.act(R"({"uvtest.light": {"on": true}})");
        CHECK(bench.field("fan.uv") == 1);
        CHECK(bench.field("fan.board") == mode.lit);
    }
    MksBench first;
    first.run_to_main();
    CHECK(first.field("fan.board") == 0);
}

}  // namespace
}  // namespace fauxboard::testing
