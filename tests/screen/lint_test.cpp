// Each row of the table of what the A30 screen's firmware reads: how it takes lines, right and wrong.

#include <doctest/doctest.h>

#include <algorithm>

#include "emulator/screen/tour_report.h"
#include "tests/screen/harness.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using screen::Verdict;

namespace {

struct Row {
    std::string_view line;  ///< as it stands, without frame
    Verdict verdict;
    std::string_view why;
    std::string_view value;  ///< one value afterwards
    std::string_view is;
};

void check(std::string_view profile, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        CAPTURE(row.line);
        Bench bench(profile);
        const screen::Judgement judgement =
            profile == "geeetech-a30" ? bench.say_raw(row.line) : bench.say(row.line);
        CHECK(screen::verdict_words(judgement.verdict) == screen::verdict_words(row.verdict));
        CHECK(judgement.why == row.why);
        if (!row.value.empty()) {
            CHECK(bench->get(row.value).value_or("no such value") == row.is);
        }
    }
}

const std::string name49(49, 'n');
const std::string name50(50, 'n');
const std::string l3_49 = "L3 PS:1 FN:" + name49 + " PG:7 TM:1 LA:2 LC:3";
const std::string l3_50 = "L3 PS:1 FN:" + name50 + " PG:7 TM:1 LA:2 LC:3";

}  // namespace

TEST_CASE("the line layer of the A30's screen") {
    check("geeetech-a30",
          {{"L1 X1 Y2 Z3 F4", Verdict::ok, "", "position.x", "1"},
           {"N-0 L1 X1 Y2 Z3 F4*999", Verdict::ok, "", "motion.feed", "4"},
           {"1234567L1 X5 Y2 Z3 F4", Verdict::ok, "", "position.x", "5"},
           {"12345678L1 X5", Verdict::ignored, "no L in the first 8 characters", "position.x", "0"},
           {"SD printing byte 0/0", Verdict::ignored, "no L in the first 8 characters", "", ""},
           {"M2107 ok", Verdict::ignored, "no L in the first 8 characters", "", ""},
           {"L  1 X6 Y0 Z0 F0", Verdict::ok, "", "position.x", "6"},
           {"L257 X7 Y0 Z0 F0", Verdict::misread, "L257 is taken as L1", "position.x", "7"},
           {"L22 MS:0 MR:100", Verdict::ignored, "this screen knows no L22", "", ""},
           {"L13 Disk select success", Verdict::ignored, "this screen knows no L13", "", ""},
           {"L X9", Verdict::ignored, "this screen knows no L0", "position.x", "0"}});
}

TEST_CASE("L1 and L2: the order of the keys, bounds, number readers") {
    check("geeetech-a30",
          {{"L1 Y2 Z3 F4", Verdict::part_missed, "without \"X\" \"Y\" is not looked for", "position.y", "0"},
           {"L1 Z3 X1 Y2 F4", Verdict::part_missed,
            "\"Z\" is looked for behind what was read before, and is not there; without \"Z\" \"F\" is not "
            "looked for",
            "position.z", "0"},
           {"L1 X0x10 Y-1e2 Z+.5 F3", Verdict::ok, "", "position.x", "16"},
           {"L1 Xinf Y-nan Z1 F70000", Verdict::misread, "\"F\" 70000 is taken as 4464", "position.x", "inf"},
           {"L1 X Y2 Z3 F4", Verdict::misread, "\"X\" without a number behind it is taken as 0", "position.y",
            "2"},
           {"L2 B:20.5 /60.0 /1 T0:190.5 /200.0 /1 SD:0 F0:50 F2:60 R:110 FR:30", Verdict::ok, "",
            "nozzle.target", "200"},
           {"L2 B:20.5 /60.0 /1 T0:190.5 /200.0 /1 T1:9 /8 /7 SD:1 F0:50 F2:60 R:110 FR:30", Verdict::ok, "",
            "card.status", "1"},
           {"L2 T0:190.5 /200.0 /1 SD:1 R:90", Verdict::part_missed,
            "without \"B:\" \"T0:\" is not looked for", "nozzle.current", "0"},
           {"L2 T0:190.5 /200.0 /1 SD:1 R:90", Verdict::part_missed,
            "without \"B:\" \"T0:\" is not looked for", "speed.percent", "0"},
           {"L2 B:20.5 /121.0 /1 T0:190.5 /200.0 /1 SD:1", Verdict::rest_dropped,
            "a bed target beyond 0..120", "nozzle.current", "0"},
           {"L2 B:20.5 /-1 /1 T0:190.5 /200.0 /1 SD:1", Verdict::rest_dropped, "a bed target beyond 0..120",
            "bed.target", "0"},
           {"L2 B:20.5 /60.0 /1 T0:190.5 /250.1 /1 SD:1", Verdict::rest_dropped,
            "a nozzle target beyond 0..250", "card.status", "0"},
           {"L2 B:1 /1 /1 T0:1 /1 /1 SD:0 F0:300", Verdict::misread, "\"F0:\" 300 is taken as 44", "fan.part",
            "44"}});
}

TEST_CASE("L3: missing and unknown keys, names, progress, the crash") {
    check("geeetech-a30",
          {{"L3 PS:0 VL:0 MT:1 FT:0 AL:1 ST:1 WF:0 MR:100 FN: PG:0 TM:0 LA:0 LC:0", Verdict::ok, "",
            "motors.on", "1"},
           {"L3 MT:1 FN:abc PG:12 TM:5 LA:1 LC:9", Verdict::ok, "", "job.file", "abc"},
           {"L3 MT:1 PS:2 FN: PG:0 TM:0 LA:0 LC:0", Verdict::part_missed,
            "\"MT:\" is looked for behind what was read before, and is not there", "motors.on", "0"},
           {"L3 PS:2 MT:1 VL:1 FN: PG:0 TM:0 LA:0 LC:0", Verdict::part_missed,
            "\"MT:\" is looked for behind what was read before, and is not there", "job.volume", "1"},
           {"L3 PS:1 MT:1 PG:50 TM:9", Verdict::part_missed, "without \"FN:\" \"PG:\" is not looked for",
            "job.progress", "0"},
           {l3_49, Verdict::ok, "", "job.file", name49},
           {l3_50, Verdict::rest_dropped, "a text of 50 characters behind \"FN:\", there is room for 49",
            "job.progress", "0"},
           {"L3 PS:1 FN:a PG:101 TM:7", Verdict::rest_dropped, "a progress beyond 100", "job.seconds", "0"},
           {"L3 PS:0 FN:a TM:0", Verdict::would_crash,
            "no \" PG:\" behind \"FN:\": the search runs off the line", "", ""},
           {"L3 PS:0 FN:PG:0 TM:0", Verdict::would_crash,
            "no \" PG:\" behind \"FN:\": the search runs off the line", "", ""}});
}

TEST_CASE("L4 to L11: WiFi, the two bugs, the file list, about") {
    const std::string long_ip(40, '1');
    check("geeetech-a30",
          {{"L4 WT:1 CF:1 AP:0 SS:1 RS:3 RE:1 RI:10.0.0.1: RA:net: SA:10.0.0.2:", Verdict::ok, "",
            "wifi.ssid", "net"},
           {"L5 S120", Verdict::misread, "the screen stores garbage as the speed", "speed.percent", "0"},
           {"L6 P0 S50", Verdict::misread, "the screen writes the speed into the switch of fan 0", "fan.part",
            "0"},
           {"L7 begin file list:7", Verdict::misread,
            "\"begin file list:\" 7 is out of bounds and taken as 0", "files.disk", "0"},
           {"L7 P2 x.gcode*12", Verdict::ok, "", "files", ""},
           {"L7 P64 x.gcode", Verdict::rest_dropped, "entry 64: the list holds 64", "files", ""},
           {"L7 nothing", Verdict::ignored,
            "L7 is taken only with \"begin file list:\", or \"end file list:\", or \"P\"", "", ""},
           {"L9 FV:V1;DN:Name;DM:M;SN:1;PV:2;HV:3;", Verdict::ok, "", "device.firmware", "V1"},
           {"L9 DN:Name;DM:M;SN:1", Verdict::rest_dropped, "no \";\" behind \"SN:\"", "device.model", "M"},
           {"L10 S8.50", Verdict::ok, "", "leveling.z", "8.5"},
           {"L11 P0 S-2.67", Verdict::ok, "", "probe.offset", "-2.67"},
           {"L11 S-2.67", Verdict::ignored, "L11 is taken only with \"P0\"", "probe.offset", "0"}});
    Bench bench("geeetech-a30");
    CHECK(bench.say_raw("L7 P0 " + name50).verdict == Verdict::cut);
    CHECK(bench.say_raw("L7 P2 x.gcode*12").verdict == Verdict::ok);
    CHECK(bench->get("files") == "");
    CHECK(bench.say_raw("L7 end file list:0").verdict == Verdict::ok);
    CHECK(bench->get("files") == name49 + "\n\nx.gcode*12\n");
    CHECK(bench.say_raw("L9 DN:" + long_ip + ";").verdict == Verdict::rest_dropped);
}

TEST_CASE("L14, L16, L18, L19, L21") {
    check(
        "geeetech-a30",
        {{"L14 hello there", Verdict::ok, "", "message", "hello there"},
         {"N-0 L14 hello*120", Verdict::misread, "the frame's checksum becomes part of the text", "message",
          "L14 hello*120"},
         {"L18 P26 S13", Verdict::ok, "", "exception.code", "13"},
         {"L18 P26 S14", Verdict::ok, "", "exception.code", "14"},
         {"L18 P26 S15", Verdict::would_crash, "the page table ends at 14, and the screen reads past it", "",
          ""},
         {"L18 P25 S1", Verdict::ignored, "L18 is taken only with \"P26\"", "exception.code", "0"},
         {"L19 P2 SM:1 TC:2 ED:0 DP:1 MS:16 MC:1000 HC:500", Verdict::ok, "", "stepper.max_current", "1000"},
         {"L16 P0 15", Verdict::ok, "", "resume.code", "15"}});
    Bench bench("geeetech-a30");
    CHECK(bench.say_raw("L18 P26 S1").sentence() == "L18 P26 S1: ok");
    CHECK(bench->page().path == "Exception");
    CHECK(bench->show().find("The file of the print is not there") != std::string::npos);
    CHECK(bench.press("OK") == "M105 | M27");
    CHECK(bench->page().path == "Bar chart button");
    CHECK(bench.say_raw("L16 P1 S0").sentence() == "L16 P1 S0: restarts: the screen starts anew");
    CHECK(bench->counters().restarts == 1);
    CHECK(bench->counters().crashes == 0);
}

TEST_CASE("the crashes: said in full, counted, and the screen starts anew") {
    Bench bench("geeetech-a30");
    bench.say_raw("L1 X9 Y8 Z7 F6");
    bench->receive(bench.now(), "N-0 L18 P26 S15*0\r\nL1 X1 Y1 Z1 F1\r\n");
    bench.pass(0.05);
    CHECK(bench->judgements().back().sentence() ==
          "N-0 L18 P26 S15*0: would crash: the page table ends at 14, and the screen reads past it");
    CHECK(bench->counters().crashes == 1);
    CHECK(bench->get("position.x") == "0");
    CHECK(bench.press("Control") == "the screen is not on yet");
    CHECK(bench.take() == "");
    bench.pass(1.2);
    CHECK(bench.take() == std::string("log A30 LCD OK\r\n") + '\0');
    CHECK(bench.say_raw("L3 PS:0 FN:no end").sentence() ==
          "L3 PS:0 FN:no end: would crash: no \" PG:\" behind \"FN:\": the search runs off the line");
    CHECK(screen::findings_text(bench->findings()) ==
          "1 x  N-0 L18 P26 S15*0: would crash: the page table ends at 14, and the screen reads past it\n"
          "1 x  L3 PS:0 FN:no end: would crash: no \" PG:\" behind \"FN:\": the search runs off the line\n");
}

TEST_CASE("the A30T's screen wants right frames, and knows what it knows") {
    Bench bench;
    CHECK(bench.say_raw("L1 X1 Y2 Z3 F4").why == "no checksum");
    CHECK(bench.say_raw("N-0 L1 X1 Y2 Z3 F4").why == "no checksum");
    CHECK(bench.say_raw("N-0 L21 P0 S0*62").why == "wrong checksum; expected 63");
    CHECK(bench.say_raw("N-0 L14 Pausing... please try again later.*").why == "no number behind the star");
    CHECK(bench.say("L18 P26 S15").verdict == Verdict::ok);
    CHECK(bench.say("L18 P26 S15").why == "");
    CHECK(bench->show().find("Waiting for you") != std::string::npos);
    CHECK(bench.press("Continue") == "M0");
    CHECK(bench.say("L22 MS:256 MR:25700 SP:100 EP:100 SH:0.50 EH:2.00").verdict == Verdict::ok);
    CHECK(bench->show("Bar chart button/Mixer Button")
              .find("Mode fixed ratio\nMix E0 100 %   E1 100 %   E2 0 %") != std::string::npos);
    CHECK(bench.say("L24 P4 A1").why ==
          "L24 is taken only with \"P0\", or \"P1\", or \"P2\", or \"P3\", or \"P5\", or \"P6\"");
}

TEST_CASE("long lines, full buffers, NULs") {
    Bench bench("geeetech-a30");
    const auto say_long = [&](const std::string& line) {
        bench->receive(bench.now(), line + "\r\n");
        bench.pass(0.2);
        return bench->judgements().back();
    };
    CHECK(say_long("L14 " + std::string(1274, 'x')).verdict == Verdict::rest_dropped);
    CHECK(bench->counters().bytes_lost == 1);  // the LF of a line that left room for its CR alone
    CHECK(say_long("L1 X2 Y2 Z3 F4").line == "L1 X2 Y2 Z3 F4");
    bench->receive(bench.now(), "L1 X1" + std::string(1274, ' ') + "\r\n");
    bench.pass(0.2);
    CHECK(bench->get("position.x") == "2");
    CHECK(bench->judgements()[bench->judgements().size() - 2].why == "a line of 1279 bytes or more is lost");
    CHECK(say_long("L1 X3 Y2 Z3 F4").sentence() == "L1 X3 Y2 Z3 F4: ok");
    CHECK(bench->counters().bytes_lost == 3);
    std::string burst;
    for (int i = 0; i < 200; ++i)
        burst += "L1 X1 Y2 Z3 F4\r\n";
    const std::uint64_t before = bench->counters().lines_received;
    bench->receive(bench.now(), burst);
    bench.pass(0.5);
    // Full after 111 ms; what comes until the next tick of 20 ms is lost, then there is room again.
    CHECK(bench->counters().bytes_lost > 3);
    CHECK(bench->counters().bytes_lost < 3 + 2 * 231);
    CHECK(bench->counters().lines_received - before < 200);
    CHECK(bench->counters().lines_received - before > 160);
    CHECK(std::any_of(bench->findings().begin(), bench->findings().end(), [](const auto& finding) {
        return finding.first.why == "more than 1279 bytes came without a pause; those behind are lost";
    }));
    bench.say_raw("");
    const std::string nul("L1 X5 Y2\0Z3 F4", 14);
    CHECK(bench.say_raw(nul).why == "a NUL ends the text");
    CHECK(bench->get("position.x") == "5");
    CHECK(bench->get("position.z") == "3");
    CHECK(screen::printable("a\x1b[2J\xff") == "a\\x1B[2Jÿ");
}
