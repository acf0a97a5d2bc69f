// What each action of heaters, motion, mixing, filament and fans does.

#include "emulator/filament/event_rows.h"
#include "emulator/machine/event_rows.h"
#include "tests/behaviour/action_bench.h"

namespace fauxboard::testing {

const std::vector<ActionRow>& machine_action_rows() {
    static const std::vector<ActionRow> rows{
        {"set",
         [](Bench& b) {
             b.run(R"({"set": {"addons.sound": "{S}", "var.count": 7, "screen.firmware": "{FW:}"}})",
                   "M1 S1 FW:x");
             CHECK(b.number("addons.sound") == 1);
             CHECK(b.variables[0] == 7);
             CHECK(b.text("screen.firmware") == "x");
             b.run(R"({"set": {"addons.sound": "{Q}", "var.count": 99, "screen.firmware": "{XX:}"}})");
             CHECK(b.number("addons.sound") == 1);  // not on the line: left alone
             CHECK(b.variables[0] == 10);           // kept within its bounds
             CHECK(b.text("screen.firmware") == "x");
         }},
        {"add",
         [](Bench& b) {
             b.run(R"({"add": {"settings.double_z.z0": "{S}", "var.count": 2}})", "M1 S0.25");
             b.run(R"({"add": {"settings.double_z.z0": "{S}", "var.count": -0.5}})", "M1 S0.25");
             CHECK(b.number("settings.double_z.z0") == 0.5);
             CHECK(b.variables[0] == 2.5);
         }},
        {"heater.target",
         [](Bench& b) {
             b.run(R"({"heater.target": {"heater": "bed", "c": 60}})");
             CHECK(b.number("heaters.bed.target") == 60);
             b.run(R"({"heater.target": {"heater": "nozzle", "c": 9999}})");
             CHECK(b.number("heaters.nozzle.target") == 250);
             CHECK(b.notices.size() == 1);
             b.run(R"({"heater.target": {"heater": "{arg}", "c": 60}})", "M1 stove");
             CHECK(b.notices.back() == "unknown heater \"stove\"; expected nozzle or bed");
         }},
        {"heater.wait",
         [](Bench& b) {
             b.run(R"({"heater.wait": {"heater": "nozzle"}})");
             CHECK(b.number("heating.waiting") == 0);  // there is no target to wait for
             b.run(
                 R"([{"heater.target": {"heater": "nozzle", "c": 100}}, {"heater.wait": {"heater": "nozzle"}}])");
             CHECK(b.number("heating.waiting") == 1);
             CHECK(b.raised(filament::event("heating.wait_started")));
         }},
        {"heater.stop_waiting",
         [](Bench& b) {
             b.run(R"([{"heater.target": {"heater": "bed", "c": 60}}, {"heater.wait": {"heater": "bed"}}])");
             b.run(R"("heater.stop_waiting")");
             CHECK(b.number("heating.waiting") == 0);
             CHECK(b.raised(filament::event("heating.wait_done")));
             CHECK(b.number("heaters.bed.target") == 60);
         }},
        {"heater.all_off",
         [](Bench& b) {
             b.run(
                 R"([{"heater.target": {"heater": "bed", "c": 60}}, {"heater.target": {"heater": "nozzle", "c": 60}}])");
             b.run(R"("heater.all_off")");
             CHECK(b.number("heaters.bed.on") == 0);
             CHECK(b.number("heaters.nozzle.on") == 0);
         }},
        {"heaters.reported",
         [](Bench& b) {
             CHECK(b.number("heaters.moved") == 1);
             b.run(R"("heaters.reported")");
             CHECK(b.number("heaters.moved") == 0);
         }},
        {"motion.home",
         [](Bench& b) {
             b.run(R"({"motion.home": {"x": "{X?}", "y": "{Y?}", "z": "{Z?}"}})", "G28");
             CHECK(b.number("motors.enabled") == 1);
             b.pass(60);
             CHECK(b.number("motion.homed") == 1);
             CHECK(b.raised(machine::event("motion.homed")));
             b.run(R"({"motion.home": {"y": true}})");  // no procedure of that name here
             CHECK(b.notices.size() == 1);
         }},
        {"motion.run",
         [](Bench& b) {
             b.run(R"({"motion.run": {"procedure": "park"}})");
             b.pass(10);
             CHECK(b.number("position.y") == 190);
             b.run(R"({"motion.run": {"procedure": "{arg}"}})", "M1 nowhere");
             CHECK(b.notices.size() == 1);
         }},
        {"motion.move",
         [](Bench& b) {
             b.run(R"({"motion.move": {"x": "{X}", "y": "{Y}", "f": "{F}"}})", "G1 X20 F600");
             b.pass(10);
             CHECK(b.number("position.x") == 20);
             CHECK(b.number("position.y") == 0);
             CHECK(b.number("motion.feed") == 10);
             b.run(R"({"motion.move": {"x": -5, "relative": true}})");
             CHECK(b.number("position.x") == 15);
             b.run(R"({"motion.move": {"x": 999}})");
             CHECK(b.number("position.x") == 200);
             CHECK(b.notices.size() == 1);
             b.run(R"({"motion.move": {"z": -5, "limits": false}})");
             b.pass(60);
             CHECK(b.number("position.z") == -5);
         }},
        {"motion.set_position",
         [](Bench& b) {
             b.run(R"({"motion.set_position": {"x": 50, "e": 3}})");
             CHECK(b.number("position.x") == 50);
             CHECK(b.number("position.e") == 3);
             CHECK(b.number("motion.busy") == 0);
         }},
        {"motion.abort",
         [](Bench& b) {
             b.run(R"({"motion.move": {"x": 200, "f": 60}})");
             b.pass(1);
             b.run(R"("motion.abort")");
             CHECK(b.number("motion.busy") == 0);
         }},
        {"motors.enable",
         [](Bench& b) {
             b.run(R"("motors.enable")");
             CHECK(b.number("motors.enabled") == 1);
         }},
        {"motors.disable",
         [](Bench& b) {
             b.run(R"({"motion.home": {}})");
             b.pass(60);
             b.run(R"("motors.disable")");
             CHECK(b.number("motors.enabled") == 0);
             CHECK(b.number("motion.homed") == 0);
         }},
        {"fan.pwm",
         [](Bench& b) {
             b.run(R"([{"fan.pwm": {"fan": 0, "value": 128}}, {"fan.pwm": {"fan": 2, "value": 9999}}])");
             CHECK(b.number("fans.part") == 50);
             CHECK(b.number("fans.second") == 100);
             for (const char* fan : {"1", "3", "-1"}) {
                 b.run(R"({"fan.pwm": {"fan": "{S}", "value": 0}})", "M1 S" + string(fan));
             }
             CHECK(b.notices.size() == 3);
             CHECK(b.number("fans.part") == 50);
         }},
        {"mixer.weights",
         [](Bench& b) {
             b.run(R"({"mixer.weights": {"a": 1, "c": 1}})");
             CHECK(b.number("mixer.a") == 50);
             CHECK(b.number("mixer.c") == 50);
             b.run(R"({"mixer.weights": {}})");
             CHECK(b.notices.size() == 1);
         }},
        {"mixer.packed",
         [](Bench& b) {
             b.run(R"({"mixer.packed": {"ratio": 25600}})");
             CHECK(b.number("mixer.b") == 100);
             b.run(R"({"mixer.packed": {"ratio": 1}})");
             CHECK(b.notices.size() == 1);
         }},
        {"mixer.share",
         [](Bench& b) {
             b.run(R"({"mixer.share": {"channel": 1, "percent": 30}})");
             CHECK(b.number("mixer.a") == 70);
             CHECK(b.number("mixer.b") == 30);
             b.run(R"({"mixer.share": {"channel": "{S}", "percent": 30}})", "M1 S3");
             CHECK(b.notices.size() == 1);
         }},
        {"mixer.tool",
         [](Bench& b) {
             b.run(R"({"mixer.tool": {"tool": 2}})");
             CHECK(b.number("mixer.c") == 100);
             CHECK(b.number("mixer.tool") == 2);
         }},
        {"mixer.mode",
         [](Bench& b) {
             b.run(R"({"mixer.mode": {"mode": 3}})");
             CHECK(b.number("mixer.mode_shown") == 768);
         }},
        {"mixer.template",
         [](Bench& b) {
             b.run(R"({"mixer.template": {"template": 4}})");
             CHECK(b.number("mixer.template") == 4);
             CHECK(b.number("mixer.end_height") == 10);
         }},
        {"mixer.range",
         [](Bench& b) {
             b.run(R"({"mixer.range": {"start": 25600, "end_height": 7.5}})");
             CHECK(b.number("mixer.start") == 25600);
             CHECK(b.number("mixer.end") == 100);
             CHECK(b.number("mixer.end_height") == 7.5);
         }},
        {"filament.load",
         [](Bench& b) {
             b.run(R"("filament.load")");
             CHECK(b.raised(filament::event("filament.too_cold")));
             CHECK(b.number("filament.running") == 0);
             b.heat(200);
             b.pass(0.5);
             b.run(R"("filament.load")");
             CHECK(b.number("filament.running") == 1);
             b.pass(2);
             CHECK(b.raised(filament::event("filament.piece")));
         }},
        {"filament.unload",
         [](Bench& b) {
             b.heat(200);
             b.pass(0.5);
             b.run(R"("filament.unload")");
             CHECK(b.number("filament.running") == 1);
         }},
        {"filament.clean",
         [](Bench& b) {
             b.heat(200);
             b.pass(0.5);
             b.run(R"("filament.clean")");
             CHECK(b.number("filament.running") == 1);
         }},
        {"filament.once",
         [](Bench& b) {
             b.heat(200);
             b.pass(0.5);
             b.run(R"("filament.once")");
             CHECK(b.number("filament.running") == 1);
             b.pass(2);
             CHECK(b.number("filament.running") == 0);
             CHECK(b.raised(filament::event("filament.stopped")));
         }},
        {"filament.stop",
         [](Bench& b) {
             b.heat(200);
             b.pass(0.5);
             b.run(R"(["filament.load", "filament.stop"])");
             CHECK(b.number("filament.running") == 0);
             CHECK(b.raised(filament::event("filament.stopped")));
         }},
        {"filament.insert",
         [](Bench& b) {
             b.run(R"("filament.insert")");
             CHECK(b.number("filament.code") == 1);
             CHECK(b.raised(filament::event("filament.inserted")));
             b.run(R"("filament.insert")");
             CHECK_FALSE(b.raised(filament::event("filament.inserted")));  // it is in already
         }},
        {"filament.remove",
         [](Bench& b) {
             b.run(R"(["filament.insert", "filament.remove"])");
             CHECK(b.number("filament.code") == 0);
             CHECK(b.raised(filament::event("filament.removed")));
         }},
    };
    return rows;
}

}  // namespace fauxboard::testing
