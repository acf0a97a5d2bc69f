// The life of a print job as the screen sees it.

#include <doctest/doctest.h>

#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

void get_ready(BoardDriver& driver) {
    driver.run_until(1);
    driver.meet_screen();
    driver.press("M23 testpattern.gcode");
    driver.run_for(1);
    driver.run_to_quiet();
}

std::string l3(int status, const std::string& rest) {
    return "L3 PS:" + std::to_string(status) + " VL:0 MT:" + rest;
}

bool any_starts(const std::vector<std::string>& bodies, const std::string& start) {
    return std::any_of(bodies.begin(), bodies.end(),
                       [&](const std::string& body) { return body.starts_with(start); });
}

}  // namespace

TEST_CASE("job: PS goes 0, 1, 2, 1, 0 through start, pause, resume and stop") {
    BoardDriver driver;
    get_ready(driver);
    CHECK(driver.number("job.status") == 0);
    CHECK(any_starts(driver.ask("M2101", 0.15), l3(0, "0")));
    driver.run_to_quiet();

    const double start = driver.now();
    driver.press("M24");
    driver.run_for(0.2);
    const auto started = driver.between(start, start + 0.2);
    REQUIRE(started.size() == 2);
    CHECK(started[0].line == "Start Print:SD1:/testpattern.gcode");
    CHECK(started[1].body ==
          "L3 PS:1 VL:0 MT:0 FT:0 AL:1 ST:1 WF:0 MR:100 FN:testpattern.gcode PG:0 TM:0 LA:0 LC:0");
    driver.run_for(10.5);
    driver.run_to_quiet();
    const int printed = static_cast<int>(driver.now() - start);
    CHECK(any_starts(driver.ask("M2101", 0.15),
                     l3(1, "1 FT:0 AL:1 ST:1 WF:0 MR:100 FN:testpattern.gcode PG:" +
                               std::to_string(static_cast<int>(driver.number("job.progress"))) +
                               " TM:" + std::to_string(printed) + " ")));

    const double pause = driver.now();
    driver.press("M25");
    driver.run_for(0.2);
    CHECK(any_starts(driver.bodies(pause), l3(1, "1")));  // on its way to park
    driver.run_for(60);                                   // homing, under way, comes to its end first
    CHECK(any_starts(driver.bodies(pause), l3(2, "1")));
    CHECK(driver.number("job.status") == 2);
    CHECK(driver.number("motion.busy") == 0);
    CHECK(driver.number("position.y") == 300);
    const double rested = driver.number("job.seconds");
    driver.run_for(30);
    CHECK(driver.number("job.seconds") == rested);  // a pause does not count

    driver.run_to_quiet();
    const auto resumed = driver.ask("M24", 0.2);
    CHECK(any_starts(resumed, l3(1, "1")));
    CHECK_FALSE(any_starts(resumed, "raw:Start Print"));

    driver.press_all({"M104 S200", "M140 S50"});
    driver.run_for(1);
    const double stop = driver.now();
    driver.press("M2103");
    driver.run_for(0.2);
    const auto stopped = driver.between(stop, stop + 0.2);
    REQUIRE(stopped.size() >= 2);
    CHECK(stopped[0].line == "Stop Print");
    CHECK(any_starts(driver.bodies(stop), l3(0, "1")));
    CHECK(driver.number("job.status") == 0);
    CHECK(driver.number("heaters.nozzle.target") == 0);
    CHECK(driver.number("heaters.bed.target") == 0);
    const auto after = driver.matching("L3", stop);
    REQUIRE(!after.empty());
    CHECK(after.back().body.find(" FN:testpattern.gcode PG:0 ") != std::string::npos);
}

TEST_CASE("job: a pause asked for again while the first is under way gets the frame without checksum") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M24");
    driver.run_for(5);
    driver.press("M25");
    driver.run_for(0.15);
    REQUIRE(driver.number("job.pausing") == 1);
    const std::size_t before = driver.bytes().size();
    driver.press("M25");
    driver.run_for(0.15);
    CHECK(driver.bytes().substr(before) == "N-0 L14 Pausing... please try again later.*\r\n");
    driver.run_for(60);
    CHECK(driver.number("job.status") == 2);
    driver.run_to_quiet();
    CHECK(any_starts(driver.ask("M25", 0.2), l3(2, "1")));  // paused already: only the status
}

TEST_CASE("job: a stop while it pauses ends it, and no pause comes after") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M24");
    driver.run_for(5);
    driver.press_all({"M25", "M2103"});
    driver.run_for(30);
    CHECK(driver.number("job.status") == 0);
    CHECK(driver.number("job.pausing") == 0);
    CHECK(driver.matching("L3 PS:2").empty());
}

TEST_CASE("job: finished is PS:4 with PG:100, and what the job was shows for a while") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M24");
    driver.run_for(5.5);
    driver.world("job finished");
    driver.run_for(10);
    const auto l3s = driver.matching("L3 PS:4");
    REQUIRE(!l3s.empty());
    CHECK(l3s[0].body.find(" FN:testpattern.gcode PG:100 TM:5 ") != std::string::npos);
    driver.run_to_quiet();
    CHECK(join(driver.ask("M27", 0.15)) == "raw:SD printing byte 0/0\n");
}

TEST_CASE("job: M24 twice starts once") {
    BoardDriver driver;
    get_ready(driver);
    driver.press_all({"M24", "M24"});
    driver.run_for(1);
    CHECK(driver.matching("raw:Start Print").size() == 1);
}

TEST_CASE("job: while one is active, manual leveling is refused") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M24");
    driver.run_for(1);
    driver.run_to_quiet();
    for (const char* request : {"M2107 S0", "M2107 S1", "M2107 S4"}) {
        const auto replies = driver.ask(request, 0.15);
        CHECK(join(replies) == "raw:M2107 fail\nL10 S8.00\n");
    }
    CHECK(driver.number("leveling.manual") == 0);
}

TEST_CASE("job: a frame never names a file without a progress behind it") {
    BoardDriver driver("geeetech-a30");
    get_ready(driver);
    driver.press_all({"M24", "M25", "M24", "M2103"});
    driver.run_for(30);
    for (const auto& line : driver.matching("L3")) {
        const std::size_t name = line.body.find(" FN:");
        REQUIRE(name != std::string::npos);
        CHECK(line.body.find(" PG:", name + 4) != std::string::npos);
    }
}
