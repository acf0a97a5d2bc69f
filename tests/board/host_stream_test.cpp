// The USB side as a host program knows it: acknowledgements, numbers, resends, waiting; and a whole print.

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/support/board_driver.h"
#include "tests/support/host_program.h"
#include "tests/support/printers.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

/// What the board says to the host within `seconds` of a line.
std::string told(BoardDriver& driver, std::string_view line, double seconds = 0.2) {
    const std::size_t before = driver.replies().size();
    driver.host(line);
    driver.run_for(seconds);
    std::string out;
    for (std::size_t i = before; i < driver.replies().size(); ++i) {
        out += driver.replies()[i].line + "\n";
    }
    return out;
}

struct Ready {
    BoardDriver driver;
    Ready() { driver.finish_boot(); }
};

}  // namespace

TEST_CASE_FIXTURE(Ready, "host stream: every command is acknowledged, with its answer before") {
    CHECK(told(driver, "M105") == "ok T:22.3 /0.0 B:22.0 /0.0 T0:22.3 /0.0 @:0 B@:0\n");
    CHECK(told(driver, "M104 S0") == "ok\n");
    CHECK(told(driver, "M114") == "X:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0.00 Y:0.00 Z:0.00\nok\n");
    CHECK(told(driver, "M27") == "Not SD printing\nok\n");
    CHECK(told(driver, "M20") ==
          "Begin file list\ntestpattern.gcode 109\nA30T/A30Tcube_colored.gco 93\nEnd file list\nok\n");
    CHECK(told(driver, "M115").find("FIRMWARE_NAME:Smartto") == 0);
    CHECK(told(driver, "M12345") == "echo:Unknown command: \"M12345\"\nok\n");
    CHECK(told(driver, "nonsense") == "echo:Unknown command: \"nonsense\"\nok\n");
    CHECK(told(driver, "; a remark").empty());
    CHECK(told(driver, "").empty());
}

TEST_CASE_FIXTURE(Ready, "host stream: what is wrong with a line is said, and the right one asked for") {
    CHECK(told(driver, "N0 M110 N0*125") == "ok\n");
    CHECK(told(driver, "N1 M104 S0*100") == "ok\n");
    CHECK(told(driver, "N1 M104 S0*100") ==
          "Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\n");
    CHECK(told(driver, "N2 M104 S0*97") == "Error:checksum mismatch, Last Line: 1\nResend: 2\nok\n");
    CHECK(told(driver, "N2 M104 S0") == "Error:No Checksum with line number, Last Line: 1\nResend: 2\nok\n");
    CHECK(told(driver, "M104 S0*32") == "Error:No Line Number with checksum, Last Line: 1\nResend: 2\nok\n");
    CHECK(driver.number("host.resends") == 4);
    CHECK(driver.number("host.last_line") == 1);
    CHECK(told(driver, "M110 N41") == "ok\n");
    CHECK(driver.number("host.next_line") == 42);
}

TEST_CASE_FIXTURE(Ready, "host stream: heating, homing and dwelling keep the host waiting, and tell it so") {
    driver.heat_nozzle(180);
    const std::string heating = told(driver, "M109 S190", 120);
    CHECK(heating.find("echo:busy: processing\n") != std::string::npos);
    CHECK(heating.find("T:1") != std::string::npos);
    CHECK(heating.ends_with("ok\n"));
    CHECK(std::count(heating.begin(), heating.end(), 'k') == 1);
    CHECK(told(driver, "G4 S3", 2.9) == "echo:busy: processing\n");
    CHECK(told(driver, "", 0.2) == "ok\n");
    const std::string homing = told(driver, "G28", 60);
    CHECK(homing.ends_with("ok\n"));
    CHECK(driver.replies().back().at - 3 > 20);
    CHECK(driver.number("motion.homed") == 1);
}

TEST_CASE_FIXTURE(Ready, "host stream: M108 and M112 reach the board while it waits") {
    CHECK(told(driver, "M109 S200", 5).find("ok") == std::string::npos);
    CHECK(told(driver, "M108").find("ok\n") != std::string::npos);
    CHECK_FALSE(filament_printer(driver.machine()).wait.active());
    CHECK(told(driver, "M190 S90", 5).find("ok") == std::string::npos);
    told(driver, "M112");
    CHECK_FALSE(filament_printer(driver.machine()).wait.active());
    CHECK(driver.number("heaters.bed.target") == 0);
    CHECK(told(driver, "M105").empty());
}

TEST_CASE_FIXTURE(Ready, "host stream: an M0 waits for the user at the screen") {
    CHECK(told(driver, "M0", 5).find("ok") == std::string::npos);
    CHECK(driver.matching("L18 P26 S15").size() == 1);
    driver.press("M108");
    driver.run_for(0.3);
    CHECK(driver.replies().back().line == "ok");
}

TEST_CASE_FIXTURE(Ready, "host stream: what a host sends ahead waits for its turn, in its order") {
    driver.host("N0 M110 N0*125");
    const double before = driver.number("host.commands");
    driver.host("G4 S1");
    for (int i = 0; i < 40; ++i) {
        driver.host("M106 S" + std::to_string(i));
    }
    driver.run_for(3);
    CHECK(driver.number("host.commands") - before == 41);
    CHECK(driver.board().counters().requests_lost == 0);
    CHECK(driver.number("fans.part") == 15);  // the last one's 39 of 255
    CHECK(told(driver, "M105").find("ok T:") == 0);
}

TEST_CASE_FIXTURE(Ready, "host stream: nobody at the other end costs nothing and keeps nothing") {
    driver.board().connect(board::Channel::host, false);
    driver.board().receive(machine::from_seconds(driver.now()), "M105\nM20\n", board::Channel::host);
    CHECK(driver.board().output(board::Channel::host).empty());
}

TEST_CASE("host stream: a whole print with damaged and lost lines: every move once, in order") {
    SlicedFile wishes;
    wishes.moves = 60'000;
    wishes.layers = 200;
    wishes.shape = SlicedFile::Shape::towers;
    const std::string file = make_sliced_file(wishes);
    BoardDriver driver;
    driver.finish_boot();
    HostProgram host(driver, {7, 20, 10});
    // The file's own M117 come through as they are.
    const std::string program = "M117 192.168.0.144\nG92 E0\n" + file;
    std::string expected_messages;
    for (std::size_t at = program.find("M117"); at != std::string::npos; at = program.find("M117", at + 1)) {
        expected_messages += "L14 " + program.substr(at + 4, program.find('\n', at) - at - 4) + "\n";
    }
    REQUIRE(std::count(expected_messages.begin(), expected_messages.end(), '\n') >= 200);
    std::size_t moves = 0;
    std::set<std::string> planned;
    const bool done = host.print(program, 1e6, [&](const std::string& command) {
        if (command[0] != 'G' || (command[1] != '0' && command[1] != '1') || command[2] != ' ') {
            return;
        }
        ++moves;
        const filament::AxisValues& at = filament_printer(driver.machine()).motion.planned();
        char text[64];
        std::snprintf(text, sizeof text, "X%.3f Y%.3f Z%.3f", at[0], at[1], at[2]);
        planned.insert(text);
        if (filament_printer(driver.machine()).motion.relative()) {
            return;  // the lift at the end of the file
        }
        // What was acknowledged last is what was planned last: no line was passed over and none came twice.
        CAPTURE(command);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t place = command.find(" XYZ"[axis + 1]);
            if (place != std::string::npos) {
                REQUIRE(at[axis] == doctest::Approx(std::stod(command.substr(place + 1))));
            }
        }
    });
    CHECK(done);
    CHECK(host.damaged() > 500);
    CHECK(host.lost() > 200);
    CHECK(host.resends() >= host.damaged() / 2);
    CHECK(moves > 60'000);
    CHECK(driver.number("host.moves") == moves);
    driver.run_for(60);
    // The screen's side, as in the recorded print: idle, messages as they are, positions that were planned.
    for (const BoardDriver::Line& line : driver.matching("L3 ")) {
        REQUIRE(line.body.starts_with("L3 PS:0 "));
    }
    std::string messages;
    for (const BoardDriver::Line& line : driver.matching("L14 ")) {
        messages += line.body + "\n";
    }
    CHECK(messages == expected_messages);
    const auto positions = driver.matching("L1 X");
    CHECK(positions.size() > 100);
    for (const BoardDriver::Line& line : positions) {
        const std::string place = line.body.substr(3, line.body.find(" F") - 3);
        if (place != "X0.000 Y0.000 Z0.000") {
            CAPTURE(line.body);
            REQUIRE(planned.contains(place));
        }
    }
}
