// The USB side: what a PC's G-code makes the board tell its screen.

#include <doctest/doctest.h>

#include "protocol/framing.h"
#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

void get_ready(BoardDriver& driver) {
    driver.run_until(1);
    driver.meet_screen();
    driver.run_to_quiet();
}

std::vector<std::string> after(BoardDriver& driver, const char* line) {
    driver.run_to_quiet();
    const double from = driver.now();
    driver.host(line);
    driver.run_for(0.2);
    return driver.bodies(from);
}

}  // namespace

TEST_CASE("host: M117 is passed on with its leading blank, so that two blanks stand behind L14") {
    BoardDriver driver;
    get_ready(driver);
    CHECK(join(after(driver, "M117 Layer 1/21")) == "L14  Layer 1/21\n");
    CHECK(join(after(driver, "M117")) == "L14 \n");
    CHECK(join(after(driver, "M117 a*b")) == "L14  a*b\n");
}

TEST_CASE("host: commands are executed without a word to the screen, which learns of them by the schedule") {
    BoardDriver driver;
    get_ready(driver);
    for (const char* line : {"M104 S200", "M140 S50", "M165 A0 B1 C0", "G28"}) {
        CAPTURE(line);
        CHECK(after(driver, line).empty());
    }
    CHECK(driver.number("heaters.nozzle.target") == 200);
    CHECK(driver.number("heaters.bed.target") == 50);
    driver.run_for(10);
    CHECK(driver.matching("L22 MS:0 MR:25600").size() == 1);
}

TEST_CASE("host: M290 is announced to the screen once homed, refused without a word before") {
    BoardDriver driver;
    get_ready(driver);
    CHECK(after(driver, "M290 Z0.1").empty());
    driver.press("G28");
    driver.run_for(50);
    CHECK(join(after(driver, "M290 Z0.10")) == "L24 P5 A0.10\n");
    CHECK(join(after(driver, "M290 Z0")) == "L24 P5 A0.00\n");
}

TEST_CASE("host: a checksum is judged where there is one, whatever the screen's line demands") {
    BoardDriver driver;
    get_ready(driver);
    driver.host("M110 N6");
    const std::string right = "N7 M117 a*" + std::to_string(protocol::xor_checksum("N7 M117 a"));
    CHECK(join(after(driver, right.c_str())) == "L14  a\n");
    CHECK(after(driver, "N8 M117 b*1").empty());
    CHECK(driver.board().counters().bad_frames == 1);
}

TEST_CASE("host: codes that only the screen may send are unknown on the USB side") {
    BoardDriver driver;
    get_ready(driver);
    CHECK(after(driver, "M2134 FW:PC").empty());
    CHECK(driver.text("screen.firmware") == "V1.02.xx");
    CHECK(driver.board().counters().unknown_codes == 1);
}

TEST_CASE("host: lines of both sides are told apart") {
    BoardDriver driver;
    get_ready(driver);
    driver.feed("N-0 M10");
    driver.host("M117 between");
    driver.feed("5*10\r\n");
    driver.run_for(0.2);
    CHECK(driver.matching("L14  between").size() == 1);
    const auto& received = driver.received();
    REQUIRE(received.size() >= 2);
    CHECK(received.back().line == "N-0 M105*10");
    CHECK(received.back().channel == board::Channel::main);
    CHECK(received[received.size() - 2].channel == board::Channel::host);
}
