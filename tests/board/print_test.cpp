// Whole prints from the card, by the requests that the screens send around one.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/board_driver.h"
#include "tests/support/printers.h"
#include "tests/support/reference_time.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

/// A board with a file on its card, and a screen that has told its name.
struct Print {
    MemoryDisk disk;
    BoardDriver driver;

    explicit Print(const std::string& content, std::string_view profile = "geeetech-a30t")
        : driver(profile, setup(content)) {
        driver.run_until(2);
        driver.meet_screen();
        driver.run_to_quiet();
    }

    BoardDriver::Setup setup(const std::string& content) {
        disk.put("Part.gcode", content);
        BoardDriver::Setup made;
        made.services.sd = &disk;
        return made;
    }

    /// What the screen's start button sends.
    void start() {
        driver.press_all({"M23 Part.gcode", "M24", "M105", "M27"});
        driver.run_for(0.4);
    }

    /// The last L3 said.
    std::string l3() const {
        const auto all = driver.matching("L3 ");
        REQUIRE(!all.empty());
        return all.back().body;
    }
    static int field(const std::string& frame, const std::string& key) {
        const std::size_t at = frame.find(" " + key + ":");
        REQUIRE(at != std::string::npos);
        return std::stoi(frame.substr(at + key.size() + 2));
    }
    bool run_until_status(int status, double limit_s) {
        const double end = driver.now() + limit_s;
        while (driver.number("job.status") != status && driver.now() < end) {
            driver.run_for(0.5);
        }
        return driver.number("job.status") == status;
    }
};

std::string expected_l3(int status, int motors, const std::string& name, int progress, int seconds, int layer,
                        int layers) {
    return fmt::format("L3 PS:{} VL:0 MT:{} FT:0 AL:1 ST:1 WF:0 MR:100 FN:{} PG:{} TM:{} LA:{} LC:{}", status,
                       motors, name, progress, seconds, layer, layers);
}

}  // namespace

TEST_CASE(
    "print: started, paused, resumed and finished by the screen, every field of L3 right at each step") {
    SlicedFile wishes;
    wishes.moves = 3000;
    wishes.layers = 5;
    const std::string text = make_sliced_file(wishes);
    Print print(text);
    BoardDriver& driver = print.driver;
    const auto listed = driver.ask("M20 LCD", 0.15);
    REQUIRE(listed.size() == 3);
    CHECK(listed[1] == "L7 P0 Part.gcode");

    driver.run_to_quiet();
    const double start = driver.now();
    print.start();
    const auto said = driver.bodies(start);
    REQUIRE(said.size() >= 6);
    CHECK(said[0] == "raw:N-0 L14 file select succeed!:part.gcode");
    CHECK(said[1] == "raw:Start Print:SD1:/Part.gcode");
    CHECK(said[2] == expected_l3(1, 0, "Part.gcode", 0, 0, 0, 5));
    CHECK(said[3] == "L14  Layer 1");  // the file's first message
    CHECK(said[4].starts_with("raw:SD printing byte "));
    CHECK(said[4].ends_with("/" + std::to_string(text.size())));
    CHECK(said[5].starts_with("L2 "));

    driver.run_for(300);
    driver.run_to_quiet();
    const auto byte = static_cast<std::uint64_t>(driver.number("job.byte"));
    const int progress = static_cast<int>(byte * 100 / text.size());
    const int layer = static_cast<int>(driver.number("job.layer"));
    CHECK(progress > 0);
    CHECK(progress < 100);
    // The layer is that of the line read last.
    const std::size_t mark = text.rfind(";LAYER:", byte);
    CHECK(layer == std::stoi(text.substr(mark + 7)) + 1);
    const int printed = static_cast<int>(std::floor(driver.now() - start));
    const std::string running = driver.ask("M2101", 0.15).at(0);
    CHECK(Print::field(running, "TM") >= printed - 1);
    CHECK(Print::field(running, "TM") <= printed);
    CHECK(running == expected_l3(1, 1, "Part.gcode", progress, Print::field(running, "TM"), layer, 5));

    driver.press("M25");
    driver.run_for(0.2);
    CHECK(Print::field(print.l3(), "PS") == 1);  // finishing what is planned, then parking
    REQUIRE(print.run_until_status(2, 60));
    const std::string paused = print.l3();
    CHECK(paused.starts_with("L3 PS:2 VL:0 MT:1 "));
    driver.run_for(100);
    driver.run_to_quiet();
    CHECK(driver.ask("M2101", 0.15).at(0) == paused);
    CHECK(driver.number("position.y") == 300);

    driver.run_to_quiet();
    driver.press("M24");
    driver.run_for(0.2);
    CHECK(print.l3() == paused.substr(0, 3) + "PS:1" + paused.substr(7));
    REQUIRE(print.run_until_status(4, 100'000));
    driver.run_for(0.5);
    const std::string finished = print.l3();
    CHECK(finished == expected_l3(4, 0, "Part.gcode", 100, Print::field(finished, "TM"), 5, 5));
    driver.run_for(15);
    CHECK(print.l3() == expected_l3(0, 0, "Part.gcode", 0, 0, 0, 0));
    CHECK(driver.number("job.moves") >= 3000);

    int highest = 0;
    for (const auto& line : driver.matching("L3 PS:1")) {
        CHECK(Print::field(line.body, "PG") >= highest);
        highest = Print::field(line.body, "PG");
    }
    // One L14 for each layer's M117, with the two blanks of the recorded line.
    const auto messages = driver.matching("L14  Layer ");
    REQUIRE(messages.size() == 5);
    CHECK(messages.back().body == "L14  Layer 5");
}

TEST_CASE("print: the time of the whole job is within 5 % of the reference, whatever its character") {
    for (const auto shape :
         {SlicedFile::Shape::infill, SlicedFile::Shape::curves, SlicedFile::Shape::towers}) {
        CAPTURE(static_cast<int>(shape));
        SlicedFile wishes;
        wishes.shape = shape;
        wishes.moves = 5000;
        wishes.layers = 10;
        const std::string text = make_sliced_file(wishes);
        Print print(text);
        print.start();
        const double reference = reference_seconds(text, filament_printer(print.driver.machine()).settings);
        REQUIRE(print.run_until_status(4, reference * 2 + 100));
        CHECK(print.driver.number("job.seconds") == doctest::Approx(reference).epsilon(0.05));
    }
}

TEST_CASE(
    "print: L1 tells the destination of the last planned move; heating stops the schedule and prints L2") {
    Print print("M190 S40\nG1 X10 Y20 F3000\nG1 X200\nM400\n");
    BoardDriver& driver = print.driver;
    const double start = driver.now();
    print.start();
    driver.run_for(30);
    CHECK(driver.matching("L1 ", start).empty());
    const auto reports = driver.matching("L2 ", start + 1, start + 21);
    REQUIRE(reports.size() == 10);
    for (std::size_t i = 1; i < reports.size(); ++i) {
        CHECK(reports[i].at - reports[i - 1].at == doctest::Approx(2.0).epsilon(0.001));
    }
    REQUIRE(print.run_until_status(4, 600));
    const auto positions = driver.matching("L1 ", start);
    REQUIRE(!positions.empty());
    CHECK(positions[0].body == "L1 X200.000 Y20.000 Z0.000 F50");
}

TEST_CASE("print: a stop ends it, heaters off, and the file may be printed again") {
    Print print("M104 S200\nG1 X300 Y300 F600\nG1 X0\n");
    BoardDriver& driver = print.driver;
    print.start();
    driver.run_for(10);
    CHECK(driver.number("heaters.nozzle.target") == 200);
    driver.run_to_quiet();
    const auto said = driver.ask("M2103", 0.2);
    REQUIRE(said.size() >= 2);
    CHECK(said[0] == "raw:Stop Print");
    CHECK(said[1] == expected_l3(0, 1, "Part.gcode", 0, 0, 0, 0));
    CHECK(driver.number("heaters.nozzle.target") == 0);
    print.start();
    CHECK(driver.number("job.status") == 1);
}

TEST_CASE("print: a file that waits for the user goes on with M0, M108 or the resume button") {
    for (const std::string answer : {"M0", "M108", "M24"}) {
        CAPTURE(answer);
        Print print("G1 X10 F3000\nM0\nG1 X20\nG4 S20\n");
        BoardDriver& driver = print.driver;
        print.start();
        driver.run_for(5);
        CHECK(driver.matching("L18 P26 S15").size() == 1);
        CHECK(Print::field(print.l3(), "PS") == 2);
        driver.press(answer);
        driver.run_for(3);
        CHECK(driver.number("job.status") == 1);
        CHECK(driver.number("position.x") == 20);
    }
    Print a30("G1 X10 F3000\nM0\nG1 X20\n", "geeetech-a30");
    a30.start();
    a30.driver.run_for(5);
    CHECK(a30.driver.matching("L18").empty());  // page 15 resets that screen
    CHECK(Print::field(a30.l3(), "PS") == 2);
}

TEST_CASE("print: the card taken out pauses, put in again the job goes on") {
    std::string text;
    for (int i = 0; i < 100; ++i) {
        text += i % 2 == 0 ? "G1 X100 F3000\n" : "G1 X10\n";
    }
    Print print(text);
    BoardDriver& driver = print.driver;
    print.start();
    driver.run_for(5);
    const double out = driver.now();
    driver.world("card out");
    driver.run_for(60);
    CHECK(driver.matching("L18 P26 S1", out).size() == 1);
    CHECK(driver.matching("L18 P26 S3", out).empty());
    REQUIRE(driver.number("job.status") == 2);
    driver.world("card in");
    driver.run_for(1);
    CHECK(driver.matching("L7 P0 Part.gcode", out).size() == 1);
    driver.press("M24");
    driver.run_for(1);
    REQUIRE(print.run_until_status(4, 1000));
    CHECK(driver.number("job.moves") == 100);
}

TEST_CASE("print: a file that vanishes is told as missing") {
    std::string text = "G1 X100 F3000\nG4 S10\n";
    while (text.size() < 40'000) {
        text += "; more than is read ahead\n";
    }
    Print print(text + "G1 X0\n");
    print.start();
    print.disk.remove("Part.gcode");
    print.driver.run_for(30);
    CHECK(print.driver.matching("L18 P26 S3").size() == 1);
    CHECK(print.driver.number("job.status") == 2);
}

TEST_CASE("print: M26 moves on in the file, M27 tells where; another file is refused meanwhile") {
    Print print("G1 X300 F600\n" + std::string(500, '\n') + "G1 X0\n" + std::string(500, '\n') + "G4 S100\n");
    BoardDriver& driver = print.driver;
    print.start();
    driver.run_for(5);
    driver.run_to_quiet();
    CHECK(driver.ask("M23 Part.gcode", 0.2).at(0) == "L18 P26 S13");
    driver.press("M26 S700");
    driver.run_for(0.2);
    driver.run_to_quiet();
    CHECK(driver.ask("M27", 0.1).at(0) == "raw:SD printing byte 1027/1027");
}

TEST_CASE("print: any split of time and bytes gives the same talk") {
    SlicedFile wishes;
    wishes.moves = 400;
    wishes.layers = 2;
    wishes.heating = true;
    const std::string text = make_sliced_file(wishes);
    Print one(text);
    one.start();
    one.driver.run_for(400);
    Print other(text);
    other.start();
    const double end = other.driver.now() + 400;
    while (other.driver.now() < end) {
        other.driver.run_for(std::min(0.0173, end - other.driver.now()));
    }
    CHECK(one.driver.transcript() == other.driver.transcript());
}

TEST_CASE("print: half a gigabyte starts at once and is read as it is printed") {
    constexpr std::uint64_t bytes = 500'000'000;
    constexpr std::uint64_t line_bytes = 20;
    MemoryDisk disk;
    disk.put("Part.gcode", bytes, [](std::uint64_t offset, std::span<char> out) {
        for (std::size_t i = 0; i < out.size();) {
            const std::uint64_t line = (offset + i) / line_bytes;
            const std::string text =
                fmt::format("G1 X{:03}.0 Y1 F3000  ", line % 2 == 0 ? 10 : 300).substr(0, 19) + "\n";
            const auto from = static_cast<std::size_t>((offset + i) % line_bytes);
            i += text.copy(out.data() + i, out.size() - i, from);
        }
    });
    BoardDriver::Setup setup;
    setup.services.sd = &disk;
    BoardDriver driver("geeetech-a30t", setup);
    driver.run_until(2);
    driver.press_all({"M23 Part.gcode", "M24"});
    driver.run_for(0.2);
    CHECK(driver.number("job.status") == 1);
    CHECK(driver.number("motion.busy") == 1);
    CHECK(disk.bytes_read < 2'000'000);
    driver.run_for(3600);
    CHECK(driver.number("job.moves") > 500);
}
