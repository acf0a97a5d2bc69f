// What the actions of resin printers do. Their prints are tested with the boards that have them.

#include "emulator/machine/event_rows.h"
#include "emulator/resin/event_rows.h"
#include "tests/behaviour/action_bench.h"
#include "tests/support/printers.h"

namespace fauxboard::testing {

const std::vector<ActionRow>& resin_action_rows() {
    static const std::vector<ActionRow> rows{
        {"resin.move",
         [](Bench& b) {
             b.run(R"({"resin.move": {"z": "{Z}", "f": "{F}", "relative": "{I?}"}})", "G0 Z10 F600 I0");
             b.pass(10);
             CHECK(b.number("resin.z") == doctest::Approx(10));
             b.run(R"({"resin.move": {"z": "{Z}"}})", "G0 Z4");
             b.pass(10);
             CHECK(b.number("resin.z") == doctest::Approx(4));
         }},
        {"resin.home",
         [](Bench& b) {
             b.run(R"("resin.home")");
             b.pass(100);
             CHECK(b.raised(machine::event("motion.homed")));
             CHECK(b.number("resin.homed") == 1);
         }},
        {"resin.stir",
         [](Bench& b) {
             b.run(R"("resin.stir")");
             b.pass(1);
             CHECK(b.number("resin.moving") == 1);
         }},
        {"resin.motor_off",
         [](Bench& b) {
             b.run(R"("resin.home")");
             b.pass(100);
             b.run(R"("resin.motor_off")");
             CHECK(b.number("resin.motor") == 0);
             CHECK(b.number("resin.homed") == 0);
         }},
        {"resin.fan",
         [](Bench& b) {
             b.run(R"({"resin.fan": {"value": 300}})");
             CHECK(b.number("resin.led_fan") == 256);
         }},
        {"resin.choose",
         [](Bench& b) {
             b.run(R"({"resin.choose": {"name": "{name}"}})", "M23 '/sub/b.gcode'");
             CHECK(b.raised(machine::event("file.selected")));
             CHECK(b.text("resin.outcome") == "opened");
             CHECK(b.text("resin.asked") == "sub/b.gcode");
             CHECK(b.text("resin.file") == "/sub/b.gcode");
             CHECK(b.number("resin.file_bytes") == 4);
             b.run(R"({"resin.choose": {"name": "b.gcode"}})");  // by the last part of what was opened
             CHECK(b.text("resin.outcome") == "opened");
             b.run(R"({"resin.choose": {"name": "none"}})");
             CHECK(b.text("resin.outcome") == "missing");
             b.run(R"({"resin.choose": {"name": ""}})");
             CHECK(b.text("resin.outcome") == "no_name");
             b.run(R"("card.remove")");
             b.run(R"({"resin.choose": {"name": "a.gcode"}})");
             CHECK(b.text("resin.outcome") == "no_stick");
         }},
        {"resin.start",
         [](Bench& b) {
             b.run(R"("resin.start")");
             CHECK(b.text("resin.outcome") == "no_name");
             b.run(R"([{"resin.choose": {"name": "no.ctb"}}, "resin.start"])");
             CHECK(b.text("resin.outcome") == "unprintable");
             CHECK(b.number("job.active") == 0);
             b.run(R"([{"resin.choose": {"name": "a.gcode"}}, "resin.start"])");  // commands are carried out
             CHECK(b.text("resin.outcome") == "opened");
             b.run(R"("resin.start")");
             CHECK(b.text("resin.outcome") == "busy");
         }},
        {"resin.print",
         [](Bench& b) {
             b.run(R"({"resin.print": {"name": "no.ctb"}})");
             CHECK(b.text("resin.outcome") == "unprintable");
             b.run(R"({"resin.print": {"name": "none"}})");
             CHECK(b.text("resin.outcome") == "missing");
             b.run(R"({"resin.print": {"name": "a.gcode"}})");
             CHECK(b.text("resin.outcome") == "opened");
             b.run(R"({"resin.print": {"name": "none"}})");
             CHECK(b.text("resin.outcome") == "busy");
         }},
        {"resin.remove",
         [](Bench& b) {
             b.run(R"({"resin.remove": {"name": "a.gcode"}})");  // a built-in card cannot be written to
             CHECK(b.text("resin.outcome") == "not_removed");
         }},
        {"resin.write_backup",
         [](Bench& b) {
             b.run(R"({"resin.write_backup": {"name": "x"}})");
             CHECK(b.text("resin.outcome") == "not_written");
             CHECK(b.number("resin.replaced") == 0);
         }},
        {"resin.write_diagnostics",
         [](Bench& b) {
             b.run(R"({"resin.write_diagnostics": {"name": "a.gcode"}})");
             CHECK(b.text("resin.outcome") == "not_written");
             CHECK(b.number("resin.replaced") == 1);
         }},
        {"config.set",
         [](Bench& b) {
             b.run(R"("config.set")", "M8016 I4 T6 D7 X9");
             CHECK(b.number("config.home_again_speed") == 4);
             CHECK(b.number("config.lift_fast_speed") == 6);
             CHECK(b.number("config.lift_wait") == 7);
             CHECK(resin_printer(b.machine).used[resin::ResinSetting::lift_wait] == 1);
             b.run(R"("config.set")", "M8085 I99999");
             CHECK(b.number("config.logo") == 6000);
             CHECK(b.notices.size() == 1);
         }},
        {"config.use",
         [](Bench& b) {
             b.run(R"(["config.set", "config.use"])", "M8026 I100");
             CHECK(resin_printer(b.machine).used[resin::ResinSetting::max_height] == 100);
         }},
        {"wifi.join",
         [](Bench& b) {
             b.run(R"({"wifi.join": {"network": "{arg}"}})", "M9003 \"home\",\"secret\"");
             CHECK(b.text("wifi.ssid") == "home");
             CHECK(b.text("resin.wifi_password") == "secret");
             CHECK(b.number("wifi.access_point") == 0);
         }},
        {"wifi.open",
         [](Bench& b) {
             b.run(R"({"wifi.open": {"network": "{arg}"}})", "M9005 ap");
             CHECK(b.text("wifi.ssid") == "ap");
             CHECK(b.text("resin.wifi_password").empty());
             CHECK(b.number("wifi.access_point") == 1);
         }},
        {"board.wedge",
         [](Bench& b) {
             b.run(R"({"board.wedge": {"since": 0.5, "ms": 100}})");
             CHECK_FALSE(b.machine.hung());
             b.run(R"({"board.wedge": {"since": "{board.seconds}", "ms": 100}})");
             CHECK(b.machine.hung());
         }},
        {"board.reboot",
         [](Bench& b) {
             b.run(R"({"board.reboot": {"ms": 500}})");
             b.pass(0.4);
             CHECK_FALSE(b.raised(resin::event("board.reboot_due")));
             b.pass(0.2);
             CHECK(b.raised(resin::event("board.reboot_due")));
         }},
    };
    return rows;
}

}  // namespace fauxboard::testing
