// The A30's own board: what it does that the A30T's does not. Each case is a part of what its program was
// seen or read to do.

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "tests/support/board_driver.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

struct MemoryStore final : machine::JobPlaceStore {
    std::optional<std::string> place;
    std::optional<std::string> load() override { return place; }
    void keep(std::string_view now) override { place = now; }
    void drop() override { place.reset(); }
};

/// A disk whose entries have dates, the later the higher their number.
class DatedDisk final : public machine::Volume {
  public:
    std::vector<std::string> names;
    bool list(std::string_view, std::vector<machine::CardEntry>& out) const override {
        for (std::size_t i = 0; i < names.size(); ++i) {
            const bool folder = names[i].ends_with('/');
            machine::CardEntry entry{names[i].substr(0, names[i].size() - (folder ? 1 : 0)), folder, 7};
            entry.modified_s = static_cast<std::int64_t>(i);
            out.push_back(std::move(entry));
        }
        return true;
    }
    Kind look(std::string_view path, std::uint64_t& bytes) const override {
        bytes = 7;
        return std::find(names.begin(), names.end(), path) == names.end() ? Kind::missing : Kind::file;
    }
    std::optional<std::size_t> read(std::string_view, std::uint64_t offset,
                                    std::span<char> out) const override {
        return std::string_view("G4 S30\n")
            .substr(std::min<std::size_t>(offset, 7))
            .copy(out.data(), out.size());
    }
};

/// The A30's board with a file on its card, past its boot.
struct A30 {
    MemoryDisk disk;
    MemoryStore store;
    std::optional<BoardDriver> driver;

    /// A file that takes some ten minutes.
    static std::string long_file() {
        std::string out = "G28\nG1 X100 Y100 Z5 F3000\n";
        for (int i = 0; i < 30; ++i)
            out += i % 2 == 0 ? "G1 X10 F300\n" : "G1 X100\n";
        return out;
    }
    explicit A30(const std::string& file = long_file()) {
        disk.put("part.gcode", file);
        power_on();
    }
    void power_on() {
        BoardDriver::Setup setup;
        setup.services.sd = &disk;
        setup.services.job_place = &store;
        driver.emplace("geeetech-a30", setup);
        driver->run_until(2);
        say("M2134 FW:Vx.37.xx");
        driver->run_until(4);
    }
    void say(const std::string& line) { driver->feed(line + "\r\n"); }
    /// All that is said within `seconds` from now, a line each, but for the schedule's L1 and L2.
    std::string after(const std::string& line, double seconds) {
        const double from = driver->now();
        say(line);
        driver->run_for(seconds);
        return talk(from);
    }
    std::string talk(double from) const {
        std::string out;
        for (const auto& one : driver->between(from, 1e9)) {
            out += one.line + '\n';
        }
        return out;
    }
    void start() {
        say("M23 part.gcode");
        driver->run_for(0.2);
        say("M24");
        driver->run_for(0.2);
        REQUIRE(driver->number("job.status") == 1);
    }
    std::string last(std::string_view start) const {
        const auto all = driver->matching(start);
        return all.empty() ? "" : all.back().line;
    }
};

bool holds(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("A30: the ring holds 199 bytes, a line 95, the store 20, and one line a tick is carried out") {
    A30 a30;
    BoardDriver& driver = *a30.driver;
    // 34 requests of 6 bytes: the ring is full within the last; 20 can wait.
    std::string burst;
    for (int i = 0; i < 34; ++i)
        burst += "M105\r\n";
    double from = driver.now();
    driver.feed(burst);
    driver.run_for(3);
    CHECK(driver.matching("L2 ", from).size() == 20);
    CHECK(driver.board().counters().bytes_lost == 34 * 6 - 199);
    driver.feed("\r\n");  // of the 34th the first byte was not lost
    driver.run_for(0.1);
    // A line of 95 is cut, and the rest is the next one.
    const std::string talk = a30.after("M105 " + std::string(90, 'x') + "M114", 0.5);
    CHECK(holds(talk, "L2 "));
    CHECK(holds(talk, "L1 "));
    // 50 ms apart.
    from = driver.now();
    driver.feed("M105\r\nM2101\r\nM2120 P5\r\n");
    driver.run_for(0.5);
    const auto lines = driver.between(from, driver.now());
    REQUIRE(lines.size() == 3);
    CHECK(lines[1].at - lines[0].at == doctest::Approx(0.05).epsilon(0.01));
    CHECK(lines[2].at - lines[1].at == doctest::Approx(0.05).epsilon(0.01));
}

TEST_CASE(
    "A30: behind a NUL the first line is lost; a comment, small letters and what it does not know are "
    "nothing") {
    A30 a30;
    BoardDriver& driver = *a30.driver;
    const double from = driver.now();
    driver.feed(std::string("log A30 LCD OK\r\n\0", 17) + "M105\r\n");
    driver.run_for(0.3);
    CHECK(a30.talk(from) == "");
    CHECK(holds(a30.after("M105", 0.3), "L2 "));
    for (const char* line :
         {"m105",     "; M105",   "L1 S2", "L101",    "log M",        "G4M105",     "T0 M105",  "M112",
          "M108",     "M0",       "M22",   "M165 A1", "M290 Z0.1",    "M2135 P100", "M2140 S3", "M2132 P2",
          "M2133 S1", "M2115 S0", "M9999", "*",       "x:160,y:120;", "M27"}) {
        CAPTURE(line);
        CHECK(a30.after(line, 0.3) == "");
        driver.run_to_quiet();
    }
    CHECK(holds(a30.after("N1 M105", 0.3), "L2 "));
    CHECK(a30.after("M23 part.Gcode", 0.3) == "erro1\n");  // an ending that it does not know
}

TEST_CASE("A30: a command works until it is done, and nothing leaves meanwhile") {
    A30 a30;
    BoardDriver& driver = *a30.driver;
    const double from = driver.now();
    driver.feed("G28\r\nM105\r\n");
    driver.run_for(5);
    CHECK(driver.matching("L2 ", from).empty());
    driver.run_for(60);
    const auto homed = driver.matching("L1 ", from);
    const auto asked = driver.matching("L2 ", from);
    REQUIRE(!homed.empty());
    REQUIRE(!asked.empty());
    CHECK(asked.front().at > from + 20);
    CHECK(driver.matching("L12").empty());
    const std::string level = a30.after("M2107 S1", 60);
    CHECK(holds(level, "M2107 ok\n"));
    CHECK(level.find("M2107 ok\n") < level.find("L10 S"));
    CHECK(holds(a30.after("M2107 S0", 120), "M2107 Z:0.00\n"));
}

TEST_CASE("A30: a command during a print is carried out between two of its moves, not behind its end") {
    std::string text = "G28\n";
    for (int i = 0; i < 3000; ++i) {
        text += i % 2 == 0 ? "G1 X10 F6000\n" : "G1 X100\n";
    }
    A30 a30(text);
    BoardDriver& driver = *a30.driver;
    a30.start();
    driver.run_for(120);
    const double from = driver.now();
    const double byte = driver.number("job.byte");
    REQUIRE(driver.number("job.status") == 1);
    driver.feed("G29\r\nM2108\r\nM105\r\n");
    driver.run_for(90);
    CHECK_FALSE(driver.matching("L2 ", from).empty());
    CHECK(driver.number("job.status") == 1);
    CHECK(driver.number("job.byte") > byte + 100);
    driver.run_for(3600);
    CHECK(driver.number("job.status") == 0);
}

TEST_CASE("A30: M114 waits for moves, whoever asked for them, and not for heat") {
    A30 a30;
    BoardDriver& driver = *a30.driver;
    driver.host("M109 S100");
    driver.run_for(10);
    CHECK(holds(a30.after("M114", 0.3), "L1 "));
    driver.run_for(300);
    driver.host("G28");
    driver.run_for(1);
    CHECK(a30.after("M114", 5) == "");
    // What comes by the network meanwhile is answered there, and takes nothing from it.
    std::string answer;
    driver.board().receive_datagram(machine::from_seconds(driver.now()), 1, "M114");
    driver.board().take_datagrams([&](std::uint64_t, std::string_view bytes) { answer += bytes; });
    CHECK(holds(answer, "L1 "));
    const double from = driver.now();
    driver.run_for(60);
    CHECK(driver.matching("L1 ", from).size() >= 1);
    CHECK(holds(a30.after("M105", 0.3), "L2 "));
}

TEST_CASE(
    "A30: the list is of the 32 newest files, without folders, names over 43 characters by their 8.3 name") {
    DatedDisk disk;
    const std::string name43 = std::string(37, 'n') + ".gcode";
    const std::string name44 = std::string(38, 'm') + ".gcode";
    for (int i = 0; i < 40; ++i)
        disk.names.push_back("part" + std::to_string(i) + ".gcode");
    disk.names.insert(disk.names.end(),
                      {"folder/", "readme.txt", "short.g", name43, name44, "Last Of All.GCO"});
    BoardDriver::Setup setup;
    setup.services.sd = &disk;
    BoardDriver driver("geeetech-a30", setup);
    driver.run_until(0.7);
    const auto list = driver.matching("L7 ");
    REQUIRE(list.size() == 34);
    CHECK(list[0].line == "L7 begin file list:0");
    CHECK(list[1].line == "L7 P0 Last Of All.GCO");
    CHECK(list[2].line == "L7 P1 MMMMMM~1.GCO");
    CHECK(list[3].line == "L7 P2 " + name43);
    CHECK(list[4].line == "L7 P3 part39.gcode");
    CHECK(list[32].line == "L7 P31 part11.gcode");
    CHECK(list[33].line == "L7 end file list:0");
    driver.run_until(4);
    CHECK(driver.matching("L7 begin").size() == 2);  // the card's detector has it read in once more
    driver.feed("M23 mmmmmm~1.gco\r\n");
    driver.run_for(0.3);
    CHECK(driver.matching("raw:file select succd!:mmmmmm~1.gco").size() == 1);
    driver.feed("M24\r\n");
    driver.run_for(0.3);
    CHECK(driver.matching("raw:Start Print:SD1:/MMMMMM~1.GCO").size() == 1);
    CHECK(holds(driver.matching("L3 PS:1").back().line, " FN:MMMMMM~1.GCO PG:"));
}

TEST_CASE("A30: print, pause, resume, end: what is said, and that the file's name and its time stay") {
    A30 a30;
    BoardDriver& driver = *a30.driver;
    a30.start();
    CHECK(driver.matching("raw:Start Print:SD1:/part.gcode").size() == 1);
    driver.run_for(60);
    const double paused = driver.now();
    const std::string pause = a30.after("M25", 0.4);
    CHECK(pause.starts_with("Stop Print\nL3 PS:2 VL:0 MT:1 FT:0 AL:1 ST:1 WF:1 FN:part.gcode PG:"));
    CHECK(holds(pause, "\nL2 "));
    driver.run_for(60);
    CHECK(driver.number("job.status") == 2);
    CHECK(driver.matching("L3 PS:2", paused).size() >= 2);
    CHECK(driver.number("position.x") == 0);
    CHECK(a30.after("M25", 0.3).starts_with("L3 PS:2 "));
    a30.driver->world("filament in");
    driver.run_to_quiet();
    const std::string resume = a30.after("M24", 0.4);
    CHECK(resume.find("L14 Print recovery...\nL18 P3 S0\nL3 PS:3 ") != std::string::npos);
    const double end = driver.now() + 1500;
    while (driver.number("job.status") != 1 && driver.now() < end)
        driver.run_for(0.5);
    REQUIRE(driver.number("job.status") == 1);
    CHECK(driver.matching("L3 PS:1", paused).size() >= 1);
    while (driver.number("job.ending") == 0 && driver.now() < end)
        driver.run_for(0.5);
    const double ending = driver.now();
    driver.run_for(60);
    CHECK(driver.number("motors.enabled") == 0);
    CHECK(driver.number("job.ending") == 0);
    const auto status = driver.matching("L3 ", ending);
    REQUIRE(status.size() > 3);
    CHECK(holds(status.front().line, " PG:100 "));
    CHECK(status.back().line.starts_with("L3 PS:0 VL:0 MT:0 FT:1 AL:1 ST:1 WF:1 FN:part.gcode PG:0 TM:"));
    CHECK(!holds(status.back().line, " TM:0 "));
    CHECK(driver.matching("L3 PS:4").empty());
    CHECK(a30.after("M24", 0.3) == "");  // the choice is used up
}

TEST_CASE(
    "A30: M2103 stops a print by the same sequence as its end: heaters and fan off, Z up, home, motors off") {
    A30 a30("G28\nM104 S200\nM106 S255\nG1 X100 Y100 Z5 F3000\nG4 S600\n");
    BoardDriver& driver = *a30.driver;
    a30.start();
    driver.run_for(80);
    const double from = driver.now();
    a30.say("M2103");
    driver.run_for(1);
    CHECK(driver.matching("raw:Stop Print", from).empty());
    CHECK(driver.number("heaters.nozzle.target") == 0);
    CHECK(driver.number("fans.part") == 0);
    driver.run_for(60);
    CHECK(driver.number("position.x") == 0);
    CHECK(driver.number("position.z") > 10);
    CHECK(driver.number("motors.enabled") == 0);
    CHECK(a30.last("L3 ").starts_with("L3 PS:0 VL:0 MT:0 "));
    CHECK_FALSE(a30.store.place);
}

TEST_CASE(
    "A30: a saved job is PS:2 at power-on and nothing else; M24 takes it up, M2103 drops it, M2130 does "
    "nothing") {
    A30 a30;
    a30.start();
    a30.driver->run_for(80);
    REQUIRE(a30.store.place);
    a30.power_on();
    CHECK(a30.driver->matching("L3 ").front().line.starts_with(
        "L3 PS:2 VL:0 MT:0 FT:0 AL:1 ST:1 WF:1 FN:part.gcode PG:"));
    CHECK(a30.driver->matching("L16").empty());
    CHECK(a30.driver->matching("L18").empty());
    CHECK(a30.driver->matching("L14").empty());
    CHECK(a30.after("M2130 P0 S1", 0.5) == "");
    CHECK(a30.after("M24", 0.3).find("L3 PS:2 ") != std::string::npos);  // without filament
    CHECK(a30.last("L18") == "L18 P26 S0");
    a30.driver->world("filament in");
    a30.say("M24");
    a30.driver->run_for(100);
    CHECK(a30.driver->number("job.status") == 1);
    a30.power_on();
    CHECK(a30.driver->number("job.status") == 2);
    a30.say("M2103");
    a30.driver->run_for(60);
    CHECK(a30.driver->number("job.status") == 0);
    a30.power_on();
    CHECK(a30.driver->matching("L3 ").front().line.starts_with("L3 PS:0 "));
}

TEST_CASE("A30: the file of a saved job is gone: dropped the first time, asked for once M2130 came") {
    for (const bool answered : {false, true}) {
        A30 a30;
        a30.start();
        a30.driver->run_for(80);
        a30.disk.put("part.gcode", "another\n");
        a30.power_on();
        a30.driver->world("filament in");
        if (answered) a30.after("M2130 P0 S1", 0.3);
        const std::string talk = a30.after("M24", 0.5);
        CHECK(holds(talk, "L18 P26 S1\n"));
        CHECK(holds(talk, answered ? "L16 P0 S15\n" : "L16 P0 S255\n"));
        CHECK(a30.driver->number("job.status") == (answered ? 2 : 0));
        if (answered) {
            CHECK(holds(a30.after("M2130 P0 S0", 0.5), "L16 P0 S255\n"));
            CHECK(a30.driver->number("job.status") == 0);
        }
    }
}

TEST_CASE("A30: filament out, card out, and M502 with its two restarts of the screen") {
    A30 a30;
    BoardDriver& driver = *a30.driver;
    driver.world("filament in");
    a30.start();
    driver.run_for(80);
    double from = driver.now();
    driver.world("filament out");
    driver.run_for(0.4);
    const std::string out = a30.talk(from);
    CHECK(out.starts_with("Stop Print\nL3 PS:2 "));
    CHECK(out.find("L18 P26 S0\n") < out.find("\nL2 "));
    from = driver.now();
    driver.world("card out");
    driver.run_for(3);
    CHECK(driver.matching("L18 P26 S8", from).size() == 1);
    CHECK(holds(driver.matching("L2 ", from).front().line, " SD:1 "));
    CHECK(driver.matching("L7 begin", from).size() == 1);
    CHECK(driver.matching("L7 P", from).empty());
    CHECK(a30.after("M23 part.gcode", 0.3) == "");
    driver.run_to_quiet();
    CHECK(a30.after("M20 LCD", 0.3) == "SD: fail\n");

    A30 fresh;
    from = fresh.driver->now();
    fresh.say("M502");
    fresh.driver->run_for(3);
    const auto restarts = fresh.driver->matching("L16 P1 S0", from);
    REQUIRE(restarts.size() == 2);
    CHECK(restarts[1].at - restarts[0].at == doctest::Approx(0.5).epsilon(0.02));
    CHECK(fresh.driver->number("screen.known") == 0);
}

TEST_CASE(
    "A30: loading says L1 every 200 ms and no L12; the board's fan and the motors look after themselves") {
    A30 a30;
    BoardDriver& driver = *a30.driver;
    const double from = driver.now();
    a30.say("M2105 S2");
    driver.run_for(3);
    a30.say("M2105 S4");
    driver.run_for(1);
    CHECK(driver.matching("L1 ", from).size() >= 14);
    CHECK(driver.matching("L1 ", from).size() <= 17);
    CHECK(driver.matching("L12").empty());
    CHECK(driver.number("motors.enabled") == 1);
    driver.run_for(130);
    CHECK(driver.number("motors.enabled") == 0);
    CHECK(driver.number("fans.board") == 71);
    a30.say("M104 S60");
    driver.run_for(0.3);
    CHECK(driver.number("fans.board") == 100);
    a30.say("M106 P2 S128");
    driver.run_for(0.3);
    CHECK(driver.number("fans.board") == 50);
    a30.say("M104 S0");
    driver.run_for(0.3);
    CHECK(driver.number("fans.board") == 71);
}

TEST_CASE("A30: no heater that is well is called faulty, whatever it is to reach") {
    for (const int nozzle : {40, 60, 100, 150, 170, 180, 185, 190, 195, 200, 205, 210, 220, 230, 240}) {
        CAPTURE(nozzle);
        A30 a30;
        BoardDriver& driver = *a30.driver;
        a30.say("M140 S" + std::to_string(std::min(110, nozzle / 2)));
        driver.run_for(60);
        a30.say("M104 S" + std::to_string(nozzle));
        driver.run_for(400);
        a30.say("M106 S255");
        driver.run_for(1200);
        CHECK(driver.matching("L18").empty());
        CHECK(driver.number("heaters.nozzle.target") == nozzle);
        CHECK(driver.number("heaters.bed.target") == std::min(110, nozzle / 2));
    }
}

TEST_CASE("A30: the layer is told by the nozzle's height, where the file says how high a layer is") {
    const std::string body = "LAYER_COUNT:40\nG28\nG1 Z0.2 F600\nG4 S20\nG1 Z0.3\nG4 S20\nG1 Z5.05\nG4 S20\n";
    A30 a30(";Layer height: 0.2\n;" + body);
    a30.start();
    const auto layer_at = [&a30](double z) {
        while (a30.driver->number("position.z") != doctest::Approx(z) && a30.driver->now() < 400) {
            a30.driver->run_for(1);
        }
        a30.driver->run_for(6);
        return a30.last("L3 PS:1");
    };
    CHECK(holds(layer_at(0.2), " LA:0 LC:40"));
    CHECK(holds(layer_at(0.3), " LA:1 LC:40"));
    CHECK(holds(layer_at(5.05), " LA:24 LC:40"));
    a30.driver->run_for(200);
    CHECK(holds(a30.last("L3 PS:0"), " LA:0 LC:0"));
    A30 other(";" + body);  // no height told: by the comments, of which there are none
    other.start();
    other.driver->run_for(120);
    CHECK(holds(other.last("L3 PS:1"), " LA:0 LC:40"));
}
