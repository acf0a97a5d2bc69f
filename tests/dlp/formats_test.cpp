// Every format and version that the board takes, printed: what the panel shows is what was drawn.

#include <doctest/doctest.h>

#include "tests/support/dlp_bench.h"
#include "tests/support/marked_file.h"

namespace fauxboard::dlp::test {
namespace {

using testing::DlpBench;
using testing::ResinFile;

/// A bar that moves with the layers, across the middle of the panel, with edges that one bit does not tell.
std::uint8_t bar(std::uint32_t layer, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t left = 300 + 8 * layer;
    if (y < 100 || y >= 2400 || x < left || x >= left + 800) return 0;
    return x < left + 16 ? 120 : x < left + 32 ? 140 : 255;
}

struct Row {
    const char* name;
    std::string bytes;
    ResinFile wishes;
    bool grey = false;  ///< cut to one bit at half of the light
};

ResinFile of(ResinFile::Kind kind, std::uint32_t version, std::uint32_t level_sets, std::uint32_t key = 0) {
    ResinFile wishes;
    wishes.kind = kind;
    wishes.version = version;
    wishes.level_sets = level_sets;
    wishes.key = key;
    wishes.width = panel_columns;
    wishes.height = panel_lines;
    wishes.layers = 2;
    wishes.bottom_layers = 1;
    wishes.previews = false;
    wishes.exposure_s = 8;
    wishes.bottom_exposure_s = 20;
    wishes.picture = bar;
    return wishes;
}

bool lit_in(const Row& row, std::uint32_t layer, std::uint32_t plane, std::uint32_t x, std::uint32_t y) {
    return row.grey ? bar(layer, x, y) / 2 >= 64 : testing::lit_in_plane(row.wishes, layer, plane, x, y);
}

void print(const Row& row) {
    CAPTURE(row.name);
    testing::MemoryStick stick;
    stick.files = {{row.name, row.bytes}};
    BoardConfig config;
    config.lists_ctb = true;
    DlpBench bench(config, std::move(stick));
    REQUIRE(bench.run_to(Event::board_ready, 3));
    REQUIRE(bench.board.print_file(row.name, bench.now));
    const std::uint32_t planes = row.grey ? 1 : row.wishes.level_sets;
    std::uint32_t shown = 0;
    bench.each_event = [&](Event event) {
        if (event != Event::print_displayed) return;
        for (unsigned y = 0; y < panel_lines; y += 31) {
            const auto line = bench.board.panel.fpga().line(0, y);
            for (std::uint32_t x = 0; x < panel_columns; x += 3) {
                REQUIRE(lit(line, x) == lit_in(row, shown / planes, shown % planes, x, y));
            }
        }
        ++shown;
    };
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(shown == 2 * planes);
    CHECK(bench.count(Event::print_exposed) == 2 * planes);
    CHECK(bench.board.counters.led_s == 28);
    CHECK(bench.board.watch.broken() == 0);
    CHECK(bench.notes.empty());
}

TEST_CASE("DLP print: .photon and .cbddlp of versions 1 to 3, with and without antialiasing") {
    using enum ResinFile::Kind;
    for (const auto& [name, wishes] : {std::pair{"v1.photon", of(cbddlp, 1, 1)},
                                       {"v2.photon", of(cbddlp, 2, 1)},
                                       {"v2.cbddlp", of(cbddlp, 2, 2)},
                                       {"v3.cbddlp", of(cbddlp, 3, 2)}}) {
        print({name, testing::make_resin_file(wishes).bytes, wishes});
    }
}

TEST_CASE("DLP print: .pws, .photons, and .ctb cut to one bit") {
    using enum ResinFile::Kind;
    const ResinFile levels = of(cbddlp, 1, 2);
    print({"levels.pws", testing::make_pws(levels).bytes, levels});
    const ResinFile one = of(cbddlp, 1, 1);
    print({"one.photons", testing::make_photons(one).bytes, one});
    for (const auto& [name, wishes] : {std::pair{"v2.ctb", of(ctb, 2, 1)},
                                       {"v3.ctb", of(ctb, 3, 1)},
                                       {"key.ctb", of(ctb, 3, 1, 0x1234'5678)}}) {
        print({name, testing::make_resin_file(wishes).bytes, wishes, true});
    }
}

}  // namespace
}  // namespace fauxboard::dlp::test
