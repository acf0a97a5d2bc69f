// A whole file of each slicer, printed from the card while a screen looks on and a host asks: time, layers,
// progress and the end, on both lines.

#include <doctest/doctest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "tests/support/board_driver.h"
#include "tests/support/printers.h"
#include "tests/support/reference_time.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

struct Row {
    Slicer slicer;
    const char* name;
};
constexpr std::array<Row, 6> slicers{{{Slicer::cura, "Cura"},
                                      {Slicer::prusa, "PrusaSlicer"},
                                      {Slicer::orca, "OrcaSlicer"},
                                      {Slicer::bambu, "Bambu Studio"},
                                      {Slicer::simplify3d, "Simplify3D"},
                                      {Slicer::ideamaker, "ideaMaker"}}};

/// The number behind `key`; -1 without one.
long number_behind(const std::string& line, std::string_view key) {
    const std::size_t at = line.find(key);
    long value = -1;
    if (at != std::string::npos) {
        std::from_chars(line.data() + at + key.size(), line.data() + line.size(), value);
    }
    return value;
}

struct Print {
    MemoryDisk disk;
    BoardDriver driver;
    std::size_t replies_seen = 0;

    explicit Print(const std::string& content) : driver("geeetech-a30t", setup(content)) {
        driver.finish_boot();
        driver.host("M27");
        driver.run_for(0.2);
    }
    BoardDriver::Setup setup(const std::string& content) {
        disk.put("Part.gcode", content);
        BoardDriver::Setup made;
        made.services.sd = &disk;
        return made;
    }
    /// What the host is told that starts so, since it last asked.
    std::string told(std::string_view request, std::string_view start) {
        driver.host(request);
        driver.run_for(0.5);
        std::string out;
        for (; replies_seen < driver.replies().size(); ++replies_seen) {
            const std::string& line = driver.replies()[replies_seen].line;
            out = line.starts_with(start) ? line : out;
        }
        return out;
    }
    std::string l3() {
        const auto all = driver.matching("L3 ");
        return all.empty() ? "" : all.back().body;
    }
};

}  // namespace

TEST_CASE("slicers: a whole file of each prints; both lines are told its layers, its progress and its end") {
    for (const Row& row : slicers) {
        CAPTURE(std::string(row.name));
        SlicedFile wishes;
        wishes.slicer = row.slicer;
        wishes.shape = SlicedFile::Shape::curves;
        wishes.moves = 6000;
        wishes.layers = 12;
        wishes.whole = true;
        const std::string text = make_sliced_file(wishes);
        Print print(text);
        BoardDriver& driver = print.driver;
        const double start = driver.now();
        driver.press_all({"M23 Part.gcode", "M24"});
        driver.run_for(1);
        CHECK(driver.number("job.layers") == 12);
        CHECK(driver.number("job.estimate") ==
              slicer_estimate_s(row.slicer, {wishes.layers, wishes.moves / 600, true}));
        CHECK(number_behind(print.l3(), "LC:") == 12);

        long screen_progress = 0;
        long host_byte = 0;
        long layer = 0;
        while (driver.number("job.status") == 1 && driver.now() < start + 20'000) {
            driver.run_for(20);
            if (driver.number("job.status") != 1) {
                break;
            }
            const std::string place = print.told("M27", "SD printing byte ");
            REQUIRE(number_behind(place, "byte ") >= host_byte);
            CHECK(number_behind(place, "/") == static_cast<long>(text.size()));
            host_byte = number_behind(place, "byte ");
            const std::string status = print.l3();
            REQUIRE(number_behind(status, "PG:") >= screen_progress);
            REQUIRE(number_behind(status, "LA:") >= layer);
            REQUIRE(number_behind(status, "LA:") <= 12);
            screen_progress = number_behind(status, "PG:");
            layer = number_behind(status, "LA:");
            // Both lines tell of the same file at about the same moment.
            CHECK(std::abs(static_cast<double>(host_byte) * 100 / static_cast<double>(text.size()) -
                           static_cast<double>(screen_progress)) < 6);
        }
        CHECK(screen_progress > 50);
        CHECK(layer >= 11);  // the last look is up to 20 s before the end
        driver.run_for(1);
        CHECK(number_behind(print.l3(), "PG:") == 100);
        CHECK(number_behind(print.l3(), "LA:") == 12);
        CHECK(driver.number("job.seconds") ==
              doctest::Approx(reference_seconds(text, filament_printer(driver.machine()).settings))
                  .epsilon(0.05));
        CHECK(driver.number("job.unknown_codes") == 0);
        CHECK(print.told("M27", "Not SD printing") == "Not SD printing");
        CHECK(print.told("M105", "ok T:").find(" /0.0 B:") != std::string::npos);
        CHECK(driver.number("position.z") == doctest::Approx(0.2 * 12 + 5));
        CHECK(driver.number("motors.enabled") == 0);
        CHECK(driver.number("fans.part") == 0);
    }
}
