// What each action of leveling, card, job, EEPROM and the board itself does.

#include "emulator/filament/event_rows.h"
#include "emulator/machine/event_rows.h"
#include "tests/behaviour/action_bench.h"

namespace fauxboard::testing {

const std::vector<ActionRow>& device_action_rows() {
    static const std::vector<ActionRow> rows{
        {"leveling.enter",
         [](Bench& b) {
             b.run(R"("leveling.enter")");
             CHECK(b.number("leveling.manual") == 1);
             b.pass(5);
             CHECK(b.number("position.z") == 8);
         }},
        {"leveling.adjust",
         [](Bench& b) {
             b.run(R"({"leveling.adjust": {"mm": -0.5}})");
             CHECK(b.number("leveling.manual_z") == 7.5);
             CHECK(b.number("position.z") == -0.5);
             b.run(R"({"leveling.adjust": {"mm": 1e9}})");
             CHECK(b.number("leveling.manual_z") == 500);
         }},
        {"card.insert",
         [](Bench& b) {
             b.run(R"(["card.remove", "card.insert"])");
             CHECK(b.number("card.usable") == 1);
             CHECK(b.raised(machine::event("card.inserted")));
         }},
        {"card.remove",
         [](Bench& b) {
             b.run(R"("card.remove")");
             CHECK(b.number("card.code") == 1);
             CHECK(b.raised(machine::event("card.removed")));
         }},
        {"card.fail",
         [](Bench& b) {
             b.run(R"("card.fail")");
             CHECK(b.number("card.code") == 2);
             CHECK(b.raised(machine::event("card.failed")));
             b.run(R"("card.insert")");
             CHECK(b.number("card.code") == 0);
         }},
        {"udisk.insert",
         [](Bench& b) {
             b.run(R"("udisk.insert")");  // this board has no port for one
             CHECK_FALSE(b.machine.storage.usable(1));
             CHECK_FALSE(b.raised(machine::event("card.inserted")));
         }},
        {"udisk.remove",
         [](Bench& b) {
             const std::vector<machine::BuiltInEntry> files;
             machine::BuiltInVolume disk(files);
             b.machine.storage.attach(1, &disk);
             b.run(R"("udisk.remove")");
             CHECK_FALSE(b.machine.storage.usable(1));
             CHECK(b.raised(machine::event("card.removed")));
         }},
        {"udisk.fail",
         [](Bench& b) {
             const std::vector<machine::BuiltInEntry> files;
             machine::BuiltInVolume disk(files);
             b.machine.storage.attach(1, &disk);
             b.run(R"("udisk.fail")");
             CHECK(b.machine.storage.state(1) == machine::DiskState::failed);
             CHECK(b.raised(machine::event("card.failed")));
         }},
        {"card.mount",
         [](Bench& b) {
             b.run(R"(["card.release", "card.mount"])");
             CHECK(b.number("card.code") == 0);
             b.run(R"(["card.remove", "card.mount"])");
             CHECK(b.number("card.code") == 1);  // there is none in the slot
         }},
        {"card.release",
         [](Bench& b) {
             b.run(R"("card.release")");
             CHECK(b.number("card.code") == 1);
             CHECK_FALSE(b.raised(machine::event("card.removed")));
         }},
        {"card.choose",
         [](Bench& b) {
             b.run(R"({"card.choose": {"disk": 1}})");
             CHECK(b.number("card.chosen") == 1);
             b.run(R"({"card.choose": {"disk": "{S}"}})", "M1 S2");
             CHECK(b.number("card.chosen") == 1);
             CHECK(b.notices.size() == 1);
         }},
        {"card.enter",
         [](Bench& b) {
             b.run(R"({"card.enter": {"name": "{arg}"}})", "M20 file:SD1:/sub");
             CHECK(b.text("card.folder") == "sub");
             b.run(R"({"card.enter": {"name": "../.."}})");
             CHECK(b.text("card.folder") == "sub");
             CHECK(b.notices.size() == 1);
         }},
        {"card.root",
         [](Bench& b) {
             b.run(R"([{"card.enter": {"name": "sub"}}, "card.root"])");
             CHECK(b.text("card.folder").empty());
         }},
        {"job.select",
         [](Bench& b) {
             b.run(R"({"job.select": {"name": "a.gcode"}})");
             CHECK(b.raised(machine::event("file.selected")));
             CHECK(b.text("job.path") == "a.gcode");
             b.run(R"({"job.select": {"name": "b.gcode"}})");
             CHECK(b.raised(machine::event("file.missing")));
             b.run(R"({"job.select": {"name": "sub"}})");
             CHECK(b.raised(machine::event("file.unreadable")));
         }},
        {"job.start",
         [](Bench& b) {
             b.run(R"("job.start")");
             CHECK(b.notices.size() == 1);
             b.run(R"([{"job.select": {"name": "a.gcode"}}, "job.start"])");
             CHECK(b.raised(machine::event("job.started")));
             CHECK(b.number("job.status") == 1);
         }},
        {"job.pause",
         [](Bench& b) {
             b.print();
             b.run(R"("job.pause")");
             CHECK(b.number("job.pausing") == 1);
             b.run(R"("job.pause")");
             CHECK(b.raised(machine::event("job.pausing")));
             b.pass(10);
             CHECK(b.raised(machine::event("job.paused")));
             CHECK(b.number("job.status") == 2);
             b.run(R"("job.start")");
             CHECK(b.raised(machine::event("job.resumed")));
         }},
        {"job.stop",
         [](Bench& b) {
             b.print();
             b.run(R"([{"heater.target": {"heater": "bed", "c": 60}}, "job.stop"])");
             CHECK(b.raised(machine::event("job.stopped")));
             CHECK(b.number("job.status") == 0);
             CHECK(b.number("heaters.bed.target") == 0);
         }},
        {"job.finish",
         [](Bench& b) {
             b.print();
             b.run(R"("job.finish")");
             CHECK(b.raised(machine::event("job.finished")));
             CHECK(b.number("job.progress") == 100);
         }},
        {"job.close",
         [](Bench& b) {
             b.print();
             b.run(R"("job.close")");
             CHECK(b.number("job.status") == 1);  // only a finished one
             b.run(R"(["job.finish", "job.close"])");
             CHECK(b.raised(machine::event("job.closed")));
             CHECK(b.number("job.status") == 0);
         }},
        {"job.seek",
         [](Bench& b) {
             b.print();
             b.run(R"({"job.seek": {"byte": 2}})");
             CHECK(b.number("job.byte") == 2);
         }},
        {"job.recover",
         [](Bench& b) {
             b.run(R"("job.recover")");
             CHECK(b.number("job.status") == 0);  // nothing was cut off
             b.print();
             b.pass(0.1);
             b.machine.power_on(b.now);
             CHECK(b.number("power_loss.saved_job") == 1);
             b.run(R"("job.recover")");
             CHECK(b.number("job.status") == 3);
         }},
        {"job.forget",
         [](Bench& b) {
             b.print();
             b.pass(0.1);
             b.run(R"("job.forget")");  // not the one under way
             b.machine.power_on(b.now);
             CHECK(b.number("power_loss.saved_job") == 1);
             b.run(R"("job.forget")");
             CHECK(b.number("power_loss.saved_job") == 0);
         }},
        {"eeprom.save",
         [](Bench& b) {
             b.run(R"([{"set": {"settings.steps.x": 99}}, {"eeprom.save": {"fields": "settings."}}])");
             CHECK(b.machine.eeprom_image.text().find("settings.steps.x 99\n") != string::npos);
             CHECK(b.machine.eeprom_image.text().find("addons.sound") == string::npos);
         }},
        {"eeprom.load",
         [](Bench& b) {
             b.run(R"([{"set": {"settings.steps.x": 99, "settings.steps.y": 98}},
                       {"eeprom.load": {"fields": "settings.steps.x"}}])");
             CHECK(b.number("settings.steps.x") == 80);
             CHECK(b.number("settings.steps.y") == 98);
         }},
        {"eeprom.defaults",
         [](Bench& b) {
             b.machine.eeprom_image = "settings.steps.x 5\n";
             b.run(R"([{"set": {"settings.steps.x": 99}}, "eeprom.defaults"])");
             CHECK(b.number("settings.steps.x") == 80);
             CHECK(b.machine.eeprom_image.text() == "settings.steps.x 5\n");
         }},
        {"stepper.select",
         [](Bench& b) {
             b.run(R"({"stepper.select": {"motor": 3}})");
             CHECK(b.number("stepper.selected") == 3);
             b.run(R"({"stepper.select": {"motor": 4}})");
             CHECK(b.number("stepper.selected") == 3);
             CHECK(b.notices.size() == 1);
         }},
        {"machine.stop",
         [](Bench& b) {
             b.print();
             b.run(
                 R"([{"heater.target": {"heater": "bed", "c": 60}}, {"motion.move": {"x": 100}}, "machine.stop"])");
             CHECK(b.number("job.status") == 0);
             CHECK(b.number("heaters.bed.target") == 0);
             CHECK(b.number("motors.enabled") == 0);
             CHECK(b.number("motion.busy") == 0);
         }},
        {"card.told",
         [](Bench& b) {
             b.machine.power_on(b.now);
             CHECK(b.number("card.news") == 1);
             b.run(R"("card.told")");
             CHECK(b.number("card.news") == 0);
         }},
        {"job.end",
         [](Bench& b) {
             b.print();
             b.pass(0.1);
             b.run(R"([{"heater.target": {"heater": "bed", "c": 60}}, "job.end"])");
             CHECK(b.number("job.ending") == 1);
             CHECK(b.number("motion.busy") == 0);
             CHECK(b.number("heaters.bed.target") == 60);
             CHECK(b.raised(filament::event("job.ended")));
             b.run(R"("job.close")");
             CHECK(b.number("job.status") == 0);
             b.run(R"("job.end")");
             CHECK(b.number("job.ending") == 0);
         }},
        {"timer.start",
         [](Bench& b) {
             b.run(R"({"timer.start": {"ms": 500}})");
             b.pass(0.4);
             CHECK_FALSE(b.raised(machine::event("timer.over")));
             b.run(R"({"timer.start": {"ms": 500}})");
             b.pass(0.4);
             CHECK_FALSE(b.raised(machine::event("timer.over")));
             b.pass(0.2);
             CHECK(b.raised(machine::event("timer.over")));
         }},
        {"board.stall",
         [](Bench& b) {
             b.run(R"({"board.stall": {"ms": 40}})");
             CHECK(b.machine.loop.take_stall() == machine::SimTime{40000});
             CHECK(b.machine.loop.take_stall() == machine::SimTime{0});
             for (int i = 0; i < 100; ++i) {
                 b.run(R"({"board.stall": {"ms": 40, "most_ms": 150}})");
                 const auto stall = b.machine.loop.take_stall();
                 CHECK(stall >= machine::SimTime{40000});
                 CHECK(stall <= machine::SimTime{150000});
             }
         }},
        {"board.reset",
         [](Bench& b) {
             b.run(R"("board.reset")");
             CHECK(b.reset);
         }},
    };
    return rows;
}

}  // namespace fauxboard::testing
