// The BIGTREETECH TFT against a partner who answers from a script: its start, its queue, and every input that
// it ignores, gets out of step by, stalls, jams or dies of.

#include <doctest/doctest.h>

#include <map>
#include <string>

#include "tests/screen/harness.h"
#include "tests/screen/partner.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using screen::Verdict;

namespace {

constexpr std::string_view temperatures = "T:22.00 /0.00 B:21.50 /0.00 @:0 B@:0";

/// What a good board answers.
std::string good(std::string_view command) {
    static const std::map<std::string, std::string, std::less<>> answers{
        {"M105", "ok " + std::string(temperatures) + "\n"},
        {"M503", "echo:  M92 X80.00 Y80.00 Z400.00 E500.00\nok\n"},
        {"M503 S0", "  M92 X80.00 Y80.00 Z400.00 E500.00\n  M420 S1 Z10.00 ; Leveling ON\nok\n"},
        {"M92", "  M92 X80.00 Y80.00 Z400.00 E93.00\nok\n"},
        {"M211", "  M211 S1 ; ON\n  Min:  X0.00 Y0.00 Z0.00   Max:  X200.00 Y200.00 Z200.00\nok\n"},
        {"M115",
         "FIRMWARE_NAME:Marlin 2.1 (of today) SOURCE_CODE_URL:x PROTOCOL_VERSION:1.0 MACHINE_TYPE:3D Printer "
         "EXTRUDER_COUNT:1 UUID:0\nCap:EEPROM:1\nCap:AUTOREPORT_TEMP:1\nCap:AUTOLEVEL:1\nCap:Z_PROBE:1\n"
         "Cap:PROMPT_SUPPORT:1\nCap:SDCARD:1\nCap:LONG_FILENAME:1\nok\n"},
        {"M220", "FR:100%\nok\n"},
        {"M221", "echo:E0 Flow: 100%\nok\n"},
        {"M114", "X:1.00 Y:2.00 Z:3.00 E:4.00 Count X:80 Y:160 Z:1200\nok\n"},
        {"M21", "echo:SD card ok\nok\n"},
        {"M20 L",
         "Begin file list\nCUBE~1.GCO 1234 cube of mine.gcode\nVASE.GCO 99 vase.gcode\nEnd file "
         "list\nok\n"},
        {"M33 /CUBE~1.GCO", "/cube of mine.gcode\nok\n"},
        {"M23 /CUBE~1.GCO",
         "echo:Now fresh file: CUBE~1.GCO\nFile opened: CUBE~1.GCO Size: 1234\nFile selected\nok\n"},
        {"M27", "SD printing byte 617/1234\r\nok\n"},
        {"M155 S3", "ok\n " + std::string(temperatures) + "\n"}};
    const auto hit = answers.find(command);
    return hit == answers.end() ? "ok\n" : hit->second;
}

/// A board that is good but for one command.
Partner::Answer but(std::string command, std::string answer) {
    return [=](std::string_view said) { return said == command ? answer : good(said); };
}

struct Started : Partner {
    explicit Started(Answer with = good) : Partner(shipped_screen("btt-tft"), std::move(with)) { pass(2.5); }
};

}  // namespace

TEST_CASE("btt-tft: the start, in the order of the running firmware") {
    Partner screen(shipped_screen("btt-tft"), good);
    screen.pass(1.4);
    CHECK(screen.commands() == "");
    screen.pass(0.5);
    CHECK(screen.commands() == "M105 | M503 | M92 | M211 | M115 | M503 S0 | G90 | M82 | M155 S3 | M220");
    screen.pass(2);
    CHECK(screen.commands() == "M114 | M220 | M221");
    CHECK(screen->get("firmware.name") == "Marlin 2.1 (of today)");
    CHECK(screen->number("steps.e") == 500);  // the last to come
    CHECK(screen->number("bed.current") == 21.5);
    CHECK(screen->number("position.z") == 3);
    CHECK(screen->counters().timeouts == 0);
    CHECK(screen.found(Verdict::runs_ahead) == "");
    CHECK(screen.found(Verdict::timed_out) == "");
}

TEST_CASE("btt-tft: a board that is off is asked each 3 s; a temperature without @ does not connect") {
    Partner screen(shipped_screen("btt-tft"), [](std::string_view) { return ""; });
    screen.pass(40);
    CHECK(screen.commands() == "M105 | M105 | M105");  // the next when the one before is given up after 15 s
    CHECK(screen->counters().timeouts == 2);
    CHECK(screen.found(Verdict::timed_out).find("ACK timed out, pending gcode released") !=
          std::string::npos);
    screen.answer = but("M105", "ok T:22.3 /0.0 B:22.0 /0.0\n");
    screen.pass(20);
    CHECK(screen->number("link.connected") == 0);
    CHECK(screen.found(Verdict::ignored).find("only with \"@\", \"T0:\" or \"T:0\"") != std::string::npos);
    screen.answer = but("M105", "ok T:22.3 /0.0 T0:22.3 /0.0\n");
    screen.pass(4);
    CHECK(screen->number("link.connected") == 1);
}

TEST_CASE("btt-tft: one command at a time, and the next only with the ok") {
    Started screen;
    screen.commands();
    screen.answer = [](std::string_view) { return ""; };
    screen.press("Home/Home all");
    CHECK(screen.commands() == "G28");
    screen.press("Home X");
    screen.pass(1);
    CHECK(screen.commands() == "");
    screen.answer = good;
    screen.say("ok\n");
    CHECK(screen.commands() == "G28 X");
    CHECK(screen->counters().timeouts == 0);
}

TEST_CASE("btt-tft: any line keeps it waiting, silence of 15 s does not") {
    Started screen;
    screen.answer = [](std::string_view) { return ""; };
    screen.press("Home/Home all");
    for (int i = 0; i < 10; ++i) {
        screen.pass(10);
        screen.say("echo:busy: processing\n");
    }
    CHECK(screen->counters().timeouts == 0);
    screen.pass(15.1);
    CHECK(screen->counters().timeouts == 1);
    CHECK(screen.found(Verdict::timed_out)
              .starts_with("G28: timed out: no line in 15 s after it: ACK timed out"));
}

TEST_CASE("btt-tft: two ok for one command") {
    Started screen(but("M92", "ok\nok\n"));
    CHECK(screen.found(Verdict::runs_ahead)
              .starts_with(
                  "ok: runs ahead: two acknowledgements for one command (\"M92\"): this one is taken for "
                  "that of \"M211\", which had not left when it came; from here on the screen runs one "
                  "command ahead"));
    CHECK(screen->counters().timeouts == 0);
    SUBCASE("also when the second comes later, as soon as it can be told") {
        Started late;
        late.pass(1);
        late.answer = but("M84", "ok\n");
        late.press("Move/Motors off");
        late.pass(0.2);
        late.say("ok\n");
        CHECK(late.found(Verdict::runs_ahead).find("one acknowledgement more than there were commands") !=
              std::string::npos);
    }
    SUBCASE("temperatures, and the ok on a line of its own") {
        Started apart(but("M105", std::string(temperatures) + "\nok\n"));
        CHECK(apart.found(Verdict::runs_ahead).find("this one is taken for that of \"M503\"") !=
              std::string::npos);
    }
    SUBCASE("the ok of what overtakes is no ok too many") {
        Started stop;
        stop.say("File opened: HOST.GCO Size: 5\n");
        stop.press("Printing/Stop?/Yes");
        stop.pass(3);
        CHECK(stop.found(Verdict::runs_ahead) == "");
    }
}

TEST_CASE("btt-tft: M21, M20 and M33 without their answer leave the touch dead") {
    const auto dead = [](Partner& screen) { return screen.press("Return"); };
    SUBCASE("M21") {
        Started screen(but("M21", "ok\n"));
        screen.press("Print");
        CHECK(screen.found(Verdict::stalls)
                  .starts_with(
                      "ok: stalls: \"M21\" is acknowledged without its answer: \"Loading...\" stays and "
                      "the touch is dead, for ever; a line with External Reset frees it"));
        screen.pass(120);
        CHECK(dead(screen).starts_with("the screen waits for the answer to M21 and does not react"));
        screen.answer = good;
        screen.say("start\n External Reset\n");
        screen.pass(1);
        CHECK(screen->page().path == "Main");
        CHECK(screen.press("Heat") == "");
    }
    SUBCASE("M20") {
        Started screen(but("M20 L", "ok\n"));
        screen.press("Print");
        CHECK(screen.found(Verdict::stalls).find("\"M20 L\" is acknowledged without its answer") !=
              std::string::npos);
        CHECK_FALSE(dead(screen).empty());
    }
    SUBCASE("M33 answered ???") {
        Started screen(but("M33 /CUBE~1.GCO", "???\nok\n"));
        screen.press("Print");
        screen.press("File 1");
        screen.press("Long name");
        CHECK(screen.found(Verdict::stalls).find("\"M33 /CUBE~1.GCO\" is acknowledged") != std::string::npos);
        CHECK_FALSE(dead(screen).empty());
    }
    SUBCASE("an error is an answer") {
        Started screen(but("M21", "echo:No SD card\nok\n"));
        screen.press("Print");
        CHECK(screen.found(Verdict::stalls) == "");
        CHECK(screen->page().path == "Notice");
        CHECK(screen.press("OK") == "");
    }
    SUBCASE("nothing is wrong") {
        Started screen;
        screen.press("Print");
        CHECK(screen->get("card.files") == "CUBE~1.GCO\nVASE.GCO\n");
        screen.press("File 1");
        screen.press("Long name");
        CHECK(screen->get("job.long_name") == "/cube of mine.gcode");
        screen.commands();
        CHECK(screen.press("Start") == "");
        screen.pass(3.5);
        CHECK(screen.commands() == "M23 /CUBE~1.GCO | M24 | M27");
        CHECK(screen->number("job.byte") == 617);
        CHECK(screen.found(Verdict::stalls) == "");
    }
}

TEST_CASE("btt-tft: a report between M33 and its answer is taken for the name") {
    Started screen(but("M33 /CUBE~1.GCO", " " + std::string(temperatures) + "\n/cube.gcode\nok\n"));
    screen.press("Print");
    screen.press("File 1");
    screen.press("Long name");
    CHECK(screen.found(Verdict::misread).find("is taken for the name of the file") != std::string::npos);
    CHECK(screen->get("job.long_name") == temperatures);
}

TEST_CASE("btt-tft: a line of 512 bytes jams it, one of 511 is passed over") {
    Started screen;
    screen.say(std::string(511, 'x') + "\n");
    CHECK(screen.found(Verdict::jams) == "");
    CHECK(screen.found(Verdict::ignored).find("this screen looks for nothing in it") != std::string::npos);
    screen.say("echo:" + std::string(507, 'x') + "\n");
    CHECK(screen.found(Verdict::jams).find("a line of 512 bytes or more: the screen never reads again") !=
          std::string::npos);
    screen.commands();
    screen.pass(31);
    // It gives up after 15 s each time, and releases one more command.
    CHECK(screen.commands() == "M114 | M220 | M221");
    CHECK(screen->counters().timeouts == 2);
}

TEST_CASE("btt-tft: a long word in a pop-up") {
    const auto say = [](std::size_t bytes, const std::string& start, bool on_status) {
        Started screen;
        if (!on_status) {
            screen.press("Fan");
        }
        screen.say(start + std::string(bytes, 'x') + "\n");
        return screen->counters().crashes != 0                    ? "crash"
               : !screen.found(Verdict::misread).empty()          ? "overrun"
               : screen->page().path == "Notice"                  ? "shown"
               : !screen->get("status.text").value_or("").empty() ? "written"
                                                                  : "nothing";
    };
    CHECK(say(99, "Error:", true) == std::string("shown"));
    CHECK(say(100, "Error:", true) == std::string("overrun"));
    CHECK(say(119, "Error:", false) == std::string("overrun"));
    CHECK(say(120, "Error:", true) == std::string("crash"));
    CHECK(say(99, "echo:", false) == std::string("shown"));
    CHECK(say(120, "echo:", false) == std::string("crash"));
    CHECK(say(200, "echo:", true) == std::string("written"));
}

TEST_CASE("btt-tft: a list of more than 5000 bytes shows no file") {
    const auto listed = [](int files) {
        std::string answer = "Begin file list\n";
        for (int i = 0; i < files; ++i) {
            answer += "PART~" + std::to_string(100 + i) + ".GCO 12345 a part with a long name " +
                      std::to_string(100 + i) + ".gcode\n";
        }
        Started screen(but("M20 L", answer + "End file list\nok\n"));
        screen.press("Print");
        screen.pass(1);
        return std::pair(screen->page().path, screen.found(Verdict::rest_dropped));
    };
    CHECK(listed(80).first == "Print");
    const auto [page, why] = listed(110);
    CHECK(page == "Notice");
    CHECK(why.find("a list of more than 5000 bytes") != std::string::npos);
}

TEST_CASE("btt-tft: prompts, two buttons and no more") {
    Started screen;
    const auto prompt = [&](const std::string& buttons) {
        screen.say("//action:prompt_end\n//action:prompt_begin Nozzle Parked\n" + buttons +
                   "//action:prompt_show\n");
        return screen->page().path;
    };
    CHECK(prompt("//action:prompt_button Yes\n//action:prompt_button No\n//action:prompt_button Maybe\n") ==
          "Main");
    CHECK(screen.found(Verdict::part_missed).find("a third button: the screen has two") != std::string::npos);
    CHECK(screen.found(Verdict::ignored).find("a prompt of more than two buttons is not shown") !=
          std::string::npos);
    CHECK(prompt("//action:prompt_button A very long button indeed\n//action:prompt_button No\n") ==
          "Prompt");
    CHECK(screen.found(Verdict::cut).find("there is room for 20") != std::string::npos);
    screen.commands();
    CHECK(screen.press("Second") == "");
    CHECK(screen.commands() == "M876 S1");
    CHECK(screen->page().path == "Main");
    prompt("");
    CHECK(screen->page().path == "Prompt");
    screen.say("//action:prompt_end\n");
    CHECK(screen->page().path == "Main");
}

TEST_CASE("btt-tft: a host's print shows, with M27 or without") {
    Started screen;
    screen.commands();
    screen.say("File opened: HOST.GCO Size: 777\n");
    CHECK(screen->page().path == "Printing");
    screen.pass(4);
    CHECK(screen.commands().find("M27") != std::string::npos);
    screen.say("Done printing file\n");
    CHECK(screen->number("job.status") == 0);
    screen.press("Close");
    screen.say("//action:print_start\n");
    CHECK(screen->page().path == "Printing");
    screen.commands();
    screen.pass(4);
    CHECK(screen.commands().find("M27") == std::string::npos);
}

TEST_CASE("btt-tft: a restart of the board, and a line that only looks like one") {
    Started screen;
    screen.commands();
    screen.say("echo:External Reset\n");
    screen.pass(0.5);
    CHECK(screen.commands() == "");
    screen.say("start\n Watchdog Reset\n");
    screen.pass(0.5);
    CHECK(screen.commands().starts_with("M503 | M92 | M211 | M115 | M503 S0 | G90 | M82 | M155 S3 | M220"));
    screen.say("x\xFF garbage: Reset of something External\n");
    screen.pass(0.2);
    CHECK(screen.commands().starts_with("M503 | M92"));
}

TEST_CASE("btt-tft: what is not said as it looks for it") {
    struct Row {
        std::string line;
        Verdict verdict;
        std::string why;
    };
    const Row rows[] = {
        {"ok X:1.00 Y:2.00 Z:3.00 E:4.00\n", Verdict::part_missed,
         "only from a line that starts with \"X:\""},
        {"echo:  M92 X1.00 Y1.00 Z1.00 E1.00\n", Verdict::ignored,
         "what M503 says behind \"echo:\" is not read"},
        {"ok Feedrate: 120\n", Verdict::ignored, "a speed is looked for behind \"FR:\" only"},
        {"//action:prompt_choice A\n", Verdict::ignored, "does not know that action"},
        {"wait\n", Verdict::ignored, "this screen looks for nothing in it"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.line);
        Started screen;
        screen.answer = [](std::string_view) { return ""; };
        screen.press("Home/Home all");
        screen.say(row.line);
        CHECK(screen.found(row.verdict).find(row.why) != std::string::npos);
    }
    Started without(but("M115", "Cap:AUTOREPORT_TEMP:1\nCap:EEPROM:1\nok\n"));
    CHECK(without.found(Verdict::part_missed).find("no FIRMWARE_NAME line before it") != std::string::npos);
    CHECK(without.commands().find("M503 S0") == std::string::npos);
    Started burst;
    burst->receive(burst->time(), std::string(4200, '\n'));
    burst.pass(0.1);
    CHECK(burst.found(Verdict::rest_dropped).find("more than 4096 bytes came without a pause") !=
          std::string::npos);
}

TEST_CASE("btt-tft: reports that do not come are asked for again") {
    Started screen(but("M155 S3", "ok\n"));
    screen.commands();
    screen.pass(13);
    const std::string all = screen.commands();
    CHECK(all.find("M155 S3") != std::string::npos);
    CHECK(all.find("M105") == std::string::npos);
}
