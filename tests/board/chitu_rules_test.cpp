// What the settings of LED and fans say at each step of a print; a print held in each of its steps; what is
// not done to a file while it is printed.

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "emulator/host/profile_files.h"
#include "emulator/sliced/sample.h"
#include "tests/support/board_driver.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

constexpr unsigned layers = 3;

/// A Mars Pro that pauses at once, with a stick on which there is a small print.
struct Small {
    Small() : driver(profile(), setup()) {
        sliced::Sample sample;
        sample.layers = layers;
        sample.exposure_s = 4;
        stick.put("box.cbddlp", sliced::make_sample(sample));
        driver.run_until(3);
    }
    static std::shared_ptr<const behaviour::Profile> profile() {
        static const auto loaded =
            behaviour::load_profile({"own.json", R"({ "name": "own", "extends": "elegoo-mars-pro",
                "machine": { "resin": { "pause_from_s": 0, "pause_to_s": 0 } } })"},
                                    host::profile_finder());
        return loaded;
    }
    BoardDriver::Setup setup() {
        BoardDriver::Setup out;
        out.services.sd = &stick;
        return out;
    }
    std::string ask(const std::string& line) {
        const std::size_t before = driver.bytes().size();
        driver.feed(line + "\r\n");
        driver.run_for(0.05);
        return driver.bytes().substr(before);
    }
    void start() { REQUIRE(ask("M6030 'box.cbddlp'") == "ok N:0\r\n"); }
    double number(const char* path) {
        driver.board().refresh(machine::from_seconds(driver.now()));
        return driver.number(path);
    }
    std::string phase() {
        driver.board().refresh(machine::from_seconds(driver.now()));
        return driver.text("resin.phase");
    }
    void to_phase(const std::string& wanted) {
        for (int i = 0; phase() != wanted; ++i) {
            REQUIRE_MESSAGE(i < 5000, wanted);
            driver.run_for(0.05);
        }
    }
    /// On to the end of the print; the layers that have been exposed.
    double to_end() {
        double most = 0;
        for (int i = 0; phase() != "idle"; ++i) {
            REQUIRE(i < 20'000);
            most = std::max(most, number("job.layer"));
            driver.run_for(0.05);
        }
        CHECK(number("job.active") == 0);
        return most;
    }

    MemoryDisk stick;
    BoardDriver driver;
};

}  // namespace

TEST_CASE("chitu rules: LED and fans follow exposure or print, or are always on or off") {
    struct Row {
        const char* setting;
        const char* what;
        std::map<std::string, bool> on;  ///< at rest, on the way to a layer, while it is exposed
    };
    for (const Row& row : std::vector<Row>{
             {"M8030 S0", "resin.led", {{"idle", false}, {"approaching", false}, {"exposing", false}}},
             {"M8030 S1", "resin.led", {{"idle", true}, {"approaching", true}, {"exposing", true}}},
             {"M8030 S2", "resin.led", {{"idle", false}, {"approaching", true}, {"exposing", true}}},
             {"M8030 S4", "resin.led", {{"idle", false}, {"approaching", false}, {"exposing", true}}},
             {"M8030 I0", "resin.led_fan", {{"idle", false}, {"approaching", false}, {"exposing", false}}},
             {"M8030 I-1", "resin.led_fan", {{"idle", true}, {"approaching", true}, {"exposing", true}}},
             {"M8030 I1", "resin.led_fan", {{"idle", false}, {"approaching", false}, {"exposing", true}}},
             {"M8030 I-2", "resin.led_fan", {{"idle", false}, {"approaching", true}, {"exposing", true}}},
             {"M8030 T0", "resin.board_fan", {{"idle", false}, {"approaching", false}, {"exposing", false}}},
             {"M8030 T1",
              "resin.board_fan",
              {{"idle", false}, {"approaching", false}, {"exposing", true}}}}) {
        CAPTURE(row.setting);
        Small bench;
        bench.ask(row.setting);
        bench.ask("M8510");
        CHECK((bench.number(row.what) != 0) == row.on.at("idle"));
        bench.start();
        for (const char* phase : {"approaching", "exposing"}) {
            CAPTURE(phase);
            bench.to_phase(phase);
            CHECK((bench.number(row.what) != 0) == row.on.at(phase));
        }
    }
}

TEST_CASE("chitu rules: a print is held in each of its steps, dark, and goes on to its end") {
    for (const std::string phase : {"homing", "approaching", "exposing", "lifting", "finishing"}) {
        CAPTURE(phase);
        Small bench;
        bench.ask("M8489 P2");
        bench.ask("M8510");
        bench.start();
        bench.to_phase(phase);
        bench.ask("M25");
        CHECK(bench.phase() == "held");
        CHECK(bench.number("resin.led") == 0);
        bench.driver.run_for(60);
        CHECK(bench.phase() == "held");
        bench.ask("M24");
        CHECK(bench.phase() != "held");
        CHECK(bench.to_end() == layers);
        CHECK(bench.number("resin.z") == doctest::Approx(0));  // M8489 P2: it goes home at the end
    }
}

TEST_CASE("chitu rules: stopped while it finishes, and stopped again, it is over once") {
    Small bench;
    bench.start();
    bench.to_phase("exposing");
    CHECK(bench.ask("M33") == "ok N:0\r\n");
    CHECK(bench.ask("M33") == "Error:It's not printing now!\r\nok N:0\r\n");
    bench.to_phase("idle");
    CHECK(bench.number("job.active") == 0);
}

TEST_CASE("chitu rules: the file that is printed is not deleted, and moves by hand are refused meanwhile") {
    Small bench;
    bench.start();
    bench.to_phase("exposing");
    CHECK(bench.ask("M30 box.cbddlp").starts_with("Delete failed"));
    CHECK(bench.stick.content("box.cbddlp") != nullptr);
    const double z = bench.number("resin.z");
    for (const char* line : {"G28 Z0", "G0 Z5", "M84"}) {
        CAPTURE(line);
        bench.ask(line);
        bench.driver.run_for(0.5);
        CHECK(bench.number("resin.z") == z);
        CHECK(bench.number("resin.motor") == 1);
    }
    CHECK(bench.to_end() == layers);
    CHECK(bench.ask("M30 box.cbddlp").starts_with("File deleted"));
    CHECK(bench.stick.content("box.cbddlp") == nullptr);
    CHECK(bench.ask("M30 box.cbddlp").starts_with("Delete failed"));
    CHECK(bench.ask("M30 ").find("deleted") == std::string::npos);
    bench.driver.world("card out");
    CHECK(bench.ask("M30 box.cbddlp").starts_with("Delete failed"));
}

TEST_CASE("chitu rules: settings are kept within their bounds, at either end") {
    Small bench;
    bench.ask("M8030 S9 I-9 T9");
    CHECK(bench.number("config.led") == 4);
    CHECK(bench.number("config.led_fan") == -2);
    CHECK(bench.number("config.board_fan") == 1);
}
