// Every text of the shipped screens fits its place, in each language.

#include <doctest/doctest.h>

#include "emulator/drawing/draw.h"
#include "emulator/host/screen_files.h"

namespace fauxboard::testing {
namespace {

/// Narrower than that a text is no longer pleasant to read.
constexpr double least_squeeze = 0.72;
constexpr double most_read_size = 100;
constexpr int most_box_width = 440;
constexpr int box_margin = 20;

void check_texts(const screen::Scene& scene) {
    for (const auto* items : {&scene.items, &scene.above}) {
        for (const screen::SceneItem& item : *items) {
            if (item.kind != screen::Figure::Kind::text || item.cut || item.text.empty()) continue;
            if (item.size > most_read_size) continue;  // digits of a clock, which are meant to be narrow
            CAPTURE(item.text);
            CHECK(drawing::squeeze_of(item) >= least_squeeze);
            CHECK(item.at.x >= 0);
            CHECK(item.at.x + item.at.width <= scene.width);
        }
    }
}

void check_box(const screen::SceneBox& box) {
    for (const std::string& line : box.lines) {
        CAPTURE(line);
        CHECK(drawing::text_width(line, box.look.size) + box_margin <= most_box_width);
    }
    CHECK(drawing::text_width(box.caption, box.caption_look.size) + box_margin <= most_box_width);
}

}  // namespace

TEST_CASE("texts fit their controls in English and in Russian") {
    for (const char* name : {"mks-dlp", "mks-dlp-0.08"}) {
        const auto profile = host::load_own_screen(name);
        const auto language = profile->values.find("setup.language");
        REQUIRE(language);
        for (std::size_t n = 0; n < profile->display->languages.size(); ++n) {
            auto values = profile->values.power_on();
            values[*language].number = static_cast<double>(n);
            for (const auto& [value, number] : {std::pair{"print.layers", 3500.0},
                                                {"print.layer", 3499.0},
                                                {"print.z_mm", 174.95},
                                                {"print.estimate_s", 86'400.0},
                                                {"print.elapsed_s", 80'000.0},
                                                {"print.percent", 100.0},
                                                {"view.ok", 1.0},
                                                {"view.layers", 3500.0},
                                                {"view.bytes", 123'456'789.0},
                                                {"view.lift_mm_s", 10.5},
                                                {"view.drop_mm_s", 10.5},
                                                {"setup.pause_lift", 1000.0},
                                                {"month", 9.0},
                                                {"clock.day", 30.0},
                                                {"clock.year", 2020.0}}) {
                if (const auto id = profile->values.find(value)) values[*id].number = number;
            }
            for (std::size_t page = 0; page < profile->pages.size(); ++page) {
                CAPTURE(name);
                CAPTURE(profile->display->languages[n]);
                CAPTURE(profile->pages[page].path);
                screen::Layers layers;
                layers.page = profile->main_page;
                const auto kind = profile->pages[page].face.kind;
                if (kind == screen::PageFace::Kind::box) {
                    layers.box = page;
                } else if (kind == screen::PageFace::Kind::cover) {
                    layers.cover = page;
                } else {
                    layers.page = page;
                }
                const screen::Scene scene = screen::scene_of(*profile, values, layers);
                check_texts(scene);
                if (scene.box) check_box(*scene.box);
            }
        }
    }
}

}  // namespace fauxboard::testing
