// What the actions of the MKS DLP board do. Its prints are tested with the board itself.

#include "emulator/dlp/event_rows.h"
#include "tests/behaviour/action_bench.h"

namespace fauxboard::testing {
namespace {

using dlp::event;

/// An action that is refused says so, and nothing else.
void refused(Bench& b, const string& todo, std::string_view why) {
    CAPTURE(todo);
    b.notices.clear();
    b.run(todo);
    REQUIRE(b.notices.size() == 1);
    CHECK(b.notices[0].find(why) != string::npos);
    b.notices.clear();
}

void started(Bench& b) {
    b.run(R"({"print.start": {"path": "m.cbddlp"}})");
    CHECK(b.raised(event("print.started")));
    CHECK(b.number("print.active") == 1);
    CHECK(b.text("print.file") == "m.cbddlp");
    CHECK(b.number("print.layers") == 3);
}

void homed(Bench& b) {
    b.run(R"("platform.home")");
    CHECK(b.number("platform.homing") == 1);
    b.pass(60);  // not longer: a motor that is off forgets it
    CHECK(b.raised(event("platform.homed")));
    CHECK(b.number("platform.homed") == 1);
}

const std::vector<ActionRow> print_rows{
    {"print.start",
     [](Bench& b) {
         refused(b, R"({"print.start": {"path": "none.cbddlp"}})", "no such file");
         refused(b, R"({"print.start": {"path": "../m.cbddlp"}})", "no such file");
         refused(b, R"("print.start")", "no such file");  // none is viewed
         b.run(R"([{"view.open": {"name": "m.cbddlp"}}, "print.start"])");
         CHECK(b.text("print.path") == "m.cbddlp");
         b.pass(1000);
         CHECK(b.raised(event("print.finished")));
         CHECK(b.number("print.active") == 0);
     }},
    {"print.pause",
     [](Bench& b) {
         refused(b, R"("print.pause")", "no print is under way");
         started(b);
         b.run(R"("print.pause")");
         CHECK(b.number("print.paused") == 1);
         CHECK(b.raised(event("print.paused")));
         refused(b, R"("print.pause")", "it is so already");
     }},
    {"print.resume",
     [](Bench& b) {
         refused(b, R"("print.resume")", "no print is under way");
         started(b);
         b.run(R"(["print.pause", "print.resume"])");
         CHECK(b.number("print.paused") == 0);
         CHECK(b.raised(event("print.resumed")));
     }},
    {"print.toggle_pause",
     [](Bench& b) {
         refused(b, R"("print.toggle_pause")", "no print is under way");
         started(b);
         b.run(R"("print.toggle_pause")");
         CHECK(b.number("print.paused") == 1);
         b.run(R"("print.toggle_pause")");
         CHECK(b.number("print.paused") == 0);
     }},
    {"print.stop",
     [](Bench& b) {
         refused(b, R"("print.stop")", "no print is under way");
         started(b);
         b.run(R"("print.stop")");
         CHECK(b.number("print.cancelled") == 1);
         b.pass(200);
         CHECK(b.raised(event("print.cancelled")));
         CHECK(b.number("print.active") == 0);
     }},
    {"uvtest.image",
     [](Bench& b) {
         refused(b, R"({"uvtest.image": {"n": 0}})", "chosen already, or not now");
         b.run(R"({"uvtest.image": {"n": 2}})");
         CHECK(b.number("uvtest.image") == 2);
         b.pass(30);
         CHECK(b.raised(event("uvtest.loaded")));
         CHECK(b.number("panel.bank1_lit") > 0);
     }},
    {"uvtest.light",
     [](Bench& b) {
         b.run(R"({"uvtest.light": {"on": 1}})");
         CHECK(b.number("lamp.on") == 1);
         b.run(R"({"uvtest.light": {"on": 0}})");
         CHECK(b.number("lamp.on") == 0);
         b.run(R"({"uvtest.light": {"on": 1}})");
         b.pass(121);
         CHECK(b.raised(event("uvtest.light_off")));
         started(b);
         refused(b, R"({"uvtest.light": {"on": 1}})", "not while printing");
     }},
    {"uvtest.display",
     [](Bench& b) {
         b.run(R"([{"uvtest.image": {"n": 1}}, {"uvtest.display": {"on": 1}}])");
         b.pass(30);
         CHECK(b.number("uvtest.display") == 1);
         b.run(R"({"uvtest.display": {"on": 0}})");
         CHECK(b.number("uvtest.display") == 0);
         started(b);
         refused(b, R"({"uvtest.display": {"on": 1}})", "not while printing");
     }},
    {"uvtest.leave",
     [](Bench& b) {
         b.run(R"([{"uvtest.light": {"on": 1}}, "uvtest.leave"])");
         CHECK(b.number("lamp.on") == 0);
         CHECK(b.number("uvtest.light") == 0);
         started(b);
         refused(b, R"("uvtest.leave")", "not while printing");
     }},
};

const std::vector<ActionRow> platform_rows{
    {"platform.home",
     [](Bench& b) {
         homed(b);
         started(b);
         refused(b, R"("platform.home")", "a print is under way");
     }},
    {"platform.jog",
     [](Bench& b) {
         const double from = b.number("platform.z");
         b.run(R"({"platform.jog": {"mm": 10}})");
         CHECK(b.text("platform.going") == "up");
         b.run(R"({"platform.jog": {"mm": -4}})");  // steps add up
         b.pass(60);
         CHECK(b.number("platform.moving") == 0);
         CHECK(b.number("platform.z") == doctest::Approx(from + 6));
     }},
    {"platform.stop",
     [](Bench& b) {
         refused(b, R"("platform.stop")", "nothing moves by hand");
         b.run(R"({"platform.jog": {"mm": 50}})");
         b.pass(1);
         b.run(R"("platform.stop")");
         b.pass(1);
         CHECK(b.raised(event("platform.stopped")));
         CHECK(b.number("platform.moving") == 0);
     }},
    {"platform.set_zero",
     [](Bench& b) {
         refused(b, R"("platform.set_zero")", "not homed");
         homed(b);
         b.run(R"({"platform.jog": {"mm": 5}})");
         b.pass(60);
         b.run(R"("platform.set_zero")");
         CHECK(b.number("platform.height") == doctest::Approx(0));
         CHECK(b.number("platform.zero") == doctest::Approx(b.number("platform.z")));
         b.pass(10);
         CHECK(b.raised(event("platform.zero_set")));
     }},
    {"platform.raise",
     [](Bench& b) {
         refused(b, R"("platform.raise")", "the platform moves");
         homed(b);
         b.run(R"("platform.raise")");
         b.pass(120);
         CHECK(b.number("platform.z") == doctest::Approx(100));
     }},
};

const std::vector<ActionRow> file_rows{
    {"files.enter",
     [](Bench& b) {
         refused(b, R"({"files.enter": {"name": "none"}})", "no such folder");
         refused(b, R"({"files.enter": {"name": ".."}})", "no such folder");
         b.run(R"({"files.enter": {"name": "sub"}})");
         CHECK(b.text("files.folder") == "/sub/");
         CHECK(b.number("files.count") == 1);
     }},
    {"files.up",
     [](Bench& b) {
         refused(b, R"("files.up")", "this is the root");
         b.run(R"([{"files.enter": {"name": "sub"}}, "files.up"])");
         CHECK(b.number("files.root") == 1);
         CHECK(b.number("files.count") == 3);
     }},
    {"files.home",
     [](Bench& b) {
         b.run(R"([{"files.enter": {"name": "sub"}}, "files.home"])");
         CHECK(b.text("files.folder") == "/");
     }},
    {"files.delete",
     [](Bench& b) {
         b.run(R"({"view.open": {"name": "m.cbddlp"}})");
         refused(b, R"("files.delete")", "cannot be deleted");  // what a profile brings along
         CHECK(b.raised(event("files.not_deleted")));
         CHECK(b.number("files.count") == 3);
     }},
    {"view.open",
     [](Bench& b) {
         refused(b, R"({"view.open": {"name": "none.pws"}})", "no such file to print");
         b.run(R"({"view.open": {"name": "m.cbddlp"}})");
         CHECK(b.number("view.ok") == 1);
         CHECK(b.text("view.name") == "m.cbddlp");
         CHECK(b.number("view.layers") == 3);
         CHECK(b.number("view.light_s") == doctest::Approx(2));
     }},
    {"stick.in",
     [](Bench& b) {
         b.run(R"(["stick.out", "stick.in"])");
         CHECK(b.number("files.stick") == 1);
         CHECK(b.number("files.count") == 3);
     }},
    {"stick.out",
     [](Bench& b) {
         b.run(R"("stick.out")");
         CHECK(b.raised(event("files.changed")));
         CHECK(b.number("files.stick") == 0);
         CHECK(b.number("files.count") == 0);
         refused(b, R"({"print.start": {"path": "m.cbddlp"}})", "no such file");
     }},
};

const std::vector<ActionRow> board_rows{
    {"setup.load",
     [](Bench& b) {
         b.run(R"({"setup.load": {"name": "set.acfg"}})");
         refused(b, R"({"setup.load": {"name": "set.acfg"}})", "not now");
         b.pass(60);
         CHECK(b.raised(event("setup.loaded")));
         CHECK(b.number("setup.buzzer_touch_ms") == 33);
         b.run(R"({"setup.load": {"name": "none.acfg"}})");
         b.pass(60);
         CHECK(b.raised(event("setup.failed")));
         CHECK(b.text("setup.error") == "not_opened");
     }},
    {"setup.save",
     [](Bench& b) {
         b.run(R"("setup.save")");
         CHECK(b.text("setup.busy") == "saving");
         refused(b, R"("setup.save")", "being kept already");
         b.pass(60);
         CHECK(b.raised(event("setup.saved")));
     }},
    {"setup.language",
     [](Bench& b) {
         b.run(R"({"setup.language": {"n": 1}})");
         CHECK(b.number("setup.language") == 1);
         b.pass(60);
         refused(b, R"({"setup.language": {"n": 2}})", "languages 0 and 1");
         CHECK(b.number("setup.language") == 1);
     }},
    {"clock.set",
     [](Bench& b) {
         b.run(R"({"clock.set": {"year": 2024, "month": 2, "day": 29, "hour": 23, "minute": 59}})");
         CHECK(b.number("clock.day") == 29);
         CHECK(b.number("clock.weekday") == 4);
         b.pass(61);
         CHECK(b.number("clock.month") == 3);
         CHECK(b.number("clock.day") == 1);
         refused(b, R"({"clock.set": {"year": 2023, "month": 2, "day": 29, "hour": 0, "minute": 0}})",
                 "no such date");
     }},
    {"touch.calibrate",
     [](Bench& b) {
         b.run(R"({"touch.calibrate": {"x1": 442, "y1": 160, "x2": 250, "y2": 288, "x3": 58, "y3": 32}})");
         CHECK(b.number("setup.touch_xx") == doctest::Approx(1));
         CHECK(b.number("setup.touch_x0") == doctest::Approx(-10));
         CHECK(b.number("setup.touch_yy") == doctest::Approx(1));
         CHECK_FALSE(b.raised(event("touch.calibrated")));  // not before it is kept
         b.pass(2);
         CHECK(b.raised(event("touch.calibrated")));
         refused(b, R"({"touch.calibrate": {"x1": 1, "y1": 1, "x2": 2, "y2": 2, "x3": 3, "y3": 3}})",
                 "lie in one line");
     }},
    {"touch.reset",
     [](Bench& b) {
         b.run(R"([{"set": {"setup.touch_xx": 3}}, "touch.reset"])");
         CHECK(b.number("setup.touch_xx") == 1);
     }},
    {"buzzer.touch",
     [](Bench& b) {
         b.run(R"("buzzer.touch")");
         CHECK(b.number("buzzer.sounding") == 1);
         CHECK(b.number("buzzer.last_ms") == b.number("setup.buzzer_touch_ms"));
         b.pass(1);
         CHECK(b.number("buzzer.sounding") == 0);
     }},
    {"board.doze",
     [](Bench& b) {
         b.run(R"("board.doze")");
         CHECK(b.number("board.dozing") == 1);
         CHECK(b.number("panel.powered") == 0);
         CHECK(b.number("files.stick") == 0);
     }},
    {"board.wake",
     [](Bench& b) {
         b.run(R"(["board.doze", "board.wake"])");
         CHECK(b.number("board.dozing") == 0);
         CHECK(b.number("files.count") == 3);
     }},
    {"counters.reset",
     [](Bench& b) {
         b.run(R"([{"set": {"counters.led_s": 500, "counters.print_s": 7}}, "counters.reset"])");
         CHECK(b.number("counters.led_s") == 0);
         CHECK(b.number("counters.print_s") == 0);
     }},
};

}  // namespace

const std::vector<ActionRow>& dlp_action_rows() {
    static const std::vector<ActionRow> rows = [] {
        std::vector<ActionRow> all;
        for (const auto* part : {&print_rows, &platform_rows, &file_rows, &board_rows}) {
            all.insert(all.end(), part->begin(), part->end());
        }
        return all;
    }();
    return rows;
}

}  // namespace fauxboard::testing
