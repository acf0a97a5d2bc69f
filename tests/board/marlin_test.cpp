// A Marlin board beyond single answers: both lines, waiting, reports, the card, questions, settings.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "protocol/framing.h"
#include "tests/support/marlin.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using board::Channel;

namespace {

struct Marlin : MarlinBench {
    /// What one line brought to the other.
    const std::string& heard_by_host() const { return said(Channel::host); }
};

std::ptrdiff_t count(const std::string& text, std::string_view part) {
    std::ptrdiff_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) {
        ++found;
    }
    return found;
}

/// What a host that counts its lines sends; only such ones are written to a file.
std::string numbered(int number, const std::string& command) {
    const std::string line = "N" + std::to_string(number) + " " + command;
    return line + "*" + std::to_string(protocol::xor_checksum(line));
}

constexpr std::string_view position = "X:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0 Y:0 Z:0\n";

}  // namespace

TEST_CASE_FIXTURE(Marlin, "Marlin: each line has its own numbers and its own answers") {
    say("N1 M105*38");
    say("N1 M82*24", Channel::host);
    CHECK(said() == "ok T:22.00 /0.00 B:22.00 /0.00 @:0 B@:0\n");
    CHECK(heard_by_host() == "ok\n");
    forget();
    say("N7 M105*32", Channel::host);
    CHECK(said().empty());
    CHECK(heard_by_host().starts_with(
        "Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: a command that takes its time holds up both lines, and both are told") {
    say("G4 S5");
    say("M105", Channel::host, 4);
    CHECK(said() == "echo:busy: processing\necho:busy: processing\n");
    CHECK(heard_by_host() == said());
    run_for(2);
    CHECK(said().ends_with("processing\nok\n"));
    CHECK(heard_by_host().ends_with("ok T:22.00 /0.00 B:22.00 /0.00 @:0 B@:0\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: M118 goes to whom it names") {
    say("M118 P2 for the host");
    CHECK(said() == "ok\n");
    CHECK(heard_by_host() == "for the host\r\n");
    CHECK(told("M118 A1 P0 E1 for all") == "echo://for all\r\nok\n");
    CHECK(heard_by_host() == "echo://for all\r\n");
    CHECK(told("M118 E1") == "echo:\r\nok\n");
}

TEST_CASE_FIXTURE(Marlin, "Marlin: reports come by themselves, on both lines, whatever else is done") {
    say("M155 S2");
    forget();
    say("G4 S7", Channel::main, 6.5);
    CHECK(count(said(), " T:22.00 /0.00 B:22.00 /0.00 @:0 B@:0\n") == 3);
    CHECK(count(heard_by_host(), " T:22.00") == 3);
    run_for(1);
    say("M155 S0");
    say("M154 S3");
    forget();
    run_for(7);
    CHECK(said() == std::string(position) + std::string(position));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: heating is told each second, and must hold for ten") {
    say("M109 S60", Channel::main, 4.1);
    CHECK(count(said(), "W:?\n") == 5);
    CHECK(heard_by_host().find("W:") == std::string::npos);  // to whoever asked
    run_for(200);
    CHECK(has(said(), "W:9\n"));
    CHECK(has(said(), "W:0\n"));
    CHECK(said().ends_with("ok\n"));
    CHECK(told("M109 S20", 0.1) == "ok\n");
    CHECK(count(told("M108\nM105", 0.1), "ok") == 2);
}

TEST_CASE_FIXTURE(Marlin, "Marlin: a heater that is there already must hold as well") {
    say("M104 S60", Channel::main, 300);
    forget();
    say("M109 S60", Channel::main, 0.3);
    CHECK(said().ends_with("W:?\n"));
    run_for(14);
    CHECK(has(said(), "W:12\n"));
    CHECK(said().ends_with("ok\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: homing ends with the position, once for O") {
    const std::string homing = told("G28", 30);
    CHECK(homing.ends_with(std::string(position) + "ok\n"));
    CHECK(count(homing, "Count") == 1);
    CHECK(told("G28 O") == "ok\n");
    CHECK(told("G28 X", 10).ends_with(std::string(position) + "ok\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: the bed is measured, told, kept, and told as settings") {
    home();
    const std::string probing = told("G29 V1", 90);
    CHECK(probing.starts_with("G29 Auto Bed Leveling\n"));
    CHECK(has(probing, "Probing mesh point 1/9.\n"));
    CHECK(has(probing, "Probing mesh point 9/9.\n"));
    CHECK(has(probing, "Bilinear Leveling Grid:\n      0      1      2\n 0 +0."));
    CHECK(has(told("M503 S0"), "  M420 S1 Z10.00 ; Leveling ON\n  G29 W I0 J0 Z"));
    CHECK(told("M420 S0").starts_with("echo:Bed Leveling OFF\n"));
    say("G29 W I1 J2 Z0.123");
    CHECK(has(told("M503"), "echo:  G29 W I1 J2 Z0.12300\n"));
    CHECK(told("M500").starts_with("echo:Settings Stored ("));
    say("M502");
    CHECK(!has(told("M503"), "G29 W"));
    CHECK(told("M501").starts_with("echo:V88 stored settings retrieved ("));
    CHECK(has(told("M503"), "echo:  G29 W I1 J2 Z0.12300\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: settings that only a profile knows are kept as well") {
    say("M301 P30");
    say("M851 Z-1.25");
    say("M500");
    say("M502");
    CHECK(told("M301") == "  M301 P22.20 I1.08 D114.00\nok\n");
    say("M501");
    CHECK(has(told("M503 S0"), "  M301 P30.00 I1.08 D114.00\n"));
    CHECK(told("M851") == "  M851 X10.00 Y10.00 Z-1.25 ; (mm)\nok\n");
    world("board reset");
    run_for(1);
    CHECK(said().find("\n External Reset\n") != std::string::npos);
    CHECK(said().find("echo:V88 stored settings retrieved (") != std::string::npos);
    CHECK(told("M301") == "  M301 P30.00 I1.08 D114.00\nok\n");
}

TEST_CASE_FIXTURE(Marlin, "Marlin: files have short names and long ones") {
    put("Long folder/A benchy with supports.gcode", "G28\n");
    put("Long folder/A benchy with rafts.gcode", "G28\n");
    put("notes.txt", "no code");
    const std::string list = told("M20 L");
    CHECK(has(list, "\nTEST.GCO 1234 TEST.GCO\n"));
    CHECK(has(list, "\nLONGFO~1/ABENCH~1.GCO 4 Long folder/A benchy with rafts.gcode\n"));
    CHECK(has(list, "\nLONGFO~1/ABENCH~2.GCO 4 Long folder/A benchy with supports.gcode\n"));
    CHECK(!has(list, "NOTES"));
    CHECK(told("M33 /longfo~1/abench~2.gco") == "/Long folder/A benchy with supports.gcode\nok\n");
    CHECK(
        has(told("M23 /longfo~1/abench~2.gco"), "\nFile opened: abench~2.gco Size: 4\nFile selected\nok\n"));
    CHECK(told("M27 C") == "Current file: ABENCH~2.GCO A benchy with supports.gcode\nok\n");
    say("M23 long folder/a benchy with rafts.gcode");  // ends at its first blank
    say("M23 test.gco");
    CHECK(told("M27 C") == "Current file: TEST.GCO\nok\n");
    CHECK(has(told("M20 T"), "\nTEST.GCO 1234 0x5A210000\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: of two lines that upload at once each writes its own file, or none") {
    say(numbered(1, "M28 FIRST.GCO"));
    say("M28 SECOND.GCO", Channel::host);
    CHECK(has(heard_by_host(), "open failed, File: SECOND.GCO.\nok\n"));
    forget();
    say("M104 S50", Channel::host);
    say(numbered(2, "G1 X1"));
    say("M29", Channel::host);
    CHECK(heard_by_host() == "ok\nok\n");  // it has no file open
    CHECK(number("heaters.nozzle.target") == 50);
    CHECK(told(numbered(3, "M29")) == "Done saving file.\nok\n");
    const std::string list = told("M20");
    CHECK(has(list, "\nFIRST.GCO 7\n"));
    CHECK(!has(list, "SECOND"));
}

TEST_CASE_FIXTURE(Marlin,
                  "Marlin: who was silent too long loses its file, and its lines go nowhere until M29") {
    say(numbered(1, "M28 FIRST.GCO"));
    say(numbered(2, "M104 S50"));
    run_for(40);
    say(numbered(1, "M28 SECOND.GCO"), Channel::host);
    say(numbered(2, "G1 X1"), Channel::host);
    CHECK(told(numbered(3, "M104 S60")) == "ok\n");
    CHECK(number("heaters.nozzle.target") == 0);
    CHECK(has(told(numbered(4, "M29")), "ok\n"));
    say(numbered(3, "M29"), Channel::host);
    CHECK(has(told("M20"), "\nSECOND.GCO 7\n"));
    CHECK(!has(told("M20"), "FIRST"));
    CHECK(told("M104 S70") == "ok\n");
    CHECK(number("heaters.nozzle.target") == 70);
}

TEST_CASE_FIXTURE(Marlin, "Marlin: a print from the card, told to both, stopped, and another one") {
    std::string moves = "G92 X0 Y0\nG1 F600\n";
    for (int i = 0; i < 40; ++i) {
        moves += i % 2 == 0 ? "G1 X5\n" : "G1 X0\n";
    }
    put("MOVES.G", moves);
    say("M23 moves.g", Channel::host);
    CHECK(has(said(), "File opened: moves.g Size:"));
    say("M24", Channel::host);
    CHECK(has(said(), "//action:resume\n"));
    say("M27 S1", Channel::host);
    forget();
    run_for(2.5);
    CHECK(count(said(), "SD printing byte ") == 2);
    CHECK(said() == heard_by_host());
    CHECK(has(told("M25"), "//action:prompt_begin Pause SD\n//action:prompt_button Resume\n"));
    run_for(20);
    CHECK(has(told("M27"), "SD printing byte "));
    CHECK(has(told("M876 S0"), "//action:resume\n"));
    CHECK(number("job.status") == 1);
    const std::string stop = told("M524", 20);
    CHECK(stop.starts_with("ok\n"));
    CHECK(has(stop, "Count X:0 Y:0"));
    CHECK(told("M27") == "Not SD printing\nok\n");
    say("M27 S0");
    say("M23 moves.g");
    say("M24");
    forget();
    run_for(60);
    CHECK(said() == "Done printing file\n");
}

TEST_CASE_FIXTURE(Marlin,
                  "Marlin: another file takes a running one's place, and nothing is run for its end") {
    put("LONG.G", "G4 S1000\n");
    put("SHORT.G", "G4 S1\n");
    for (const char* pause : {"", "M25"}) {
        CAPTURE(pause);
        say("M23 long.g");
        say("M24");
        say(pause);
        CHECK(told("M23 short.g") ==
              "echo:Now fresh file: short.g\nFile opened: short.g Size: 6\nFile selected\nok\n");
        say("M24");
        forget();
        run_for(5);
        CHECK(said() == "Done printing file\n");  // no position, as after M524: X and Y are not homed
    }
}

TEST_CASE_FIXTURE(Marlin,
                  "Marlin: a file's own commands follow the rules, and its replies go nowhere on two lines") {
    put("TALK.G",
        "M118 P0 from the file\nM118 quiet\nM92\nM301 P33\nM73 P40 R12\nM808 L3\nM118 P0 again\nM808\nG4 "
        "S1\n");
    say("M23 talk.g");
    forget();
    say("M24", Channel::main, 3);
    CHECK(has(said(), "from the file\r\nagain\r\nagain\r\nagain\r\n"));
    CHECK(!has(said(), "quiet"));
    CHECK(!has(said(), "M92"));
    CHECK(told("M301") == "  M301 P33.00 I1.08 D114.00\nok\n");
}

TEST_CASE_FIXTURE(Marlin, "Marlin: filament is changed with its questions") {
    home();
    CHECK(told("M600") ==
          "//action:paused\n//action:prompt_end\n//action:prompt_begin Pause\n//action:prompt_button "
          "Dismiss\n//action:prompt_show\necho:Hotend too cold\nok\n");
    say("M104 S200", Channel::main, 200);
    forget();
    say("M600", Channel::host, 20);
    CHECK(heard_by_host().starts_with("//action:paused\n//action:prompt_end\n//action:prompt_begin Pause\n"));
    CHECK(has(heard_by_host(), "echo:Insert filament and send M108\n"));
    CHECK(has(heard_by_host(), "//action:prompt_begin Nozzle Parked\n//action:prompt_button Continue\n"));
    CHECK(has(heard_by_host(), "echo:busy: paused for user\n"));
    forget();
    say("M876 S0", Channel::host);
    CHECK(has(heard_by_host(),
              "prompt_begin Paused\n//action:prompt_button PurgeMore\n//action:prompt_button Continue\n"));
    forget();
    say("M876 S1", Channel::host, 1);
    CHECK(has(heard_by_host(), "//action:prompt_end\n//action:resumed\n"));
    CHECK(count(heard_by_host(), "ok\n") == 3);  // of the two answers and of M600
}

TEST_CASE_FIXTURE(
    Marlin, "Marlin: a change of filament that takes too long lets the nozzle cool, and heats it again") {
    home();
    say("M104 S200", Channel::main, 200);
    say("M600", Channel::main, 20);
    forget();
    run_for(40);
    CHECK(has(said(),
              "echo:Send M108 to heat nozzle\n//action:prompt_end\n//action:prompt_begin Heater "
              "Timeout\n//action:prompt_button Reheat\n//action:prompt_show\n"));
    CHECK(number("heaters.nozzle.target") == 0);
    run_for(60);
    const std::string heating = told("M108", 1);
    CHECK(has(heating, "//action:prompt_begin Reheating...\n//action:prompt_show\n"));
    CHECK(number("heaters.nozzle.target") == 200);
    forget();
    run_for(100);
    CHECK(has(said(),
              "echo:Insert filament and send M108\n//action:prompt_end\n//action:prompt_begin Reheat "
              "Done\n//action:prompt_button Continue\n"));
    CHECK(has(told("M876 S0"),
              "echo:Insert filament and send M108\n//action:prompt_end\n//action:prompt_begin "
              "Load Filament T0\n//action:prompt_button Continue\n"));
    CHECK(has(told("M876 S0"), "//action:prompt_begin Paused\n"));
    forget();
    say("M108", Channel::main, 1);
    CHECK(has(said(), "//action:resumed\n"));
    CHECK(count(said(), "ok\n") == 5);  // of M600, two M108 and two M876
    // Answered in time nothing goes cold; M125 asks alike, and goes on at once.
    say("M125", Channel::main, 100);
    forget();
    run_for(1);
    CHECK(number("heaters.nozzle.target") == 0);
    CHECK(has(told("M108", 60),
              "echo:Send M108 to resume\n//action:prompt_end\n//action:prompt_begin Reheat Done\n"));
    CHECK(has(told("M108", 1), "//action:resumed\n"));
    run_for(100);
    CHECK(number("heaters.nozzle.target") == 200);
}

TEST_CASE_FIXTURE(Marlin, "Marlin: a tuning is told every two seconds") {
    say("M303 E0 S100 C3", Channel::main, 10.5);
    CHECK(count(said(), " T:") == 6);
    CHECK(count(told("M108", 1), "ok\n") == 2);
}

TEST_CASE_FIXTURE(Marlin, "Marlin: M0 asks, waits and is answered") {
    CHECK(has(told("M0"), "//action:prompt_begin M0 Stop\n//action:prompt_button Continue\n"));
    CHECK(has(told("M108"), "//action:prompt_end\n"));
    CHECK(has(told("M1 Change the part", 3), "echo:Change the part\r\n"));
    CHECK(count(told("M876 S0", 0.2), "ok\n") == 2);
    CHECK(told("M0 S1", 1.2).ends_with("ok\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: the emergency parser acts on every line, numbered and damaged ones too") {
    say("M109 S200", Channel::host, 1);
    forget();
    say("N5 M108*999");
    CHECK(has(said(), "Error:Line Number"));
    CHECK(heard_by_host().ends_with("ok\n"));
    say("G4 S10");
    say("M1120");
    CHECK(has(said(), "Error:Printer halted. kill() called!\n//action:poweroff\n"));
    CHECK(told("M105", 5).empty());
}

TEST_CASE_FIXTURE(Marlin, "Marlin: a broken heater kills") {
    say("M104 S200", Channel::main, 5);
    forget();
    CHECK(board().machine().faults.add(board().time(),
                                       machine::default_request(*machine::find_fault("heater_dead"))) != 0);
    run_for(120);
    CHECK(has(
        said(),
        "Error:Heating failed, system stopped! Heater_ID: E0\n\necho:Heating Failed\nError:Printer halted. "
        "kill() called!\n"));
    CHECK(told("M105").empty());
}

TEST_CASE("Marlin: what it was built with is a setting of the profile") {
    MarlinBench old("marlin-1.1");
    CHECK(old.told("M82") == "ok\n");
    old.say("M110 N4");
    old.forget();
    const std::string line = "N4 M82*" + std::to_string(protocol::xor_checksum("N4 M82"));
    CHECK(old.told(line) == "Error:Line Number is not Last Line Number+1, Last Line: 4\nResend: 5\nok\n");
    CHECK(old.told("M220") == "ok\n");
    CHECK(has(old.told("M503"), "echo:Steps per unit:\necho:  M92 X80.00"));
    CHECK(has(old.told("M115"), "FIRMWARE_NAME:Marlin 1.1.9 (Github) SOURCE_CODE_URL:https://"));
    CHECK(old.told("M154 S1") == "echo:Unknown command: \"M154 S1\"\nok\n");
    MarlinBench ender("ender-3");
    CHECK(ender.told("M92") == "  M92 X80.00 Y80.00 Z400.00 E93.00\nok\n");
    CHECK(has(ender.told("M115"), "MACHINE_TYPE:Ender-3 Pro "));
    CHECK(has(ender.told("M115"), "Cap:AUTOLEVEL:0\n"));
    CHECK(ender.told("G29") == "echo:Unknown command: \"G29\"\nok\n");
    MarlinBench prusa("prusa-mk3");
    CHECK(has(prusa.told("M115"), "FIRMWARE_NAME:Prusa-Firmware"));
    CHECK(prusa.told("M105") == "ok T:22.0 /0.0 B:22.0 /0.0 T0:22.0 /0.0 @:0 B@:0\n");
}

TEST_CASE("Marlin: what its output had no room for goes on as soon as there is room") {
    MarlinBench bench;
    board::Board& board = bench.board();
    board.connect(board::Channel::host, true);
    const auto at = [&bench](double seconds) { return machine::from_seconds(bench.now() + seconds); };
    std::string all = "G4 P100\n";
    for (int i = 0; i < 300; ++i) {
        all += "M503\n";
    }
    board.clear_output();
    board.receive(at(0), all, board::Channel::host);
    std::ptrdiff_t answers = 0;
    for (machine::SimTime due{0}; due <= at(0.2);) {
        due = board.advance(at(0.2));
        const std::string_view said = board.output(board::Channel::host);
        answers += count(std::string(said), "ok\n");
        board.clear_output();
    }
    CHECK(answers == 301);
}
