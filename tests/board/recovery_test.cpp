// A power cut in the middle of a print, and what the next power-on makes of it.

#include <doctest/doctest.h>

#include <optional>

#include "tests/support/board_driver.h"
#include "tests/support/printers.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

struct MemoryStore final : machine::JobPlaceStore {
    std::optional<filament::JobPlace> place;
    int kept = 0;
    std::optional<std::string> load() override {
        std::string bytes;
        if (place) {
            filament::put_place(*place, bytes);
        }
        return place ? std::optional(bytes) : std::nullopt;
    }
    void keep(std::string_view now) override {
        place = filament::place_from(now);
        ++kept;
    }
    void drop() override { place.reset(); }
};

/// Boards that come and go, while the card and the store stay.
struct Cuts {
    MemoryDisk disk;
    MemoryStore store;
    std::optional<BoardDriver> driver;
    std::string file;

    explicit Cuts(bool heating) {
        SlicedFile wishes;
        wishes.moves = 3000;
        wishes.layers = 30;
        wishes.heating = heating;
        file = make_sliced_file(wishes);
        disk.put("part.gcode", file);
    }

    void power_on(std::string_view profile = "geeetech-a30t") {
        BoardDriver::Setup setup;
        setup.services.sd = &disk;
        setup.services.job_place = &store;
        driver.emplace(profile, setup);
        driver->run_until(2);
        driver->meet_screen();
        driver->run_for(1);
    }
    void start() {
        driver->press_all({"M23 part.gcode", "M24"});
        driver->run_for(0.5);
        REQUIRE(driver->number("job.status") == 1);
    }
    std::size_t offers() const { return driver->matching("L16 P0 15").size(); }
    std::string l3() const { return driver->matching("L3 ").back().body; }
};

}  // namespace

TEST_CASE("recovery: the place of a cut job is offered, and the print goes on there to its end") {
    Cuts cuts(true);
    cuts.power_on();
    CHECK(cuts.offers() == 0);
    cuts.start();
    cuts.driver->run_for(900);
    REQUIRE(cuts.driver->number("job.layer") > 2);
    const double layer = cuts.driver->number("job.layer");
    const double executed = cuts.driver->number("job.executed_byte");
    const double seconds = cuts.driver->number("job.seconds");
    const double bed = cuts.driver->number("heaters.bed.target");
    const double nozzle = cuts.driver->number("heaters.nozzle.target");
    const filament::AxisValues at = filament_printer(cuts.driver->machine()).motion.executed();
    REQUIRE(nozzle > 0);

    cuts.power_on();
    CHECK(cuts.offers() == 1);
    CHECK(cuts.driver->number("power_loss.saved_job") == 1);
    CHECK(cuts.driver->text("power_loss.path") == "part.gcode");
    CHECK(cuts.driver->number("power_loss.byte") == executed);
    // The place is where a line begins.
    CHECK(cuts.file[static_cast<std::size_t>(executed) - 1] == '\n');

    cuts.driver->press("M2130 P0 S1");
    cuts.driver->run_for(1);
    CHECK(cuts.l3().find("L3 PS:3 ") == 0);
    CHECK(cuts.driver->number("heaters.bed.target") == bed);
    while (cuts.driver->number("job.status") == 3 && cuts.driver->now() < 3000) {
        cuts.driver->run_for(1);
    }
    CHECK(cuts.driver->number("job.status") == 1);
    CHECK(cuts.driver->number("heaters.nozzle.target") == nozzle);
    CHECK(cuts.driver->number("job.layer") == doctest::Approx(layer).epsilon(0.2));
    CHECK(cuts.driver->number("job.seconds") == doctest::Approx(seconds).epsilon(0.01));
    CHECK(cuts.driver->number("job.executed_byte") >= executed);
    CHECK(filament_printer(cuts.driver->machine()).motion.executed()[2] == doctest::Approx(at[2]));
    double last = 0;
    while (cuts.driver->number("job.status") == 1 && cuts.driver->now() < 50'000) {
        cuts.driver->run_for(5);
        const double byte = cuts.driver->number("job.byte");
        REQUIRE((byte >= last || cuts.driver->number("job.status") != 1));
        last = byte;
    }
    CHECK(cuts.driver->matching("L3 PS:4").size() >= 1);
    CHECK_FALSE(cuts.store.place);
}

TEST_CASE("recovery: dropped, the job is forgotten; another power-on offers nothing") {
    Cuts cuts(false);
    cuts.power_on();
    cuts.start();
    cuts.driver->run_for(60);
    cuts.power_on();
    CHECK(cuts.offers() == 1);
    cuts.driver->press("M2130 P0 S0");
    cuts.driver->run_for(0.3);
    CHECK(cuts.driver->number("power_loss.saved_job") == 0);
    cuts.power_on();
    CHECK(cuts.offers() == 0);
    CHECK_FALSE(cuts.store.place);
}

TEST_CASE("recovery: a job that was stopped or ended leaves no place behind") {
    Cuts cuts(false);
    cuts.power_on();
    cuts.start();
    cuts.driver->run_for(30);
    REQUIRE(cuts.store.place);
    cuts.driver->press("M2103");
    cuts.driver->run_for(0.5);
    CHECK_FALSE(cuts.store.place);
    cuts.start();
    cuts.driver->run_for(30);
    REQUIRE(cuts.store.place);
    cuts.driver->press("M112");
    cuts.driver->run_for(0.5);
    CHECK_FALSE(cuts.store.place);
}

TEST_CASE("recovery: a file that is gone or has changed is refused, and the offer stays") {
    Cuts cuts(false);
    cuts.power_on();
    cuts.start();
    cuts.driver->run_for(30);
    cuts.disk.put("part.gcode", cuts.file + "; one more line\n");
    cuts.power_on();
    REQUIRE(cuts.offers() == 1);
    cuts.driver->press("M2130 P0 S1");
    cuts.driver->run_for(0.5);
    CHECK(cuts.driver->matching("L18 P26 S3").size() == 1);
    CHECK(cuts.driver->number("job.status") == 0);
    CHECK(cuts.driver->number("power_loss.saved_job") == 1);
    cuts.disk.put("part.gcode", cuts.file);
    cuts.driver->press("M2130 P0 S1");
    cuts.driver->run_for(0.5);
    CHECK(cuts.driver->number("job.status") == 3);
}

TEST_CASE("recovery: a cut at any of many moments offers the line being executed, and never goes back") {
    Cuts cuts(false);
    cuts.power_on();
    cuts.start();
    double furthest = 0;
    for (int cut = 0; cut < 40; ++cut) {
        cuts.driver->run_for(0.37 + 1.713 * (cut % 7));
        const double status = cuts.driver->number("job.status");
        if (status == 1) {
            furthest = cuts.driver->number("job.executed_byte");
        }
        cuts.power_on();
        REQUIRE(cuts.offers() == 1);
        REQUIRE(cuts.driver->number("power_loss.byte") == furthest);
        cuts.driver->press("M2130 P0 S1");
        cuts.driver->run_for(45);
    }
    CHECK(furthest > 1000);
    CHECK(cuts.store.kept > 500);
}

TEST_CASE("recovery: a brown-out and a reset keep the job as a cut does") {
    Cuts cuts(false);
    cuts.power_on();
    cuts.start();
    cuts.driver->run_for(30);
    const double executed = cuts.driver->number("job.executed_byte");
    cuts.driver->world("board reset");
    cuts.driver->run_for(3);
    CHECK(cuts.offers() == 1);
    CHECK(cuts.driver->number("power_loss.byte") == executed);
}
