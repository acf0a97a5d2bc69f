// Right frames with wrong parameters: missing, huge, negative, not numbers.

#include <doctest/doctest.h>

#include <cmath>

#include "emulator/behaviour/fields.h"
#include "protocol/framing.h"
#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using std::string;

namespace {

struct Ready {
    BoardDriver driver;
    explicit Ready(const char* profile = "geeetech-a30t") : driver(profile) { driver.finish_boot(); }
    string ask(const string& body) {
        driver.run_to_quiet();
        return join(driver.ask(body, 0.4));
    }
    double number(const char* path) { return driver.number(path); }
};

/// Every number the board could show is one, and the next request is answered.
void check_sound(BoardDriver& driver) {
    for (const behaviour::Field& field : behaviour::fields()) {
        if (field.type == behaviour::FieldType::text || field.get(driver.machine()).none()) {
            continue;
        }
        CAPTURE(field.path);
        const double value = field.get(driver.machine()).number;
        REQUIRE(std::isfinite(value));
        if (field.set != nullptr) {
            CHECK(value >= field.min);
            CHECK(value <= field.max);
        }
    }
    const double from = driver.now();
    driver.press("M2140 S6");
    driver.run_for(0.5);
    CHECK(driver.matching("L24 P6", from).size() == 1);
}

}  // namespace

TEST_CASE("bad parameters: G28 X without a number homes X") {
    Ready ready;
    CHECK(ready.ask("G28 X").empty());
    ready.driver.run_for(20);
    CHECK(ready.number("motors.enabled") == 1);
    CHECK(ready.number("motion.homed") == 0);
    CHECK(ready.number("position.z") == 0);
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: M104 without S changes nothing and is answered") {
    Ready ready;
    ready.driver.press("M104 S200");
    ready.driver.run_for(0.3);
    CHECK(ready.ask("M104").find(" /200.0 /1 ") != string::npos);
    CHECK(ready.number("heaters.nozzle.target") == 200);
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: heater targets beyond reason are kept within the machine's, no number is 0") {
    struct Row {
        const char* request;
        double nozzle;
    };
    for (const Row& row :
         {Row{"M104 S1e99", 250}, Row{"M104 S99999999999999999999999", 250}, Row{"M104 Snan", 0},
          Row{"M104 Sinf", 0}, Row{"M104 S-1e99", 0}, Row{"M104 S", 0}, Row{"M104 S.", 0},
          Row{"M104 S--5", 0}, Row{"M104 S0x20", 0}, Row{"M104 S1e-99", 0}, Row{"M104 S100 S200", 100},
          Row{"M104 S+55", 55}, Row{"M104S66", 66}, Row{"M104  S77", 77}, Row{"M104 S 88", 88}}) {
        CAPTURE(row.request);
        Ready ready;
        CHECK(ready.ask(row.request).starts_with("L2 "));
        CHECK(ready.number("heaters.nozzle.target") == doctest::Approx(row.nozzle));
        check_sound(ready.driver);
    }
}

TEST_CASE("bad parameters: babysteps") {
    Ready ready;
    ready.driver.press("G28");
    ready.driver.run_for(50);
    CHECK(ready.ask("M290 Z0.25") == "L24 P5 A0.25\n");
    CHECK(ready.ask("M290") == "L24 P5 A0.25\n");    // nothing said, nothing changed
    CHECK(ready.ask("M290 Z") == "L24 P5 A0.00\n");  // as strtod reads it
    CHECK(ready.ask("M290 Z1e99") == "L24 P5 A10.00\n");
    CHECK(ready.ask("M290 Z-1e99") == "L24 P5 A-10.00\n");
    CHECK(ready.ask("M290 Znan") == "L24 P5 A0.00\n");
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: selectors that no rule is for are unanswered and counted") {
    Ready ready;
    for (const char* request :
         {"M2107 S99",   "M2107",    "M2107 S-1",   "M2107 S1.5",  "M2107 S12",    "M2120",
          "M2120 P8",    "M2120 P2", "M2120 P3 S4", "M2120 P0 S2", "M2140",        "M2140 S4",
          "M2140 S99",   "M2105",    "M2105 S9",    "M2115 S2",    "M2115",        "M2111 S7",
          "M2130 P7",    "M2133",    "M2133 S-1",   "M2133 S16",   "M2139 P9",     "M2011",
          "M2011 P2 S1", "M2100 S3", "M2132",       "M2132 P9",    "M2132 P1 C12", "M20 nonsense"}) {
        CAPTURE(request);
        const std::uint64_t before = ready.driver.board().counters().unmatched;
        CHECK(ready.ask(request).empty());
        CHECK(ready.driver.board().counters().unmatched == before + 1);
    }
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: mixing values that are no ratio leave the mixer as it is") {
    Ready ready;
    ready.driver.press("M2135 P25600");
    ready.driver.run_for(0.3);
    for (const char* request : {"M2135 P-1",       "M2135 P1e99",  "M2135 P0",     "M2135 P101",
                                "M2135 P16777216", "M2135",        "M2135 P100.5", "M2135 P9 S50",
                                "M2135 P1 S101",   "M2135 P1 S-1", "M2135 Pnan",   "M2136 S0",
                                "M2136 S15",       "M2136",        "M2137 A-5",    "M2137 A1 B2 C-1 D1e9",
                                "M2137",           "M2138 S4",     "M2138 S-1",    "M2138"}) {
        CAPTURE(request);
        CHECK(ready.ask(request) == "L22 MS:0 MR:25600 SP:100 EP:100 SH:0.00 EH:0.00\n");
    }
    CHECK(ready.ask("M165 A-1 B-1 C-1").empty());
    CHECK(ready.ask("M165").empty());
    CHECK(ready.ask("M165 A1e99 B1e99 C0").empty());
    CHECK(ready.number("mixer.a") == 50);
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: file names that lead out of the card, or nowhere") {
    Ready ready;
    const string root = "L7 begin file list:0\nL7 P0 testpattern.gcode\nL7 P1 A30T\nL7 end file list:0\n";
    for (const char* request :
         {"M20 file:SD1:/../..", "M20 file:", "M20 file:/", "M20 file:SD1:", "M20 file:../A30T",
          "M20 file:A30T/..", "M20 file:SD1:/A30T/../../etc", "M20 file:SD1:/testpattern.gcode",
          "M20 file:Main", "M20 file:Main/Main", "M20 file:\x01", "M20 file:SD1:SD1:/A30T"}) {
        CAPTURE(request);
        CHECK(ready.ask(request) == root);
        CHECK(ready.driver.text("card.folder").empty());
    }
    for (const char* request : {"M23", "M23 ", "M23 ..", "M23 ../../etc/passwd", "M23 /etc/passwd", "M23 *",
                                "M23 *5", "M23 SD1:", "M23 testpattern.gcode/x", "M23 \x01"}) {
        CAPTURE(request);
        CHECK(ready.ask(request) == "L18 P26 S3\n");
    }
    CHECK(ready.ask("M23 " + string(400, 'x')) == "L18 P26 S3\n");
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: moves beyond the machine end inside it") {
    Ready ready;
    for (const char* request :
         {"G1 X1e30 F-1", "G1 X-1e30 Y-1e30 Z-1e30", "G1 X1e30 Y1e30 Z1e30 E1e30 F1e30", "G1 F0",
          "G1 Xnan Ynan", "G1", "G0 X", "G92 X1e99 Y-1e99", "G1 X0 Y0 Z0 F1e-30"}) {
        CAPTURE(request);
        CHECK(ready.ask(request).empty());
    }
    ready.driver.run_for(10);
    for (const char* path : {"position.x", "position.y", "position.z"}) {
        CHECK(ready.number(path) >= 0);
        CHECK(ready.number(path) <= 420);
    }
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: settings stay within their bounds") {
    Ready ready;
    CHECK(ready.ask("M92 X0") == "L24 P0 A0.01 B80.00 C400.00 D390.00\n");
    CHECK(ready.ask("M92 X-5 Y1e99") == "L24 P0 A0.01 B100000.00 C400.00 D390.00\n");
    CHECK(ready.ask("M92") == "L24 P0 A0.01 B100000.00 C400.00 D390.00\n");
    CHECK(ready.ask("M2011 P0 S1e9") == "L24 P6 A10.00 B0.00\n");
    CHECK(ready.ask("M2011 P0 S-1e9") == "L24 P6 A-10.00 B0.00\n");
    CHECK(ready.ask("M2120 P2 S1e9") == "L11 P0 S50.00\n");
    for (const char* request : {"M201 X-1 Y1e99", "M203 X0 Y-5 E1e99", "M204 S0 T-1", "M205 X-1 S1e99",
                                "M220", "M220 S-5", "M220 S1e99", "M106 S-5", "M106 S1e99", "M106 P7",
                                "M106 P-1 S5", "M106 Snan", "L1 S99", "L1 S-1", "L1", "L2 S77", "M26 S-1"}) {
        CAPTURE(request);
        CHECK(ready.ask(request).empty());
    }
    for (const char* request : {"M2139 P1 E999", "M2139 P1 E-1", "M2139 P2 W123456 E1e9", "M2139 P2 W-1",
                                "M2139 P3 A1e9 B-1e9", "M2139 P0", "M2139 P0 S7"}) {
        CAPTURE(request);
        CHECK(ready.ask(request).starts_with("L23 "));
    }
    check_sound(ready.driver);
    ready.driver.press("G1 X100 F6000");  // with the slowest and the fastest settings that came of it
    ready.driver.run_for(1);
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: the leveling height stays a number, however often it is raised") {
    Ready ready;
    for (int i = 0; i < 3000; ++i) {
        ready.driver.press("M2107 S6");
        ready.driver.run_for(0.06);
    }
    CHECK(ready.number("leveling.manual_z") == 500);
    check_sound(ready.driver);
}

TEST_CASE("bad parameters: an A30 board never sends the exception page that resets its screen") {
    Ready ready("geeetech-a30");
    for (int page = -2; page <= 300; ++page) {
        ready.driver.press("M2133 S" + std::to_string(page));
        ready.driver.run_for(0.06);
    }
    ready.driver.run_for(1);
    CHECK(ready.driver.matching("L18").empty());
}
