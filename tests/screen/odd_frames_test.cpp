// Odd lines, each judged as the A30 screen's firmware takes it. The first group was shown to the running
// firmware; the second follows from its parser's rules: where keys are searched, which numbers C reads, what
// limits do.

#include <doctest/doctest.h>

#include "protocol/framing.h"
#include "tests/screen/harness.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using screen::Verdict;

namespace {

struct Odd {
    std::string line;
    Verdict verdict;
    std::string why;
    std::string value;  ///< looked at afterwards; empty: the page that is open
    std::string is;
};

const std::string x39(39, 'x');
const std::string x40(40, 'x');
const std::string l2 = "L2 B:20.5 /60.0 /1 T0:190.5 /200.0 /1 SD:1 F0:50 F2:60 R:110 FR:30";
const std::string l3 = "L3 PS:1 VL:0 MT:1 FT:1 AL:0 ST:1 WF:0 FN:a.gcode PG:7 TM:8 LA:9 LC:10";

/// `text` with its first `what` replaced.
std::string with(std::string text, std::string_view what, std::string_view by) {
    return text.replace(text.find(what), what.size(), by);
}
/// As a board that frames would send it, without the line end.
std::string framed(std::string_view body) {
    std::string line = protocol::frame(body);
    line.resize(line.size() - 2);
    return line;
}

/// What the screen knows before each line.
const std::vector<std::string> before{
    "L2 B:1.0 /2.0 /0 T0:3.0 /4.0 /0 SD:0 F0:5 F2:6 R:7 FR:8",
    "L3 PS:0 VL:0 MT:0 FT:0 AL:1 ST:0 WF:0 FN:old.gcode PG:1 TM:2 LA:3 LC:4",
    "L9 DN:was;DM:was;SN:was;FV:was;PV:was;HV:was;",
    "L4 WT:0 CF:0 AP:0 SS:0 RS:0 RE:0 RI:was: RA:was: SA:was:", "L14 was"};

void check(const std::vector<Odd>& rows) {
    for (const Odd& row : rows) {
        CAPTURE(row.line);
        Bench bench("geeetech-a30");
        for (const std::string& line : before) {
            bench.say_raw(line);
        }
        const screen::Judgement judgement = bench.say_raw(row.line);
        CHECK(screen::verdict_words(judgement.verdict) == screen::verdict_words(row.verdict));
        CHECK(judgement.why == row.why);
        CHECK((row.value.empty() ? bench->page().path : bench->get(row.value).value_or("no such value")) ==
              row.is);
    }
}

constexpr auto part_missed = Verdict::part_missed;
constexpr auto dropped = Verdict::rest_dropped;
constexpr auto misread = Verdict::misread;
constexpr auto ignored = Verdict::ignored;
constexpr auto ok = Verdict::ok;
const std::string no_bed = "without \"B:\" \"T0:\" is not looked for";
const std::string no_pg = "no \" PG:\" behind \"FN:\": the search runs off the line";
const std::string too_long_message = "a text of 40 characters behind \"\", there is room for 39";

}  // namespace

TEST_CASE("odd lines as the A30 screen's firmware took them") {
    check({{"L2 T0:55 /60/1 SD:1 R:105", part_missed, no_bed, "card.status", "0"},
           {"L2 T0:55 /60/1 SD:1 R:105", part_missed, no_bed, "speed.percent", "7"},
           {with(l3, "PG:7", "PG:-1"), misread, "\"PG:\" -1 is taken as 255", "job.progress", "255"},
           {with(l3, "PG:7", "PG:-1"), misread, "\"PG:\" -1 is taken as 255", "job.layers", "10"},
           {"L9 DN:" + x40 + ";DM:q;", dropped,
            "a text of 40 characters behind \"DN:\", there is room for 39", "device.name", "was"},
           {"L9 DN:" + x40 + ";DM:q;", dropped,
            "a text of 40 characters behind \"DN:\", there is room for 39", "device.model", "was"},
           {"L4 WT:1 CF:1 AP:0 SS:1 RS:3 RE:1 RI:1: RA:" + x40 + ": SA:2:", dropped,
            "a text of 40 characters behind \"RA:\", there is room for 39", "wifi.ssid", "was"},
           {"L14 " + x40, dropped, too_long_message, "message", "was"},
           {"L14 ", dropped, "an empty text", "message", "was"},
           {"L16 P1 S0", Verdict::restarts, "the screen starts anew", "message", ""},
           {"L16 P0 300", misread, "\"P0\" 300 is taken as 44", "resume.code", "44"},
           {"L16 P0 15", ok, "", "", "Main"},
           {with(l3, "PS:1", "PS:4"), ok, "", "", "Main"},
           {framed("L7 P0 cube.gcode"), misread, "the frame's checksum becomes part of the name", "files",
            ""}});
    Bench bench("geeetech-a30");
    bench.say_raw(with(l3, "PS:1", "PS:4"));
    CHECK(bench->show("Bar chart button").find("PC Printing...   a.gcode") != std::string::npos);
}

TEST_CASE("lists: shown when their end has come, and none of 64 entries; a burst over the ring") {
    const auto list = [](int count, const std::string& name) {
        std::string out = "L7 begin file list:0\r\n";
        for (int i = 0; i < count; ++i)
            out += "L7 P" + std::to_string(i) + " " + name + std::to_string(i) + ".gcode\r\n";
        return out + "L7 end file list:0\r\n";
    };
    const auto shown = [](const std::string& bytes, bool paced) {
        Bench bench("geeetech-a30");
        for (std::size_t at = 0; at < bytes.size();) {
            const std::size_t end = paced ? bytes.find('\n', at) + 1 : bytes.size();
            bench->receive(bench.now(), bytes.substr(at, end - at));
            bench.pass(paced ? 0.05 : 1);
            at = end;
        }
        return std::pair(bench->get("files")->size(), bench->counters().bytes_lost);
    };
    CHECK(shown(list(63, "f"), true).first > 0);
    CHECK(shown(list(64, "f"), true).first == 0);
    // 42 entries end a little behind the ring's last byte: nothing is shown. Of 50 some are lost, the end
    // comes.
    const auto whole = shown(list(30, "some-file-of-mine"), false);
    CHECK(whole.first > 0);
    CHECK(whole.second == 0);
    const auto end_lost = shown(list(42, "a-file-of-mine-"), false);
    CHECK(end_lost.first == 0);
    CHECK(end_lost.second > 0);
    const auto some_lost = shown(list(50, "some-file-of-mine"), false);
    CHECK(some_lost.first > 0);
    CHECK(some_lost.second > 0);
}

TEST_CASE("odd lines by the parser's rules: the line layer") {
    check({{"L1 X1 Y2 Z3 F4*99", ok, "", "motion.feed", "4"},
           {"l1 X1 Y2 Z3 F4", ignored, "no L in the first 8 characters", "position.x", "0"},
           {"echo:SD card ok", ignored, "no L in the first 8 characters", "", "Main"},
           {"HELLO", ignored, "this screen knows no L0", "", "Main"},
           {"N-0 N-0 L1 X1 Y2 Z3 F4", ignored, "no L in the first 8 characters", "position.x", "0"},
           {"L-255 X6 Y0 Z0 F0", misread, "L-255 is taken as L1", "position.x", "6"},
           {"L+1 X6 Y0 Z0 F0", ok, "", "position.x", "6"},
           {"L01 X6 Y0 Z0 F0", ok, "", "position.x", "6"},
           {"L1.5 X6 Y0 Z0 F0", ok, "", "position.x", "6"},
           {"L277 P0 S0", misread, "L277 is taken as L21", "", "Main"}});
}

TEST_CASE("odd lines by the parser's rules: positions and temperatures") {
    check({{"L1 Z3 Y2 X1 F4", part_missed,
            "\"Y\" is looked for behind what was read before, and is not there", "position.x", "1"},
           {"L1 X1e3 Y2 Z3 F4", ok, "", "position.x", "1000"},
           {"L1 X1,5 Y2 Z3 F4", ok, "", "position.x", "1"},
           {"L1 X-0.000 Y2 Z3 F-1", misread, "\"F\" -1 is taken as 65535", "motion.feed", "65535"},
           {with(l2, "60.0", "120.0"), ok, "", "bed.target", "120"},
           {with(l2, "60.0", "120.1"), dropped, "a bed target beyond 0..120", "bed.current", "20.5"},
           {with(l2, "60.0", "nan"), ok, "", "bed.target", "nan"},
           {with(l2, "200.0", "-0.5"), dropped, "a nozzle target beyond 0..250", "nozzle.current", "190.5"},
           {with(l2, "200.0", "-0.5"), dropped, "a nozzle target beyond 0..250", "speed.percent", "7"},
           {with(l2, "R:110", "R:65636"), misread, "\"R:\" 65636 is taken as 100", "speed.percent", "100"},
           {with(l2, "SD:1", "SD:17"), ok, "", "card.status", "17"},
           {with(l2, " R:110", ""), part_missed,
            "\"FR:\" is looked for behind what was read before, and is not there", "speed.percent", "30"},
           {with(l2, "T0:190.5", "T1:190.5"), ok, "", "nozzle.current", "3"}});
}

TEST_CASE("odd lines by the parser's rules: the status of the print") {
    check({{with(l3, "PG:7", "PG:100"), ok, "", "job.progress", "100"},
           {with(l3, "PG:7", "PG:356"), dropped, "a progress beyond 100", "job.seconds", "2"},
           {with(l3, "PG:7", "PG:"), misread, "\"PG:\" without a number behind it is taken as 0",
            "job.progress", "0"},
           {with(l3, "PS:1", "PS:257"), misread, "\"PS:\" 257 is taken as 1", "job.status", "1"},
           {with(l3, " FN:a.gcode PG:7", ""), part_missed, "without \"FN:\" \"TM:\" is not looked for",
            "job.layers", "4"},
           {with(l3, "FN:a.gcode", "FN:my PG: file.gcode"), misread,
            "\"PG:\" without a number behind it is taken as 0", "job.file", "my"},
           {with(l3, " PG:7", ""), Verdict::would_crash, no_pg, "job.status", "0"},
           {with(l3, "FN:a.gcode PG", "FN:PG"), Verdict::would_crash, no_pg, "job.status", "0"},
           {with(l3, "FN:a.gcode", "FN:"), ok, "", "job.file", ""},
           {with(l3, "LC:10", "LC:-10"), ok, "", "job.layers", "-10"},
           {with(l3, "VL:0", "XX:0"), ok, "", "motors.on", "1"}});
}

TEST_CASE("odd lines by the parser's rules: texts, lists, pages") {
    check({{"L9 DN:" + x39 + ";DM:q;SN:1;FV:2;PV:3;HV:4;", ok, "", "device.name", x39},
           {"L9 DM:q;", ok, "", "device.model", "q"},
           {"L9 HV:a;DN:b;", ok, "", "device.hardware", "a"},
           {"L14 " + x39, ok, "", "message", x39},
           {"L14", dropped, "an empty text", "message", "was"},
           {framed("L14 hello"), misread, "the frame's checksum becomes part of the text", "message",
            framed("L14 hello").substr(4)},
           {framed("L14 " + x39), dropped,
            "a text of " + std::to_string(framed("L14 " + x39).size() - 4) +
                " characters behind \"\", there is room for 39",
            "message", "was"},
           {"L7 P63 last.gcode", ok, "", "files", ""},
           {"L7 P64 late.gcode", dropped, "entry 64: the list holds 64", "files", ""},
           {"L7 P-1 early.gcode", dropped, "entry -1: the list holds 64", "files", ""},
           {"L7 end file list:2", misread, "\"end file list:\" 2 is out of bounds and taken as 0",
            "files.disk", "0"},
           {"L11 P1 S2.5", ignored, "L11 is taken only with \"P0\"", "probe.offset", "0"},
           {"L16 P0 S15", misread, "\"P0\" without a number behind it is taken as 0", "resume.code", "0"},
           {"L18 P26 S0", ok, "", "", "Exception"},
           {"L18 P3 S0", ignored, "L18 is taken only with \"P26\"", "", "Main"},
           {"L18 P26 S-242", misread, "\"S\" -242 is taken as 14", "", "Exception"},
           {"L18 P26 S271", Verdict::would_crash,
            "\"S\" 271 is taken as 15; the page table ends at 14, and the screen reads past it", "", "Main"},
           {"L18 S3 P26", part_missed, "\"S\" is looked for behind what was read before, and is not there",
            "", "Exception"},
           {"L21 S0 P0", ok, "", "", "Main"},
           {"L21 P1 S0", ignored, "L21 is taken only with \"P0\" with \"S0\"", "", "Main"}});
}
