#include <doctest/doctest.h>
#include <fmt/format.h>

#include <map>

#include "protocol/framing.h"
#include "tests/screen/harness.h"
#include "tests/support/vectors.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

/// How a button of the vectors is reached where its name there says more than its name here, and what the
/// screen must have shown before.
struct Way {
    std::vector<std::string> said;     ///< by the board
    std::vector<std::string> pressed;  ///< the last is the button itself
};

const std::map<std::string, Way, std::less<>>& ways() {
    static const std::map<std::string, Way, std::less<>> table{
        {"Control/Motion Param/Steps/mm/Rset", {{}, {"Steps/mm/Rset"}}},
        {"Control/Leveling/auto-level/Save (value was -0.50)", {{"L11 P0 S-0.50"}, {"auto-level/Save"}}},
        {"Control/Filament/Hotend up", {{}, {"Hotend on", "Hotend up"}}},
        {"Control/Filament/Hotend down", {{}, {"Hotend on", "Hotend down"}}},
        {"Control/Speed/Speed up (sent value = shown value)", {{}, {"Speed up"}}},
        {"Control/Speed/Fan up", {{"L2 B:0 /0 /0 T0:0 /0 /0 SD:0 F0:50 F2:0 R:0 FR:0"}, {"Fan up"}}},
        {"Control/Speed/Fan down", {{"L2 B:0 /0 /0 T0:0 /0 /0 SD:0 F0:50 F2:0 R:0 FR:0"}, {"Fan down"}}},
        {"Setting/Add-on/Backlight up",
         {{"L23 SE:0 BE:1 BP:50 CE:0 HE:0 SP:0 ST:16 HC:0 HO:0"}, {"Backlight up"}}},
        {"Setting/Add-on/Backlight down",
         {{"L23 SE:0 BE:1 BP:51 CE:0 HE:0 SP:0 ST:16 HC:0 HO:0"}, {"Backlight down"}}},
        {"Control/Leveling/auto-level/3D Touch - up 10.0mm",
         {{}, {"switch to 10.0mm", "3D Touch - up 10.0mm"}}},
        {"Control/Leveling/auto-level/3D Touch - down 10.0mm",
         {{}, {"switch to 10.0mm", "3D Touch - down 10.0mm"}}},
        {"Control/Leveling/auto-level/3D Touch - up 0.10mm",
         {{}, {"switch to 0.10mm", "3D Touch - up 0.10mm"}}},
        {"Control/Leveling/auto-level/3D Touch - down 0.10mm",
         {{}, {"switch to 0.10mm", "3D Touch - down 0.10mm"}}},
        {"Control/Leveling/auto-level/3D Touch - up 0.05mm",
         {{}, {"switch to 0.05mm", "3D Touch - up 0.05mm"}}},
        {"Control/Leveling/auto-level/3D Touch - down 0.05mm",
         {{}, {"switch to 0.05mm", "3D Touch - down 0.05mm"}}}};
    return table;
}

}  // namespace

TEST_CASE("every button of the A30T's screen sends the frames written down from the real one") {
    std::size_t rows = 0;
    for (const Vector& vector : load_vectors("geeetech-a30t").vectors) {
        const bool variant =
            vector.button.ends_with("(homed)") || vector.button.find(", ") != std::string::npos;
        if (variant || vector.frame.empty()) continue;
        CAPTURE(vector.button);
        Bench bench;
        // The table was made with 3D Touch on; a bare screen shows CAS.
        bench.say("L3 PS:0 VL:0 MT:0 FT:0 AL:1 ST:1 WF:0 MR:100 FN: PG:0 TM:0 LA:0 LC:0");
        const auto hit = ways().find(vector.button);
        const Way way = hit == ways().end() ? Way{{}, {vector.button}} : hit->second;
        // Opens the page first, since opening may ask the board, which would then answer what is said below.
        for (const std::string& path : way.pressed) {
            if (&path == &way.pressed.back()) {
                for (const std::string& body : way.said)
                    bench.say(body);
            }
            const screen::PressResult result = bench->press(path, bench.now());
            CHECK_MESSAGE(result.pressed, result.sentence);
        }
        bench.pass(0.01);
        std::string expected;
        for (const std::string& frame : vector.frame) {
            expected += frame + "\r\n";
        }
        const std::string sent = bench.take();
        CHECK_MESSAGE(sent.ends_with(expected), sent);
        ++rows;
    }
    CHECK(rows >= 100);
    MESSAGE(rows, " rows");
}

TEST_CASE("a step down sends nothing while the screen knows no value, as the real one") {
    Bench bench;
    bench.press("Control/Motion Param/Steps/mm");
    CHECK(bench.press("X-axis down") == "");
    bench.say("L24 P0 A80.00 B80.00 C400.00 D390.00");
    CHECK(bench.press("X-axis down") == "M92 X79.00");
    CHECK(bench.press("E0-axis up") == "M92 E391.00");
}

TEST_CASE("paths: the end is enough, letters' case does not matter, the page that is open comes first") {
    Bench bench;
    CHECK(bench.press("Control/Home/Home all") == "G28");
    CHECK(bench->page().path == "Control/Home");
    CHECK(bench.press("home x") == "G28 X0");
    CHECK(bench.press("Home/Home Y") == "G28 Y0");
    CHECK(bench.press("Change mix=100") == "M27 | M2135 P100");
    CHECK(bench.press("babystep/Rset") == "M2140 S5 | M290 Z0");
    CHECK(bench.press("Rset") == "M290 Z0");
    CHECK(bench.press("Screen lock PW=42") == "M2139 | M2139 P2 W42");
}

TEST_CASE("paths that are wrong say what is near, or what they may be") {
    Bench bench;
    CHECK(bench.press("Control/Move/X+ (30m)") ==
          "there is no button \"Control/Move/X+ (30m)\"; did you mean \"Control/Move/X+ (30mm)\", or "
          "\"Control/Move/X- (30mm)\", or \"Control/Move/Y+ (30mm)\"?");
    CHECK(bench.press("babystop up")
              .starts_with("there is no button \"babystop up\"; did you mean "
                           "\"Control/Motion Param/babystep/babystep up\""));
    CHECK(bench.press("xyzzy plugh 12345") == "there is no button \"xyzzy plugh 12345\"");
    CHECK(bench.press("") == "there is no button \"\"");
    CHECK(bench.press("Rset") ==
          "\"Rset\" may be \"Control/Motion Param/Steps/mm/Rset\", "
          "\"Control/Motion Param/babystep/Rset\", "
          "\"Control/Motion Param/Double z home offset/Rset\"; write more of its path");
    CHECK(bench.press("Screen lock PW=12345") ==
          "\"Setting/Add-on/Screen lock PW\" takes a number from 0 to 9999; found 12345");
    CHECK(bench.press("Screen lock PW=abc") ==
          "\"Setting/Add-on/Screen lock PW\" takes a number from 0 to 9999; found \"abc\"");
    CHECK(resolve_page(bench->profile(), "Jrek").sentence ==
          "there is no page \"Jrek\"; did you mean \"Control/Motion Param/Jerk\"?");
    CHECK(bench.press("Home all=1") == "\"Control/Home/Home all\" takes no number");
    CHECK(bench.press("X+ (10mm)") ==
          "\"Control/Move/X+ (10mm)\" is not there now; it is when move.step is 10, and it is 30");
}

TEST_CASE("while it prints, pages stay shut, and the sentence says why") {
    Bench bench("geeetech-a30");
    bench.say("L3 PS:1 VL:0 MT:1 FT:0 AL:1 ST:1 WF:0 FN:a.gcode PG:5 TM:60 LA:1 LC:20");
    CHECK(bench.press("Home all") ==
          "\"Control/Home/Home all\" cannot be reached: Control/Home stays shut now; it opens when "
          "job.status is one "
          "of 0, 3, and it is 1");
    CHECK(bench.press("Control/Leveling").find("stays shut") != std::string::npos);
    CHECK(bench.press("Setting/Factory Default").find("stays shut") != std::string::npos);
    CHECK(bench.press("Control/Filament").find("stays shut") != std::string::npos);
    CHECK(bench->show("Control").find("(Home)  (Move)  (Leveling)  (Filament)  [Speed]") !=
          std::string::npos);
    CHECK(bench.press("Printing") == "M105 | M27");
    CHECK(bench->page().path == "Bar chart button");
    CHECK(bench.press("Bar chart button/Pause?/yes") == "M25 | M105 | M27");
    CHECK(bench->get("job.status") == "2");
    CHECK(bench.press("Control/Filament") == "");
    CHECK(bench.press("Bar chart button/Resume") == "M105 | M27 | M24");
    bench.say("L3 PS:3 VL:0 MT:1 FT:0 AL:1 ST:1 WF:0 FN:a.gcode PG:5 TM:60 LA:1 LC:20");
    CHECK(bench.press("Home all") == "G28");
}

TEST_CASE("pages that no button leads to say what opens them") {
    Bench bench;
    CHECK(bench.press("Resume?/yes") ==
          "\"Resume?/yes\" cannot be reached by touch now: its page opens by itself, on \"L16 P0 15\"");
    CHECK(bench.press("Exception/OK").find("opens by itself, on \"L18 P26 S0\"") != std::string::npos);
    bench.say("L16 P0 15");
    CHECK(bench.press("Resume?/yes") == "M2130 P0 S1");
}

TEST_CASE("the file list: rows by number and by name, folders, the way back") {
    Bench bench;
    CHECK(bench.press("Printing") == "M105 | M20 LCD");
    CHECK(bench.press("File").find("no such entry") != std::string::npos);
    for (const char* body :
         {"L7 begin file list:0", "L7 P0 a.gcode", "L7 P1 Box", "L7 P2 b.gco", "L7 end file list:0"}) {
        bench.say(body);
    }
    CHECK(bench->show().find("[a.gcode]  [b.gco]  [Box]") != std::string::npos);
    CHECK(bench.press("Box") == "M20 file:SD1:/Box");
    CHECK(bench.press("File 2").find("no such entry") != std::string::npos);
    CHECK(bench.press("Printing/b.gco") == "");
    CHECK(bench->show().starts_with(
        "Print this file?  (Printing/Print?)\n-----------------------------------\nb.gco\n"));
    CHECK(bench.press("yes") == "M23 b.gco | M24 | M27");
    Bench other("geeetech-a30");
    other.press("Printing");
    other.say("L7 P0 a.gcode");
    other.say("L7 end file list:0");
    other.press("File 1");
    CHECK(other.press("Print?/yes") == "M23 a.gcode*" +
                                           std::to_string(protocol::xor_checksum("N-0 L7 P0 a.gcode")) +
                                           " | M24 | M105 | M27");
}

TEST_CASE("an A30 homes before it moves while its motors are off, and sends bare lines") {
    Bench bench("geeetech-a30");
    CHECK(bench.press("X+ (30mm)") == "G28 | G91 | G1 F6000 X30.00 | G90");
    CHECK(bench.press("X+ (30mm)") == "G91 | G1 F6000 X30.00 | G90");
    CHECK(bench.press("Bar chart button/Parameter/Fan on") == "M105 | M27 | M106 P0 S255 ");
    bench.pass(0.01);
    CHECK(bench.take().ends_with("M105\r\nM27\r\nM106 P0 S255 \r\n"));
}
