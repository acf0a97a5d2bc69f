// Where everything stands on a screen that hangs on a line, whose profile has no places: it is touched and
// drawn by them.

#include <doctest/doctest.h>

#include "emulator/screen/page_view.h"
#include "emulator/screen/scene.h"
#include "tests/screen/harness.h"

namespace fauxboard::testing {
namespace {

using screen::Rect;
using screen::Scene;

bool apart(const Rect& a, const Rect& b) {
    return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
}

void check_places(const Scene& scene) {
    for (std::size_t i = 0; i < scene.controls.size(); ++i) {
        const screen::SceneControl& control = scene.controls[i];
        CAPTURE(control.name);
        const Rect& at = control.at;
        CHECK((at.x >= 0 && at.y >= 0 && at.x + at.width <= scene.width && at.y + at.height <= scene.height));
        CHECK((at.width > 0 && at.height > 0));
        CHECK(scene.hit(at.x + at.width / 2, at.y + at.height / 2) == &control);
        for (std::size_t k = i + 1; k < scene.controls.size(); ++k) {
            CHECK(apart(at, scene.controls[k].at));
        }
    }
}

TEST_CASE("scene of a line's screen: every page has all its lines and buttons, apart and on the glass") {
    for (const char* name : {"geeetech-a30t", "geeetech-a30", "btt-tft"}) {
        Bench bench(name);
        const screen::Standpoint here = bench->standpoint();
        for (std::size_t page = 0; page < here.profile.pages.size(); ++page) {
            const screen::Standpoint there{here.profile, here.values, page, here.page};
            const Scene scene = screen::scene_of(there);
            const screen::PageView view = screen::view_page(there);
            CAPTURE(name);
            CAPTURE(scene.page);
            CHECK(scene.page == here.profile.pages[page].path);
            CHECK((scene.width == 480 && scene.height == 320));
            CHECK(scene.controls.size() == view.buttons.size());
            CHECK(scene.texts.size() == view.lines.size() + view.buttons.size());
            check_places(scene);
        }
    }
}

TEST_CASE(
    "scene of a line's screen: a control is found by its name, and is shut where the screen has it shut") {
    Bench bench;
    const Scene scene = screen::scene_of(bench->standpoint());
    const screen::PageView view = screen::view_page(bench->standpoint());
    REQUIRE(scene.controls.size() > 2);
    for (std::size_t i = 0; i < view.buttons.size(); ++i) {
        CHECK(scene.controls[i].enabled == view.buttons[i].shut.empty());
        CHECK(scene.controls[i].label == view.buttons[i].label);
    }
    CHECK(scene.find(scene.controls[1].name) == &scene.controls[1]);
    CHECK(scene.find("no such control") == nullptr);
}

}  // namespace
}  // namespace fauxboard::testing
