// A whole print of the MKS DLP board by touches alone, with what must hold all the while.

#include <doctest/doctest.h>

#include <vector>

#include "emulator/behaviour/lists.h"
#include "tests/support/dlp_bench.h"
#include "tests/touch/mks_bench.h"

namespace fauxboard::testing {
namespace {

/// Whether the panel shows what the file's layer (from 0) has, looked at here and there, pixel by pixel.
bool shows_layer(MksBench& bench, std::uint32_t layer) {
    const behaviour::Picture* shown = behaviour::find_picture("panel.displayed");
    REQUIRE(shown != nullptr);
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    REQUIRE(shown->size(bench.board.machine(), 0, width, height));
    std::vector<std::uint32_t> row(width);
    for (std::uint32_t y = layer % 13; y < height; y += 13) {
        REQUIRE(shown->row(bench.board.machine(), 0, y, row));
        for (std::uint32_t x = layer % 7; x < width; x += 7) {
            if ((row[x] != 0) != panel_pws_lit(layer, 0, x, y)) return false;
        }
    }
    return true;
}

/// On to the next exposure, and through it. False at the end of the print.
bool next_layer(MksBench& bench) {
    while (bench.field("lamp.on") == 0 && bench.field("print.finishing") == 0)
        bench.run_for(0.1);
    return bench.field("lamp.on") != 0;
}

}  // namespace

TEST_CASE("a whole print by touches alone: 100 layers, a pause, the lock; each picture is the file's") {
    constexpr std::uint32_t layers = 100;
    MksWorld world;
    world.stick.entries = {{"s1.pws", file_s1(layers), 0}};
    MksBench bench(std::move(world));
    bench.run_to_main();
    bench.print("s1.pws");
    std::uint32_t layer = 0;
    for (; next_layer(bench); ++layer) {
        CAPTURE(layer);
        CHECK(bench.field("print.layer") == layer + 1);
        CHECK(bench.field("print.z_mm") == doctest::Approx(0.05 * (layer + 1)));
        CHECK(bench.field("platform.height") == doctest::Approx(0.05 * (layer + 1)));
        CHECK(shows_layer(bench, layer));
        if (layer == 40) {
            bench.tap(240, 20);  // lifts the screensaver
            bench.tap("Pause");
            REQUIRE(bench.run_until_field("print.standing", 1, 100));
            bench.tap("Header", 2.6);
            bench.tap("Pause");
            CHECK(bench.field("print.paused") == 1);
            bench.tap("Header", 2.6);
            bench.tap("Pause");
            CHECK(bench.field("print.paused") == 0);
            REQUIRE(bench.run_until_field("lamp.on", 1, 100));
            CHECK(shows_layer(bench, ++layer));
        }
        REQUIRE(bench.run_until_field("lamp.on", 0, 60));
        CHECK(bench.field("lamp.exposure_s") == doctest::Approx(layer < 5 ? 40 : 7).epsilon(1e-6));
    }
    CHECK(layer == layers);
    CHECK(bench.field("panel.lit") == 0);
    REQUIRE(bench.run_until_field("print.active", 0, 200));
    bench.run_for(0.01);
    CHECK(bench.box() == "Completed");
    CHECK(bench.box_text().starts_with("Printing is complete. Printing time: 00:3"));
    CHECK(bench.field("watch.broken") == 0);
    CHECK(bench.field("watch.exposure_error_ms") <= 1);
    bench.tap("OK");
    CHECK(bench.title() == "FILES");
    CHECK(bench.field("counters.led_s") == 5 * 40 + 95 * 7);
}

}  // namespace fauxboard::testing
