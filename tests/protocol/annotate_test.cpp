#include "protocol/annotate.h"

#include <doctest/doctest.h>

#include <random>
#include <string>

using namespace fauxboard::protocol;

namespace {

std::string board(std::string_view line) {
    return explain(decode_line(line, Direction::to_screen));
}
std::string screen(std::string_view line) {
    return explain(decode_line(line, Direction::to_board));
}

}  // namespace

TEST_CASE("what boards say that speak as hosts do, in words") {
    CHECK(board("ok T:22.00 /0.00 B:21.50 /60.00 @:0 B@:127") ==
          "temperatures: nozzle 22.00 °C (target 0.00 °C), bed 21.50 °C (target 60.00 °C), nozzle power 0 of "
          "127, bed power 127 of 127");
    CHECK(board(" T:150.12 /200.00 B:22.00 /0.00 @:127 B@:0 W:?").ends_with("must hold for \"?\""));
    CHECK(board("X:10.00 Y:0.00 Z:5.00 E:0.00 Count X:800 Y:0 Z:2000") ==
          "position: X 10.00 mm, Y 0.00 mm, Z 5.00 mm, E 0.00 mm, steps \"X:800 Y:0 Z:2000\"");
    CHECK(board("Resend: 6") == "again, please: \"6\"");
    CHECK(board("echo:busy: processing") == "busy: \"processing\"");
    CHECK(board("echo:SD card ok") == "message: \"SD card ok\"");
    CHECK(board("//action:prompt_end") == "question is over");
    CHECK(board("//action:paused") == "host action: \"paused\"");
    CHECK(board("Cap:EEPROM:1") == "capability: \"EEPROM:1\"");
    CHECK(
        board("ok B:0/0 X:0.000 Y:0.000 Z:5.100 F:0/256 D:3860/241025/0 ") ==
        "status: bed 0 °C (target 0 °C), X 0.000 mm, Y 0.000 mm, Z 5.100 mm, LED fan 0 of 256, board fan 256 "
        "of 256, at 3860 bytes, of 241025 bytes, halted 0");
    CHECK(board("ok N:7") == "acknowledged: \"N:7\"");
    CHECK(screen("G0 Z10.0 F600 I0") == "move: Z 10.0 mm, feedrate 600 mm/min, relative");
    CHECK(screen("M155 S2") == "temperature reports: every 2 s");
    CHECK(screen("M876 S1") == "answer a question: button 1");
}

TEST_CASE("what a board says, in words") {
    CHECK(board("N-0 L1 X198.200 Y160.000 Z15.000 F100*61") ==
          "position: X 198.200 mm, Y 160.000 mm, Z 15.000 mm, feedrate 100 mm/s");
    CHECK(board("N-0 L2 B:21.3 /50.0 /1 T0:27.0 /0.0 /0 SD:1 F0:100 F2:50 R:10 FR:5") ==
          "temperatures: bed 21.3 °C (target 50.0 °C, on), extruder 0 27.0 °C (target 0.0 °C, off), no SD "
          "card, "
          "part fan 100 %, board fan 50 %, print speed 10 %, feedrate 5 mm/s [prefix without checksum]");
    CHECK(board("L3 PS:1") == "print status: printing");
    CHECK(board("L3 PS:7 MR:6553600") == "print status: print status 7, mixing ratio E2 100 %");
    CHECK(board("L3 MR:15400 FN: PG:0") ==
          "print status: mixing ratio E0 40 % E1 60 %, no file name, progress 0 %");
    CHECK(board("L7 begin file list:0") == "file list: begins, SD card");
    CHECK(board("L7 P4 4. Troubleshooting Guide") == "file list: entry 4, name \"4. Troubleshooting Guide\"");
    CHECK(board("L14  Layer 1/21") == "message: \"Layer 1/21\"");
    CHECK(board("L16 P0 15") == "restart: power-loss recovery, offer 15");
    CHECK(board("L18 P26 S12") == "exception: message page, hotend too cold to change filament");
    CHECK(board("L24 P5 A0.15") == "settings: babystep, Z 0.15 mm");
    CHECK(board("L19 P2 SM:1 MS:16 HC:300") ==
          "closed-loop steppers: report, motor 1, microsteps 16, holding current 300 mA");
    CHECK(board("SD printing byte 12/3456") == "SD progress: at 12, of 3456 bytes");
    CHECK(board("Start Print:SD1:/A30T/cube x.gco") == "print started: \"SD1:/A30T/cube x.gco\"");
    CHECK(board("Stop Print") == "print stopped");
    CHECK(board("M2107 Z:8.00") == "manual leveling: Z 8.00 mm");
    CHECK(board("M2107 ok") == "manual leveling: point reached");
    CHECK(board("M2107 fail") == "manual leveling: point not reached");
    CHECK(board("M2107 save success") == "manual leveling: saved");
    CHECK(board("L4 WT:1 CF:0 RA:my net:") == "WiFi: WiFi on, auto connect off, network name \"my net\"");
    CHECK(board("L9 DN:A;SN:\xFF\xFF\xFF;HV:\xC4;") ==
          "identity: device \"A\", serial number blank (3 x 0xff), hardware \"\\xc4\"");
}

TEST_CASE("what a screen says, in words") {
    CHECK(screen("log A30 LCD OK") == "screen log: \"A30 LCD OK\"");
    CHECK(screen("x:12,y:3;") == "touch point: \"12,y:3;\"");
    CHECK(screen("M104 S200.0") == "nozzle: target 200.0 °C");
    CHECK(screen("G28") == "home");
    CHECK(screen("G28 X0") == "home: X");
    CHECK(screen("G1X10Y-20.5F600") == "move: X 10 mm, Y -20.5 mm, feedrate 600 mm/min");
    CHECK(screen("M2107 S10") == "manual leveling: Z up 0.05 mm");
    CHECK(screen("M2120 P3 S2") == "auto leveling: Z up, 0.1 mm");
    CHECK(screen("M2139 P2 E16") == "add-ons: screen lock, lock after 16 s");
    CHECK(screen("M2139 P1 E16") == "add-ons: backlight, brightness 16 %");
    CHECK(screen("M106 P0 S252 ") == "fan: part fan, speed 252 of 255");
    CHECK(screen("M20 file:SD1:/My dir") == "list files: folder \"SD1:/My dir\"");
    CHECK(screen("M2135 P25600") == "mixing ratio: ratio, or tool E1 100 %");
    CHECK(screen("N-0 N-0 M2134 FW:V1.02.xx*39") == "screen version: firmware \"V1.02.xx\" [2 prefixes]");
    CHECK(screen("M2135 P1 S30") == "mixing ratio: ratio, or tool 1, percent 30 %");
    CHECK(screen("M2121 ok") == "screen firmware file: file taken");
}

TEST_CASE("what is wrong or unknown is said") {
    CHECK(screen("N-0 G28*61") == "home [checksum 61 is wrong, 62 is right]");
    CHECK(board("N-0 L14 Pausing... please try again later.*") ==
          "message: \"Pausing... please try again later.\" [star without checksum]");
    CHECK(board("L999 X1") == "unknown \"L999 X1\"");
    CHECK(screen("?!") == "unknown \"?!\"");
    CHECK(board("") == "empty");
    CHECK(board("N-0") == "empty [prefix without checksum]");
    CHECK(screen("M104 Snan") == "nozzle: target \"nan\"");
    CHECK(screen("M104 Q5") == "nozzle: unknown \"Q5\"");
    CHECK(board("L3 PS:0 ZZ:4") == "print status: idle, unknown \"ZZ:4\"");
    CHECK(screen("M99998 S1") == "unknown \"M99998 S1\"");
}

TEST_CASE("the lines of a ChiTu resin board in words") {
    CHECK(screen("M4000") == "status query");
    CHECK(screen("M6030 'a b.ctb'") == "print file: \"'a b.ctb'\"");
    CHECK(screen("M8015 I3 P2.5") == "first speeds: homing 3 mm/s, slow lift 2.5 mm/s");
    CHECK(screen("M99999") == "discovery");
    CHECK(board("ok N:0") == "acknowledged: \"N:0\"");
    CHECK(board("//Disk init fail!") == "no stick");
    CHECK(board("// TEST.TXT") == "file: \"TEST.TXT\"");
    CHECK(board("start_task") == "power-on");
}

TEST_CASE("decoded parts") {
    const DecodedLine line = decode_line("N-0 L24 P5 A-0.10*47", Direction::to_screen);
    REQUIRE(line.known());
    CHECK(line.checksum_ok());
    CHECK(line.prefixes.size() == 1);
    CHECK(line.prefixes[0].number == "-0");
    CHECK(line.style == FrameStyle::framed);
    CHECK(line.code_text == "L24");
    const DecodedField* babystep = line.field("A");
    REQUIRE(babystep != nullptr);
    CHECK(babystep->number == -0.1);
    CHECK(babystep->decimals == 2);
    CHECK(babystep->info->name == "Z");
    CHECK(line.field("Q") == nullptr);
    CHECK_FALSE(decode_line("N-0 L24 P5 A-0.10*45", Direction::to_screen).checksum_ok());
    // A heater's target belongs to that heater, also where the bed is missing.
    const DecodedLine hot = decode_line("L2 T0:27.0 /200.0 /1", Direction::to_screen);
    REQUIRE(hot.fields.size() == 3);
    REQUIRE(hot.code->fields[3].key == "T0:");
    CHECK(hot.fields[1].info == &hot.code->fields[4]);
    CHECK(hot.fields[2].info == &hot.code->fields[5]);
    // No P, no page: the field cannot be told.
    CHECK_FALSE(decode_line("L24 A1.00", Direction::to_screen).known());
}

TEST_CASE("encoding prints the typed values, not the line") {
    DecodedLine line = decode_line("N-0 L24 P5 A0.15*7", Direction::to_screen);
    REQUIRE(line.fields.size() == 2);
    line.fields[1].number = 0.3;
    CHECK(encode_line(line) == "N-0 L24 P5 A0.30*0");
    line.fields[1].decimals = 3;
    line.style = FrameStyle::unfinished;
    CHECK(encode_line(line) == "N-0 L24 P5 A0.300");
    line.style = FrameStyle::star_only;
    CHECK(encode_line(line) == "N-0 L24 P5 A0.300*");
    line.prefixes.clear();
    line.style = FrameStyle::bare;
    CHECK(encode_line(line) == "L24 P5 A0.300");
    CHECK(encode_line(decode_line("N-0 G28*61", Direction::to_board)) == "N-0 G28*62");
}

TEST_CASE("a file name may hold what looks like fields") {
    const DecodedLine line = decode_line("L3 PS:1 FN:a b LA: c.gco PG:7 TM:0", Direction::to_screen);
    CHECK(line.field("PG:")->number == 7);
    CHECK(encode_line(line) == "L3 PS:1 FN:a b LA: c.gco PG:7 TM:0");
    const DecodedLine entry = decode_line("L7 P1 P2 begin file list:3", Direction::to_screen);
    REQUIRE(entry.fields.size() == 2);
    CHECK(entry.fields[1].text == "P2 begin file list:3");
}

TEST_CASE("odd blanks and numbers come back as they were") {
    for (const std::string_view line : {"  G28",
                                        "N-0  N12 G1  X+5\tY007 Z1.e5 ",
                                        "L14",
                                        "L14 ",
                                        "L14   ",
                                        "M104 S-0.00",
                                        "M0105",
                                        "L2 B:20.0/0.0/0 T0:",
                                        "M23 name.gco*82",
                                        "M117 a*b",
                                        "N-0 M117 a*b",
                                        "L9 DN:a;;DM:b",
                                        "M 5",
                                        "G1XYZ",
                                        "L1 X99999999999999999999.5 Y1e400",
                                        "M2107 Zok",
                                        "\xFF\xFF 12",
                                        "*",
                                        "N-0 *",
                                        "N-0*",
                                        " "}) {
        CAPTURE(line);
        CHECK(encode_line(decode_line(line, Direction::to_screen)) == line);
        CHECK(encode_line(decode_line(line, Direction::to_board)) == line);
    }
}

TEST_CASE("property: any line decodes, is explained, and encodes to the same bytes") {
    std::mt19937 random(99);
    const std::string_view pieces[] = {"N-0 ", "L2",  "L3", "L7",  "L9",   "L24", "M2120", "G1",
                                       " ",    "B:",  "/0", "FN:", "PG:",  "DN:", ";",     "P",
                                       "S",    "A",   "X",  "1.5", "-0",   "12",  "*x",    "e5",
                                       "\t",   "L14", "/",  "log", "\xFF", ":",   "ok"};
    std::size_t known = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string line;
        for (std::size_t i = random() % 12; i > 0; --i) {
            line += pieces[random() % std::size(pieces)];
        }
        const Direction direction = random() % 2 == 0 ? Direction::to_screen : Direction::to_board;
        const DecodedLine decoded = decode_line(line, direction);
        CAPTURE(line);
        REQUIRE(encode_line(decoded) == line);
        REQUIRE_FALSE(explain(decoded).empty());
        if (decoded.known()) ++known;
    }
    CHECK(known > 500);
}
