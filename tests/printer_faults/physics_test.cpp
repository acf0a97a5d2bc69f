// What is broken, seen in the machine itself; and that nothing is found broken that is well.

#include <doctest/doctest.h>

#include "emulator/filament/event_rows.h"
#include "tests/printer_faults/cases.h"
#include "tests/support/board_driver.h"
#include "tests/support/printers.h"
#include "tests/support/small_profile.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using filament::HeaterId;
using filament::ThermalAlarm;

namespace {

void print(Rig& rig) {
    rig.do_it({{"op", "world"}, {"do", "filament in"}});
    rig.press("M23 long.gcode");
    rig.press("M24");
    rig.run_until(300);
    REQUIRE(rig.number("job.status") == 1);
}

double moved_in(Rig& rig, double seconds) {
    const double before = rig.number("filament.moved");
    rig.run_for(seconds);
    return rig.number("filament.moved") - before;
}

/// Brings the heater to each target in turn and holds it; what the board finds wrong then.
ThermalAlarm alarm_at(HeaterId heater, std::initializer_list<double> targets) {
    const filament::ThermalConfig config;
    filament::Thermal thermal(config, 1);
    machine::SimTime now{0};
    thermal.power_on(now);
    for (const double target : targets) {
        thermal.set_target(heater, target);
        for (int i = 0; i < 9000; ++i) {
            now += config.period;
            thermal.advance(now);
        }
    }
    return thermal.alarm(heater);
}

}  // namespace

TEST_CASE("protection: no heater that is well gives alarm, at any target and between any two") {
    for (double target = 25; target <= 250; target += 7.5) {
        CAPTURE(target);
        CHECK(alarm_at(HeaterId::nozzle, {target}) == ThermalAlarm::none);
        CHECK(alarm_at(HeaterId::nozzle, {250, target, 250, target / 2, target}) == ThermalAlarm::none);
        CHECK(alarm_at(HeaterId::bed, {target / 2.5}) == ThermalAlarm::none);
        CHECK(alarm_at(HeaterId::bed, {100, target / 2.5, 100}) == ThermalAlarm::none);
    }
}

TEST_CASE(
    "jam: what is extruded does not come out, or comes out in part, and does again when it is cleared") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    print(rig);
    const double well = moved_in(rig, 20);
    CHECK(well > 10);
    rig.add_fault("jam");
    CHECK(moved_in(rig, 20) < 2);  // the move under way still counts as it ends
    rig.add_fault("jam:lost=50");
    rig.run_for(1);
    CHECK(moved_in(rig, 20) == doctest::Approx(well / 2).epsilon(0.15));
    rig.do_it({{"op", "faults.remove"}, {"fault", "jam"}});
    CHECK(moved_in(rig, 20) == doctest::Approx(well).epsilon(0.15));
    rig.add_fault("cold_extrusion");
    rig.run_for(1);
    CHECK(moved_in(rig, 20) == 0);
}

TEST_CASE("jam: a detector that feels motion calls it out") {
    const auto profile = small_profile(R"({"machine": {"filament": {"detector_mm": 7, "piece_s": 0.5}}})");
    const auto config = std::static_pointer_cast<const filament::Config>(profile->machine);
    CHECK(config->filament.detector_mm == 7);
    LongCard card;
    filament::Printer machine(config, {&card, nullptr, nullptr, nullptr}, 1);
    machine.power_on(machine::SimTime{0});
    machine.set_filament(true);
    machine.filament.detector = true;
    machine.select_file("long.gcode");
    machine.start_or_resume_job();
    machine.advance(machine::from_seconds(300));
    machine.faults.add(machine.now(), machine::default_request(*machine::find_fault("jam")));
    machine.events.clear();
    machine.advance(machine::from_seconds(330));
    bool told = false;
    while (const auto event = machine.events.take()) {
        told = told || *event == filament::event("filament.out");
    }
    CHECK(told);
}

TEST_CASE("a stuck heater goes on heating when it is switched off, and cools when it is mended") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    rig.add_fault("too_hot:power=50");
    rig.run_for(100);
    CHECK(rig.number("heaters.nozzle.target") == 0);
    CHECK(rig.number("heaters.nozzle.power") == 0);
    const double warm = rig.number("heaters.nozzle.true");
    CHECK(warm > 80);
    rig.do_it({{"op", "faults.clear"}});
    rig.run_for(600);
    CHECK(rig.number("heaters.nozzle.true") < warm);
}

TEST_CASE("a loose sensor reads too little while the nozzle gets hotter than asked for") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    rig.press("M104 S200");
    rig.run_until(300);
    rig.add_fault("thermal_runaway:contact=80");
    rig.run_for(20);
    CHECK(rig.number("heaters.nozzle.printed") < 200);
    CHECK(rig.number("heaters.nozzle.true") > 205);
    rig.run_for(60);
    CHECK(rig.number("heaters.nozzle.true") > rig.number("heaters.nozzle.printed") + 30);
}

TEST_CASE("words for what was found wrong, until it is heated anew") {
    const std::pair<const char*, const char*> rows[] = {{"thermistor_open", "too cold"},
                                                        {"thermistor_short", "too hot"},
                                                        {"heater_dead", "does not heat"},
                                                        {"thermal_runaway:contact=30", "runs away"}};
    for (const auto& row : rows) {
        const std::string spec = row.first;
        CAPTURE(spec);
        Rig rig("geeetech-a30t", "geeetech-a30t");
        rig.run_until(5);
        rig.press("M104 S200");
        rig.run_until(spec == "heater_dead" ? 20 : 300);
        rig.add_fault(spec);
        rig.run_for(100);
        CHECK(rig.text("heaters.nozzle.alarm") == row.second);
        CHECK(rig.text("heaters.bed.alarm").empty());
        rig.do_it({{"op", "faults.clear"}});
        rig.run_for(1);
        rig.press("M104 S210");
        rig.run_for(5);
        CHECK(rig.text("heaters.nozzle.alarm").empty());
    }
}

TEST_CASE("homing with a dead end stop takes the way of the whole axis") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    rig.add_fault("endstop_dead:axis=y");
    const double from = rig.now();
    rig.press("G28");
    while (rig.number("motion.busy") != 0 && rig.now() < 200) {
        rig.run_for(0.5);
    }
    // X is homed first: 160 mm at 20 mm/s and the slow touch; then 320 mm of Y.
    CHECK(rig.now() - from == doctest::Approx(160 / 20.0 + 4.5 + 320 / 20.0).epsilon(0.05));
}

TEST_CASE("a board that hangs hears nothing, keeps its heaters as they were, and wakes with a reset") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    rig.press("M104 S200");
    rig.run_until(30);  // full power
    rig.add_fault("hang:for=100s");
    const double from = rig.now();
    const auto lost = rig.requests_lost();
    rig.press("M104 S0");
    rig.host("M105");
    rig.run_until(from + 99.9);
    CHECK(rig.said_since(from).empty());
    CHECK(rig.requests_lost() == lost + 2);
    CHECK(rig.number("board.hung") == 1);
    CHECK(rig.number("heaters.nozzle.true") > 180);  // nobody controls it
    CHECK(rig.number("heaters.nozzle.printed") < 80);
    rig.run_until(from + 110);
    CHECK(rig.number("board.hung") == 0);
    CHECK(rig.number("heaters.nozzle.target") == 0);
    CHECK_FALSE(rig.said_since(from + 99.9).empty());
    CHECK(rig.answers());
}

TEST_CASE("during a brown-out heaters have no power; the job is kept in the EEPROM") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    print(rig);
    const double hot = rig.number("heaters.nozzle.true");
    rig.add_fault("brown_out:for=60s");
    rig.run_for(59);
    CHECK(rig.number("heaters.nozzle.true") < hot - 10);
    CHECK(rig.number("board.hung") == 1);
    rig.run_for(5);
    CHECK(rig.number("power_loss.saved_job") == 1);
    rig.press("M2130 P0 S0");
    CHECK(rig.number("power_loss.saved_job") == 0);
}

TEST_CASE("physical faults outlive a reset of the board, what is in its memory does not") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    const char* const physical[] = {"jam", "thermistor_open", "endstop_dead", "card_removed", "filament_out"};
    const char* const memory[] = {"probe_alarm", "refused", "pid_question", "wait_for_user"};
    for (const char* spec : physical) {
        rig.add_fault(spec);
    }
    for (const char* spec : memory) {
        rig.add_fault(spec);
    }
    rig.run_for(1);
    rig.add_fault("board_reset");
    rig.run_for(5);
    for (const char* name : physical) {
        CAPTURE(std::string(name));
        CHECK(rig.number("faults." + std::string(name)) == 1);
    }
    for (const char* name : memory) {
        CAPTURE(std::string(name));
        CHECK(rig.number("faults." + std::string(name)) == 0);
    }
}
