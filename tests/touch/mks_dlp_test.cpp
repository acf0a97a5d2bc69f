// What the MKS DLP board's screen must show: the acceptance checks of its description, by number.

#include <doctest/doctest.h>

#include "emulator/fault/printer_fault.h"
#include "emulator/fault/spec.h"
#include "tests/touch/mks_bench.h"

namespace fauxboard::testing {
namespace {

constexpr std::int64_t sep_9_0256 = 1'599'620'160;  ///< 9 Sep 2020, 02:56

MksWorld world_of(std::vector<OrderedStick::Entry> entries) {
    MksWorld out;
    out.stick.entries = std::move(entries);
    return out;
}

MksWorld with_s1() {
    return world_of({{"s1.pws", file_s1(), sep_9_0256}});
}

MksWorld mixed_stick() {
    return world_of({{"a.pws", file_s1(2), sep_9_0256},
                     {"B.PWS", "x", 0},
                     {"c.ctb", "x", 0},
                     {"d.photon", "x", 0},
                     {"e.txt", "x", 0},
                     {"f.cbddlp", "x", 0},
                     {"g.acfg", "[ZMotor]\n", 0},
                     {"h/", "", 0},
                     {"i.cimg", "x", 0}});
}

/// What the text of a tile, or of a row, reads.
bool shows(MksBench& bench, const std::vector<std::string>& texts) {
    return std::all_of(texts.begin(), texts.end(), [&](const auto& text) { return bench.has_text(text); });
}

}  // namespace

TEST_CASE("check 1: the logo, then the main menu with a clock") {
    MksBench bench;
    bench.run_for(1);
    CHECK(bench.has_text("v 0.01"));
    CHECK(bench.has_text("LOADING..."));
    bench.run_for(9);
    CHECK(bench.title() == "MAIN MENU");
    CHECK(bench.has_text("10:58 17 Sep"));
    bench.run_for(50.5);
    CHECK(bench.has_text("10:59 17 Sep"));
}

TEST_CASE("check 2: what the board has done so far, in whole hours") {
    MksBench bench;
    bench.run_to_main();
    bench.set("counters.led_s", 57'599);
    bench.set("counters.display_s", 0);
    bench.set("counters.fan_s", 133'200);
    bench.set("counters.print_s", 133'200);
    bench.tap(350, 217);
    CHECK(bench.title() == "INFO");
    std::vector<std::string> hours;
    for (const std::string& text : bench.scene().texts) {
        if (text.ends_with(" h")) hours.push_back(text);
    }
    CHECK(bench.has_text("mcu: v0.01 / fpga: v2"));
    CHECK(hours == std::vector<std::string>{"15 h", "0 h", "37 h", "37 h"});
    bench.tap("Back");
    CHECK(bench.title() == "MAIN MENU");
}

TEST_CASE("check 3: files as tiles, four a page, in the stick's own order") {
    MksBench bench(mixed_stick());
    bench.run_to_main();
    bench.tap(240, 132);
    CHECK(bench.title() == "FILES");
    CHECK(bench.has_text("/"));
    CHECK(shows(bench, {"a.pws", "d.photon", "f.cbddlp", "g.acfg"}));
    CHECK(bench.label("Tile 1") == "a.pws");
    CHECK(bench.label("Tile 4") == "g.acfg");
    CHECK_FALSE(bench.enabled("Page up"));
    CHECK(bench.enabled("Page down"));
    bench.tap(432, 279);
    CHECK(shows(bench, {"h", "i.cimg"}));
    CHECK_FALSE(bench.has_text("a.pws"));
    CHECK_FALSE(bench.enabled("Page down"));
    bench.tap(432, 211);
    CHECK(shows(bench, {"a.pws", "d.photon", "f.cbddlp", "g.acfg"}));
    // An empty tile is there, beeps and does nothing; a picture file does nothing.
    bench.tap(432, 279);
    CHECK(bench.label("Tile 3").empty());
    bench.tap(283, 250);
    bench.tap(283, 130);
    CHECK(bench.title() == "FILES");
    CHECK(bench.box().empty());
}

TEST_CASE("check 4: files as a list") {
    MksBench bench(mixed_stick());
    bench.run_to_main();
    bench.tap(240, 132);
    bench.tap(432, 75);
    const auto texts = bench.scene().texts;
    const auto row = std::find(texts.begin(), texts.end(), "a");
    REQUIRE(texts.end() - row > 2);
    CHECK(row[1] == ".pws");
    CHECK(row[2] == "09.09 02:56");
    CHECK(shows(bench, {"d", "f", "g", "h", "DIR ", "i"}));
    CHECK_FALSE(bench.enabled("Page up"));
    CHECK_FALSE(bench.enabled("Page down"));
    bench.tap("Row 5");
    CHECK(bench.has_text("/h/"));
    CHECK(bench.enabled("Parent"));
    bench.tap("Parent");
    CHECK(bench.has_text("/"));
    CHECK_FALSE(bench.enabled("Parent"));
}

TEST_CASE("check 5: what is known of a file before it is printed") {
    // The file of the checks has 2 500 000 bytes: all layers are one picture, and the rest is padding.
    std::string bytes = tall_file(100);
    REQUIRE(bytes.size() <= 2'500'000);
    bytes.resize(2'500'000);
    MksBench bench(world_of({{"s1.pws", std::move(bytes), sep_9_0256}}));
    bench.run_to_main();
    bench.open("s1.pws");
    CHECK(shows(bench, {"s1.pws", "100", "00:36", "0.050 mm", "1", "7.0 sec", "40.0 sec", "0.5 sec", "5.0 mm",
                        "2.0 mm/sec", "4.0 mm/sec", "12.3 ml", "No", "2.50 MB", "02:56  09/09/2020"}));
}

TEST_CASE("check 6: a model that is too high is red, and asked about") {
    for (const std::uint32_t layers : {3500U, 3501U}) {
        MksBench bench(world_of({{"high.pws", tall_file(layers), 0}}));
        bench.run_to_main();
        bench.open("high.pws");
        const bool too_high = layers == 3501;
        CHECK(bench.drawn(0xE00000, 252, 55).has_value() == too_high);
        bench.tap("Print");
        if (too_high) {
            CHECK(
                bench.box_text() ==
                "Model height exceeds the maximum platform lift height. The model will be cropped in height. "
                "Proceed?");
            bench.tap("No");
            CHECK(bench.title() == "FILE VIEW");
            CHECK(bench.box().empty());
            bench.tap("Print");
            bench.tap("Yes");
        }
        CHECK(bench.box_text().starts_with("Make sure there is no printed model"));
        bench.tap("Cancel");
        CHECK(bench.title() == "FILE VIEW");
    }
}

TEST_CASE("check 7: a print begins with homing") {
    MksBench bench(with_s1());
    bench.run_to_main();
    bench.print("s1.pws");
    CHECK(bench.title() == "PRINTING");
    CHECK(shows(bench, {"s1.pws", "00:00:00/00:36:45", "1%", "PRINTING"}));
    CHECK(bench.drawn(0x3C7FA8, 14, 292)->width == 3);
    double most = 0;
    while (bench.text_field("print.state").starts_with("homing")) {
        most = std::max(most, bench.field("print.elapsed_s"));
        bench.run_for(0.5);
    }
    CHECK(most == 0);
    CHECK(bench.has_text("1/100 (0.05 mm)"));
    CHECK(bench.has_text("00:00:00/00:36:45"));
}

TEST_CASE("checks 8 and 9: a pause in the first exposure, and going on") {
    MksBench bench(with_s1());
    bench.run_to_main();
    bench.print("s1.pws");
    REQUIRE(bench.run_until_field("lamp.on", 1, 600));
    bench.run_for(10);
    bench.tap(400, 67);
    CHECK(bench.has_text("PAUSE"));
    CHECK(bench.field("lamp.on") == 1);
    REQUIRE(bench.run_until_field("lamp.on", 0, 60));
    CHECK(bench.field("lamp.exposure_s") == doctest::Approx(40).epsilon(1e-6));
    CHECK(bench.has_text("2/100 (0.10 mm)"));
    REQUIRE(bench.run_until_field("print.standing", 1, 100));
    CHECK(bench.field("platform.height") == doctest::Approx(45.10).epsilon(1e-4));
    const double elapsed = bench.field("print.elapsed_s");
    bench.run_for(100);
    CHECK(bench.field("print.elapsed_s") == elapsed);
    CHECK(bench.field("platform.height") == doctest::Approx(45.10).epsilon(1e-4));

    // Nobody has touched it for longer than a minute: the first touch only lifts the screensaver.
    CHECK(bench.page() == "Screensaver");
    bench.tap(400, 67);
    CHECK(bench.has_text("PAUSE"));
    bench.tap("Pause");
    CHECK(bench.has_text("PRINTING"));
    REQUIRE(bench.run_until_field("lamp.on", 1, 100));
    CHECK(bench.field("platform.height") == doctest::Approx(0.10).epsilon(1e-3));
    REQUIRE(bench.run_until_field("lamp.on", 0, 60));
    CHECK(bench.field("lamp.exposure_s") == doctest::Approx(40).epsilon(1e-6));
    CHECK(bench.field("print.elapsed_s") < elapsed + 60);
}

TEST_CASE("check 10: the lock") {
    MksBench bench(with_s1());
    bench.run_to_main();
    bench.print("s1.pws");
    REQUIRE(bench.run_until_field("lamp.on", 1, 600));
    const auto locked = [&] {
        return !bench.enabled("Stop") && !bench.enabled("Pause") && !bench.enabled("Settings");
    };
    bench.tap(330, 17, 2.6);
    CHECK(locked());
    bench.tap("Stop");
    CHECK(bench.box().empty());
    bench.tap(330, 17, 2.6);
    CHECK_FALSE(locked());
    bench.tap("Stop");
    CHECK(bench.box_text() == "Are you sure you want to cancel printing?");
}

TEST_CASE("check 11: a print is stopped") {
    MksBench bench(with_s1());
    bench.run_to_main();
    bench.print("s1.pws");
    REQUIRE(bench.run_until_field("lamp.on", 1, 600));
    bench.tap("Stop");
    bench.tap("Yes");
    CHECK(bench.box() == "Please wait");
    CHECK(bench.box_text() == "Finishing printing...");
    CHECK(bench.field("lamp.on") == 0);
    CHECK(bench.field("panel.awake") == 0);
    CHECK(bench.field("panel.command") == 0x20);
    CHECK(bench.field("platform.moving") == 1);
    REQUIRE(bench.run_until_field("print.active", 0, 200));
    bench.run_for(0.01);
    CHECK(bench.box() == "Completed");
    CHECK(bench.box_text() == "User interrupted printing.");
    CHECK(bench.field("buzzer.last_ms") == 800);
    bench.tap("OK");
    CHECK(bench.title() == "FILES");
}

TEST_CASE("check 12: a question that is answered with no disturbs nothing") {
    MksBench bench(with_s1());
    bench.run_to_main();
    bench.print("s1.pws");
    REQUIRE(bench.run_until_field("lamp.on", 1, 600));
    bench.tap("Stop");
    bench.run_for(5);
    bench.tap("No");
    CHECK(bench.title() == "PRINTING");
    CHECK(bench.box().empty());
    CHECK(bench.field("lamp.on") == 1);
    const auto items = bench.scene().items;
    CHECK(std::any_of(items.begin(), items.end(),
                      [](const auto& item) { return item.picture == "panel.displayed"; }));
    REQUIRE(bench.run_until_field("lamp.on", 0, 60));
    CHECK(bench.field("lamp.exposure_s") == doctest::Approx(40).epsilon(1e-6));
}

TEST_CASE("check 13: a switch that never closes") {
    MksBench bench(with_s1());
    bench.run_to_main();
    bench.board.tinker(bench.now, [](machine::Machine& machine) {
        machine.faults.add(SimTime{0}, fault::to_request(fault::fault_from_text("switch_open:switch=lower")));
    });
    bench.print("s1.pws");
    REQUIRE(bench.run_until_field("print.active", 0, 300));
    bench.run_for(0.01);
    CHECK(bench.box() == "Error!");
    CHECK(bench.box_text() == "Check the limit switch!");
    CHECK(bench.field("buzzer.last_ms") == 800);
    CHECK(bench.field("platform.homed") == 0);
    CHECK(bench.field("platform.z") == doctest::Approx(-182));  // the whole way
    CHECK(bench.field("lamp.exposure_s") == 0);
    bench.tap("OK");
    CHECK(bench.title() == "FILES");
}

TEST_CASE("checks 14 and 15: a number that is typed, and lives beyond the power only when it is saved") {
    MksBench bench;
    bench.run_to_main();
    bench.run_for(1);
    const auto type = [&] {
        bench.tap("Service");
        bench.tap("Settings");
        bench.tap("Lift on pause");
        CHECK(bench.title() == "Lift on pause");
        CHECK(bench.has_text("40.000"));
        for (const char* key : {"2", "5", ".", "5"}) {
            bench.tap(key);
        }
        bench.tap("OK");
        CHECK(shows(bench, {"25.5", "mm"}));
    };
    const auto before = bench.cells.bytes;
    type();
    CHECK(bench.cells.bytes == before);
    bench.power_cycle();
    bench.tap("Service");
    bench.tap("Settings");
    CHECK(bench.has_text("40.0"));
    bench.tap("Back");
    bench.tap("Back");

    type();
    bench.tap("Save");
    CHECK(bench.box_text() == "Settings are being saved ...");
    bench.run_for(0.3);
    CHECK(bench.box().empty());
    REQUIRE(bench.cells.bytes.has_value());
    CHECK(bench.cells.bytes->substr(0x107, 4) == std::string("\x00\x00\xCC\x41", 4));
    CHECK(bench.cells.bytes->substr(0x116, 2) == std::string("\xAF\x02", 2));
    bench.power_cycle();
    bench.tap("Service");
    bench.tap("Settings");
    CHECK(bench.has_text("25.5"));
}

TEST_CASE("check 16: the UV test") {
    MksBench bench;
    bench.run_to_main();
    bench.tap("Service");
    bench.tap("UV test");
    CHECK(bench.label("Light") == "Light: OFF");
    bench.tap("Light");
    CHECK(bench.label("Light") == "Light: ON");
    CHECK(bench.field("lamp.on") == 1);
    bench.tap("Display");
    bench.run_for(0.2);
    CHECK(bench.label("Display") == "Display: ON");
    CHECK(bench.field("panel.command") == 0xD0);
    bench.tap("Image 2");
    CHECK(bench.box_text() == "Loading image...");
    bench.run_for(5);
    CHECK(bench.box().empty());
    CHECK(bench.field("panel.bank1_lit") == 3'686'400);
    bench.tap("Back");
    bench.run_for(0.2);
    CHECK(bench.title() == "SERVICE");
    CHECK(bench.field("lamp.on") == 0);
    CHECK(bench.field("panel.command") == 0x10);
    CHECK(bench.field("fan.uv") == 1);
    bench.run_for(10.2);
    CHECK(bench.field("fan.uv") == 0);
    // The light goes out by itself after two minutes, and its label with it.
    bench.tap("UV test");
    bench.tap("Light");
    bench.run_for(50);
    bench.tap(479, 319);  // no control, but no screensaver either
    bench.run_for(50);
    bench.tap(479, 319);
    bench.run_for(21);
    CHECK(bench.label("Light") == "Light: OFF");
}

TEST_CASE("check 17: a settings file with a mistake") {
    MksBench bench(world_of({{"bad.acfg", "[ZMotor]\nfeedrate = 7\nfoo = 1\n", 0}}));
    bench.run_to_main();
    bench.run_for(1);
    const auto before = bench.cells.bytes;
    bench.tap("Files");
    bench.tap("Tile 1");
    CHECK(bench.box_text() == "Do you want to load settings from this file?");
    const auto touched = bench.screen.touch(bench.now, bench.board.machine(), "Yes", SimTime{120'000});
    REQUIRE(touched.why.empty());
    std::string waited;
    while (bench.box() != "Error!") {
        if (bench.box() == "Please wait") waited = bench.box_text();
        bench.run_for(0.005);
        REQUIRE(machine::to_seconds(bench.now) < 60);
    }
    CHECK(waited == "Loading settings from a file 0:/bad.acfg ...");
    CHECK(bench.scene().box->lines ==
          std::vector<std::string>{"Error in settings file", "on line 3 :", "Unknown parameter name"});
    CHECK(bench.field("buzzer.last_ms") == 800);
    CHECK(bench.cells.bytes == before);
    bench.tap("OK");
    CHECK(bench.title() == "FILES");
}

}  // namespace fauxboard::testing
