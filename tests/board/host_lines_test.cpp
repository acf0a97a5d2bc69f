// The USB side while the board does something else, and the lines that hosts really send: nothing is lost
// without a word, and each command has its ok.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "emulator/machine/memory_volume.h"
#include "protocol/framing.h"
#include "tests/support/board_driver.h"
#include "tests/support/printers.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

struct Bench {
    machine::MemoryVolume card{{{"SUB", true, {}, {{"DEEP", true, {}, {}}}}}};
    BoardDriver driver{"geeetech-a30t", {true, 1, {&card}}};

    Bench() { driver.finish_boot(); }

    void put(const std::string& name, const std::string& text) {
        REQUIRE(card.create(name));
        REQUIRE(card.append(name, 0, text));
    }
    /// What the board says to the host within `seconds` of these lines, which come together.
    std::string told(std::string_view lines, double seconds = 0.2) {
        const std::size_t before = driver.replies().size();
        driver.host(lines);
        driver.run_for(seconds);
        std::string out;
        for (std::size_t i = before; i < driver.replies().size(); ++i) {
            out += driver.replies()[i].line + "\n";
        }
        return out;
    }
    /// A print that keeps the planner full.
    void print_moves() {
        std::string moves = "G90\nG1 F600\n";
        for (int i = 0; i < 500; ++i) {
            moves += i % 2 == 0 ? "G1 X50\n" : "G1 X0\n";
        }
        put("moves.g", moves);
        told("M23 moves.g");
        told("M24");
        driver.run_for(10);
        REQUIRE(driver.number("job.status") == 1);
    }
};

std::ptrdiff_t oks(const std::string& talk) {
    std::ptrdiff_t count = talk.starts_with("ok") ? 1 : 0;
    for (std::size_t at = talk.find("\nok"); at != std::string::npos; at = talk.find("\nok", at + 1)) {
        ++count;
    }
    return count;
}

std::string with_sum(const std::string& line) {
    return line + "*" + std::to_string(protocol::xor_checksum(line));
}

}  // namespace

TEST_CASE_FIXTURE(Bench, "host lines: a host is answered at once while a file prints from the card") {
    print_moves();
    CHECK(told("M105").starts_with("ok T:"));
    CHECK(told("M27").starts_with("SD printing byte "));
    CHECK(told("M114").starts_with("X:"));
    CHECK(told("M115").starts_with("FIRMWARE_NAME:"));
    CHECK(told("M104 S60") == "ok\n");
    CHECK(told("M220 S100") == "ok\n");
    CHECK(driver.number("job.status") == 1);
    CHECK(told("M25") == "ok\n");
    driver.run_for(200);
    CHECK(driver.number("job.status") == 2);
    CHECK(told("M524") == "ok\n");
    CHECK(told("M27") == "Not SD printing\nok\n");
}

TEST_CASE_FIXTURE(Bench,
                  "host lines: M400 waits for the moves already planned, and the job goes on behind it") {
    print_moves();
    const double moves = driver.number("job.moves");
    const std::string talk = told("M400", 120);
    CHECK(talk.starts_with("echo:busy: processing\n"));
    CHECK(talk.ends_with("ok\n"));
    CHECK(oks(talk) == 1);
    CHECK(driver.number("job.moves") > moves);
    CHECK(driver.number("job.status") == 1);
}

TEST_CASE_FIXTURE(Bench, "host lines: a host's moves and the job's share the planner") {
    print_moves();
    const double moves = driver.number("job.moves");
    std::string lines;
    for (int i = 0; i < 20; ++i) {
        lines += i % 2 == 0 ? "G1 Y10 F6000\n" : "G1 Y0\n";
    }
    CHECK(oks(told(lines, 200)) == 20);
    CHECK(driver.number("job.moves") >= moves + 20);
}

TEST_CASE_FIXTURE(Bench, "host lines: the USB side lives in every other state as well") {
    SUBCASE("while the job dwells") {
        put("a.g", "G4 S1000\n");
    }
    SUBCASE("while the job heats") {
        put("a.g", "M109 S200\n");
    }
    SUBCASE("while the job homes") {
        put("a.g", "G28\n");
    }
    SUBCASE("while the job waits for its user") {
        put("a.g", "M0\n");
    }
    SUBCASE("while the job runs an arc") {
        put("a.g", "G1 X50 Y50 F6000\nG2 I20 J0 F60\n");
    }
    told("M23 a.g");
    told("M24", 3);
    CHECK(told("M105").find("ok T:") != std::string::npos);
    CHECK(told("M114").find("X:") != std::string::npos);
    CHECK(oks(told("M27")) == 1);
    CHECK(oks(told("M524")) == 1);
    CHECK(driver.number("job.status") == 0);
}

TEST_CASE_FIXTURE(Bench, "host lines: every command has its ok, also one that overtakes another") {
    CHECK(told("G4 S3\nM108", 1).empty());
    CHECK(oks(told("", 4)) == 2);
    const std::string heating = told("M109 S200\nM108", 1);
    CHECK(oks(heating) == 2);
    CHECK_FALSE(filament_printer(driver.machine()).wait.active());
    CHECK(oks(told("G28\nM410", 1)) == 2);
    CHECK(oks(told("G4 S2\nM105", 3)) == 2);
}

TEST_CASE_FIXTURE(Bench, "host lines: what does not fit into the board's queue waits outside, or is told") {
    for (const int count : {9, 12, 20, 300}) {
        CAPTURE(count);
        std::string lines = "G4 S3\n";
        for (int i = 0; i < count; ++i) {
            lines += "M105\n";
        }
        CHECK(oks(told(lines, 5)) == count + 1);
    }
    std::string flood = "G4 S3\n";
    for (int i = 0; i < 3000; ++i) {
        flood += "M105\n";
    }
    const std::string talk = told(flood, 50);
    const auto lost = static_cast<std::ptrdiff_t>(driver.board().counters().requests_lost);
    CHECK(lost > 0);
    CHECK(oks(talk) == 3001 - lost);
    CHECK(talk.find("Error:RX BUF overflow") != std::string::npos);
}

TEST_CASE_FIXTURE(Bench, "host lines: M112 kills, and nothing is heard or said afterwards") {
    CHECK(told("G4 S20\nM112\nM105", 30) == "Error:Printer halted. kill() called!\n");
    const std::size_t said = driver.lines().size();
    driver.press("M105");
    driver.run_for(20);
    CHECK(driver.lines().size() == said);
    driver.world("board reset");
    CHECK(told("M105").starts_with("start\n") == false);
    CHECK(driver.lines().size() > said);
}

TEST_CASE_FIXTURE(Bench, "host lines: a word is no code, whatever its first letter") {
    told("T1");
    for (const char* word :
         {"TIMELAPSE_TAKE_FRAME", "GET_POSITION", "MESH_CLEAR", "M", "Mx", "G", "T", "m105"}) {
        CAPTURE(word);
        CHECK(told(word) == "echo:Unknown command: \"" + std::string(word) + "\"\nok\n");
    }
    told("G92 E5");
    CHECK(driver.number("mixer.tool") == 1);
    CHECK(told("M114").find("E:5.00") != std::string::npos);
    CHECK(told("G 1 X10", 1) == "ok\n");
    CHECK(driver.number("position.x") == 10);
}

TEST_CASE_FIXTURE(Bench, "host lines: a word in a job's file is skipped and counted") {
    put("words.g", "T1\nTIMELAPSE_TAKE_FRAME\nG92 E5\nGET_POSITION\nMESH_CLEAR\ng28\nG4 S2\n");
    told("M23 words.g");
    told("M24", 1);
    CHECK(driver.number("job.unknown_codes") == 4);
    CHECK(driver.number("mixer.tool") == 1);
    CHECK(driver.number("position.e") == 5);
    driver.run_for(3);
    CHECK(driver.number("job.status") == 4);
}

TEST_CASE_FIXTURE(Bench, "host lines: M0 and M1 wait no longer than they are told to") {
    CHECK(told("M0 S1", 0.9).empty());
    CHECK(told("", 0.2) == "ok\n");
    CHECK(told("M1 P500", 0.4).empty());
    CHECK(told("", 0.2) == "ok\n");
    put("wait.g", "M0 S2\nM104 S50\nG4 S100\n");
    told("M23 wait.g");
    told("M24", 30);
    CHECK(driver.number("heaters.nozzle.target") == 50);
    CHECK(driver.number("job.status") == 1);
}

TEST_CASE_FIXTURE(Bench, "host lines: M220 and M221 without S report, B and R keep and take back") {
    CHECK(told("M220 S50") == "ok\n");
    CHECK(told("M220") == "FR:50%\nok\n");
    told("M220 S60\nM220 B\nM220 S100\nM220 R");
    CHECK(driver.number("speed.percent") == 60);
    told("M221 S80");
    CHECK(told("M221") == "echo:E0 Flow: 80%\nok\n");
    CHECK(driver.number("flow.percent") == 80);
}

TEST_CASE_FIXTURE(Bench, "host lines: M109 R and M190 R also wait for the heater to come down") {
    driver.heat_nozzle(100);
    told("M104 S100", 1);
    CHECK(oks(told("M109 R60", 5)) == 0);
    CHECK(oks(told("", 2000)) == 1);
    CHECK(driver.number("heaters.nozzle.printed") < 62);
    driver.heat_nozzle(100);
    CHECK(oks(told("M109 S60", 1)) == 1);
}

TEST_CASE_FIXTURE(Bench, "host lines: full circles run, arcs without a centre are told") {
    told("G90\nG92 X50 Y50\nG1 F600");
    for (const char* circle : {"G2 I10 J0", "G3 I10 J0", "G2 I-10", "G2 J10", "G3 J-10"}) {
        CAPTURE(circle);
        const double before = driver.now();
        CHECK(oks(told(std::string(circle) + "\nM400", 20)) == 2);
        CHECK(driver.replies().back().at - before == doctest::Approx(6.3).epsilon(0.1));
    }
    CHECK(told("G2 X60 Y50 I0 J0") == "Error:G2/G3 bad parameters\nok\n");
    CHECK(told("G2 X60 Y50") == "Error:G2/G3 bad parameters\nok\n");
    CHECK(told("G2 J15924972968424246021") == "Error:G2/G3 bad parameters\nok\n");
    CHECK(told("G3 R5") == "Error:G2/G3 bad parameters\nok\n");
    CHECK(told("G2 X60 Y50 R4", 5) == "ok\n");
    CHECK(driver.number("position.x") == 60);
}

TEST_CASE_FIXTURE(Bench, "host lines: M110 in all its forms") {
    CHECK(told("N0 M110N70*106") == "ok\n");
    CHECK(told("N71 M105*17").starts_with("ok T:"));
    CHECK(told("M110 N4") == "ok\n");
    CHECK(driver.number("host.last_line") == 4);
    CHECK(told(" N5 M105*34").starts_with("ok T:"));
    told("M110N-1");
    CHECK(driver.number("host.last_line") == -1);
    told(with_sum("N70 M110"));
    CHECK(driver.number("host.last_line") == 70);
    CHECK(told("M110") == "ok\n");
    CHECK(driver.number("host.last_line") == 70);
    CHECK(told("M110 N3N4 M211*37").find("ok\n") != std::string::npos);
}

TEST_CASE_FIXTURE(Bench, "host lines: one that is too long is answered") {
    told("M110 N0");
    CHECK(told("N1 M117 " + std::string(600, 'B') + "*5") ==
          "Error:No Checksum with line number, Last Line: 0\nResend: 1\nok\n");
    CHECK(told("M117 " + std::string(600, 'B')) == "ok\n");
    CHECK(oks(told("M105 ;" + std::string(600, ' '))) == 1);
}

TEST_CASE_FIXTURE(Bench,
                  "host lines: what came behind a bad line is thrown away with it, as the firmware does") {
    told("M110 N0");
    const std::string talk = told("N1 M105*1\n" + with_sum("N2 M105") + "\n" + with_sum("N3 M105"));
    CHECK(talk == "Error:checksum mismatch, Last Line: 0\nResend: 1\nok\n");
    CHECK(told(with_sum("N1 M105")).starts_with("ok T:"));
}

TEST_CASE_FIXTURE(Bench, "host lines: M113 sets when a waiting host is told so, and tells it") {
    CHECK(told("M113") == "echo:M113 S2\nok\n");
    CHECK(told("M113 S5") == "ok\n");
    CHECK(told("G4 S4", 4.5) == "ok\n");
    told("M113 S0");
    CHECK(told("G4 S20", 21) == "ok\n");
}

TEST_CASE_FIXTURE(Bench, "host lines: names on the card know no case, and may carry a size") {
    put("A.GCO", "G4 S5\n");
    put("long name.gcode", "G4 S5\n");
    CHECK(told("M23 a.gco").starts_with("File opened: A.GCO Size: 6\nFile selected\n"));
    CHECK(told("M23 a.gco 6").starts_with("File opened: A.GCO Size: 6\n"));
    CHECK(told("M23 Long Name.gcode").starts_with("File opened: long name.gcode Size: 6\n"));
    CHECK(told("M28 a.GCO").starts_with("Writing to file: a.GCO\n"));
    told("G1 X1");
    told("M29");
    CHECK(told("M20").find("A.GCO") == std::string::npos);
    CHECK(told("M30 A.gco") == "File deleted:A.gco\nok\n");
    CHECK(told("M23 a.gco").starts_with("open failed"));
}

TEST_CASE_FIXTURE(Bench, "host lines: M20 goes into the folders") {
    put("A.GCO", "1");
    put("SUB/B.GCO", "123");
    put("SUB/DEEP/C.GCO", "12");
    CHECK(told("M20") == "Begin file list\nA.GCO 1\nSUB/B.GCO 3\nSUB/DEEP/C.GCO 2\nEnd file list\nok\n");
    CHECK(told("M23 SUB/B.GCO").starts_with("File opened: SUB/B.GCO Size: 3\n"));
    CHECK(told("M23 /sub/deep/c.gco").starts_with("File opened: SUB/DEEP/C.GCO Size: 2\n"));
}

TEST_CASE_FIXTURE(Bench,
                  "host lines: a print that a host has paused can be ended by it, and another one begun") {
    put("a.gco", "G4 S100000\n");
    put("b.gco", "G4 S5\n");
    SUBCASE("by the next M23") {
        told("M23 a.gco");
        told("M24");
        told("M25");
        CHECK(told("M27").starts_with("SD printing byte "));
        told("M26 S0");
    }
    SUBCASE("while it prints") {
        told("M23 a.gco");
        told("M24");
    }
    SUBCASE("by M524") {
        told("M23 a.gco");
        told("M24");
        CHECK(told("M524") == "ok\n");
        CHECK(told("M27") == "Not SD printing\nok\n");
    }
    CHECK(told("M23 b.gco") == "File opened: b.gco Size: 6\nFile selected\nok\n");
    CHECK(told("M24") == "ok\n");
    const std::string byte = told("M27");
    CHECK(byte.find("/6\n") != std::string::npos);
    CHECK(told("", 10).find("Done printing file") != std::string::npos);
}

TEST_CASE_FIXTURE(Bench, "host lines: a layer number of Bambu Studio is one") {
    put("bambu.g",
        "; total layer number: 2\n; CHANGE_LAYER\n; Z_HEIGHT: 0.2\n; layer num/total_layer_count: 1/2\n"
        "G4 S5\n; CHANGE_LAYER\n; Z_HEIGHT: 0.4\n; layer num/total_layer_count: 2/2\nG4 S5\n");
    told("M23 bambu.g");
    told("M24", 1);
    CHECK(driver.number("job.layer") == 1);
    CHECK(driver.number("job.layers") == 2);
    driver.run_for(5);
    CHECK(driver.number("job.layer") == 2);
}
