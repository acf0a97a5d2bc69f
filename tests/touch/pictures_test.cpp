// The pictures that the MKS DLP board has for whoever draws its screen: previews of files, what its panel
// shows.

#include <doctest/doctest.h>

#include "emulator/behaviour/lists.h"
#include "tests/touch/mks_bench.h"

namespace fauxboard::testing {
namespace {

struct Shot {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint32_t> row;  ///< its first
};

std::optional<Shot> shot(MksBench& bench, std::string_view path, std::size_t index = 0) {
    const behaviour::Picture* const picture = behaviour::find_picture(path);
    REQUIRE(picture != nullptr);
    Shot out;
    if (!picture->size(bench.board.machine(), index, out.width, out.height)) {
        return std::nullopt;
    }
    out.row.resize(out.width);
    REQUIRE(picture->row(bench.board.machine(), index, 0, out.row));
    CHECK_FALSE(picture->row(bench.board.machine(), index, out.height, out.row));
    std::vector<std::uint32_t> narrow(out.width - 1);
    CHECK_FALSE(picture->row(bench.board.machine(), index, 0, narrow));
    return out;
}

MksWorld two_files() {
    MksWorld out;
    out.stick.entries = {{"one.pws", file_s1(3), 0}, {"two.pws", file_s1(2), 0}, {"folder/", "", 0}};
    return out;
}

TEST_CASE("pictures: the preview of each listed file, red and blue in turn as it was made") {
    MksBench bench(two_files());
    bench.run_to_main();
    REQUIRE(bench.tap("Files") == "");
    std::size_t previews = 0;
    for (std::size_t index = 0; index < 3; ++index) {
        const auto one = shot(bench, "files.preview", index);
        if (!one) continue;  // the folder
        ++previews;
        CHECK((one->width == 4 && one->height == 3));
        CHECK(one->row == std::vector<std::uint32_t>{0xFF0000, 0x0000FF, 0xFF0000, 0x0000FF});
    }
    CHECK(previews == 2);
    CHECK_FALSE(shot(bench, "files.preview", 3));
}

TEST_CASE("pictures: of the file viewed, and none once the stick is out") {
    MksWorld world;
    world.stick.entries = {{"one.pws", file_s1(3), 0}};
    MksBench bench(std::move(world));
    bench.run_to_main();
    bench.open("one.pws");
    const auto viewed = shot(bench, "view.preview");
    REQUIRE(viewed);
    CHECK(viewed->width == 4);
    CHECK_FALSE(shot(bench, "view.preview", 1));
    bench.world("stick out");
    bench.run_for(2);
    CHECK_FALSE(shot(bench, "view.preview"));
}

TEST_CASE("pictures: a file without a preview, or that is no file to print, has none") {
    MksWorld world;
    world.stick.entries = {{"torn.pws", file_s1(3).substr(0, 80), 0}};
    MksBench bench(std::move(world));
    bench.run_to_main();
    REQUIRE(bench.tap("Files") == "");
    CHECK_FALSE(shot(bench, "files.preview", 0));
}

TEST_CASE("pictures: the panel's, and a name that is none") {
    MksBench bench;
    bench.run_to_main();
    const auto panel = shot(bench, "panel.displayed");
    REQUIRE(panel);
    CHECK((panel->width == 1440 && panel->height == 2560));
    CHECK_FALSE(shot(bench, "panel.bank3", 1));
    CHECK(behaviour::find_picture("panel.bank4") == nullptr);
    CHECK(behaviour::nearest_picture("panel.bank4").starts_with("panel.bank"));
}

}  // namespace
}  // namespace fauxboard::testing
