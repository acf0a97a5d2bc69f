#include <doctest/doctest.h>
#include <png.h>

#include <set>

#include "emulator/drawing/draw.h"
#include "emulator/drawing/png.h"

namespace fauxboard::testing {
namespace {

using drawing::Canvas;
using drawing::Picture;

screen::SceneItem item(screen::Figure::Kind kind, screen::Rect at, screen::Color color) {
    screen::SceneItem out;
    out.kind = kind;
    out.at = at;
    out.color = color;
    return out;
}

screen::Scene empty_scene() {
    screen::Scene out;
    out.width = 60;
    out.height = 40;
    out.background = 0x102030;
    return out;
}

std::set<screen::Color> colors(const Picture& picture, screen::Rect in) {
    std::set<screen::Color> out;
    for (int y = in.y; y < in.y + in.height; ++y) {
        for (int x = in.x; x < in.x + in.width; ++x) {
            out.insert(picture.at(x, y));
        }
    }
    return out;
}

/// A gradient of 8 x 4: each pixel tells its place.
class Gradient final : public drawing::Pictures {
  public:
    bool size(std::string_view name, std::size_t, std::uint32_t& width,
              std::uint32_t& height) const override {
        width = 8;
        height = 4;
        return name == "gradient";
    }
    bool row(std::string_view, std::size_t index, std::uint32_t y,
             std::span<std::uint32_t> out) const override {
        for (std::uint32_t x = 0; x < out.size(); ++x) {
            out[x] = static_cast<std::uint32_t>(index) << 16U | y << 8U | x;
        }
        return true;
    }
};

}  // namespace

TEST_CASE("fills and frames cover their pixels and no others") {
    screen::Scene scene = empty_scene();
    scene.items.push_back(item(screen::Figure::Kind::fill, {10, 10, 20, 10}, 0xFF0000));
    scene.items.push_back(item(screen::Figure::Kind::frame, {40, 5, 10, 10}, 0x00FF00));
    const Picture picture = drawing::draw(scene);
    CHECK(picture.at(10, 10) == 0xFF0000);
    CHECK(picture.at(29, 19) == 0xFF0000);
    CHECK(picture.at(9, 10) == 0x102030);
    CHECK(picture.at(30, 19) == 0x102030);
    CHECK(picture.at(40, 5) == 0x00FF00);
    CHECK(picture.at(49, 14) == 0x00FF00);
    CHECK(picture.at(41, 6) == 0x102030);
}

TEST_CASE("a shape fills what lies within an odd number of its outlines") {
    Canvas canvas(20, 20, 0);
    const std::vector<std::vector<screen::Icon::Point>> ring{{{2, 2}, {18, 2}, {18, 18}, {2, 18}},
                                                             {{6, 6}, {14, 6}, {14, 14}, {6, 14}}};
    canvas.fill(ring, 0xFFFFFF);
    const Picture picture = canvas.take();
    CHECK(picture.at(3, 3) == 0xFFFFFF);
    CHECK(picture.at(10, 10) == 0);
    CHECK(picture.at(0, 0) == 0);
}

TEST_CASE("texts stay within their places, long ones squeezed, longer ones cut") {
    for (const std::string text : {"OK", "Лист настроек", "a text that is far too long for its place"}) {
        for (const auto align : {screen::Align::left, screen::Align::center, screen::Align::right}) {
            screen::Scene scene = empty_scene();
            auto one = item(screen::Figure::Kind::text, {10, 10, 40, 20}, 0xFFFFFF);
            one.text = text;
            one.size = 14;
            one.align = align;
            scene.items.push_back(one);
            const Picture picture = drawing::draw(scene);
            CAPTURE(text);
            CHECK(colors(picture, {10, 10, 40, 20}).size() > 1);
            for (const screen::Rect outside : {screen::Rect{0, 0, 8, 40}, screen::Rect{52, 0, 8, 40},
                                               screen::Rect{0, 0, 60, 9}, screen::Rect{0, 31, 60, 9}}) {
                CHECK(colors(picture, outside) == std::set<screen::Color>{0x102030});
            }
        }
    }
}

TEST_CASE("texts are broken at blanks, and cut between characters") {
    CHECK(drawing::broken("one two three", 14, drawing::text_width("one two", 14) + 1, 2) ==
          std::vector<std::string>{"one two", "three"});
    CHECK(drawing::broken("файлфайл.pws", 14, drawing::text_width("файл", 14) + 1, 2).size() == 2);
    CHECK(drawing::shortened("short", 14, 500) == "short");
    const std::string cut = drawing::shortened("имя-файла", 14, 50);
    CHECK(cut.ends_with("..."));
    CHECK(drawing::text_width(cut, 14) <= 50);
}

TEST_CASE("bytes that are no text are drawn as something, and harm nothing") {
    Canvas canvas(50, 20, 0);
    for (const std::string& bytes : {std::string("\xFF\xFE\xC3"), std::string("\xF0\x9F"),
                                     std::string(1, '\0'), std::string("\xED\xA0\x80")}) {
        canvas.text(bytes, 0, 10, 14, 0xFFFFFF);
        CHECK(drawing::text_width(bytes, 14) > 0);
    }
}

TEST_CASE("pictures of the machine are fitted into their place, or stepped through") {
    const Gradient pictures;
    screen::Scene scene = empty_scene();
    auto whole = item(screen::Figure::Kind::picture, {0, 0, 16, 16}, 0);
    whole.picture = "gradient";
    whole.index = 3;
    auto stepped = item(screen::Figure::Kind::picture, {30, 20, 10, 10}, 0);
    stepped.picture = "gradient";
    stepped.whole = false;
    stepped.step = 2;
    auto missing = item(screen::Figure::Kind::picture, {50, 20, 10, 10}, 0);
    missing.picture = "none";
    scene.items = {whole, stepped, missing};
    const Picture picture = drawing::draw(scene, &pictures);
    CHECK(picture.at(0, 4) == 0x030000);  // twice as large, in the middle of the height
    CHECK(picture.at(15, 11) == 0x030307);
    CHECK(picture.at(0, 3) == 0x102030);
    CHECK(picture.at(31, 21) == 0x000202);
    CHECK(picture.at(33, 21) == 0x000206);
    CHECK(picture.at(34, 21) == 0x102030);
    CHECK(picture.at(50, 20) == 0x102030);
}

TEST_CASE("a picture may be turned, and painted in one colour") {
    const Gradient pictures;
    screen::Scene scene = empty_scene();
    auto turned = item(screen::Figure::Kind::picture, {0, 0, 4, 8}, 0xEFEFEF);
    turned.picture = "gradient";
    turned.turned = true;
    scene.items = {turned};
    CHECK(drawing::draw(scene, &pictures).at(3, 5) == 0x000305);
    scene.items[0].painted = true;
    CHECK(drawing::draw(scene, &pictures).at(3, 5) == 0xEFEFEF);
    CHECK(drawing::draw(scene, &pictures).at(0, 0) == 0);
}

TEST_CASE("a turned glass shows the picture turned") {
    screen::Scene scene = empty_scene();
    scene.items.push_back(item(screen::Figure::Kind::fill, {0, 0, 1, 1}, 0xFF0000));
    scene.rotated = true;
    CHECK(drawing::draw(scene).at(59, 39) == 0xFF0000);
}

TEST_CASE("a box is as wide as its widest line, within its bounds") {
    screen::Scene scene = empty_scene();
    scene.width = 480;
    scene.height = 320;
    scene.box.emplace();
    scene.box->caption = "Error!";
    scene.box->at = {110, 95, 260, 130};
    scene.box->caption_height = 26;
    scene.box->look.fill = 0xEEEEEE;
    scene.box->look.size = 20;
    scene.box->caption_look.fill = 0x006BA7;
    const auto width = [&](const std::string& line) {
        scene.box->lines = {line};
        const Picture picture = drawing::draw(scene);
        int out = 0;
        for (int x = 0; x < 480; ++x) {
            out += picture.at(x, 220) == 0x102030 ? 0 : 1;
        }
        return out;
    };
    CHECK(width("short") == 260);
    const std::string line = "Model height exceeds the maximum";
    CHECK(width(line) == static_cast<int>(std::ceil(drawing::text_width(line, 20))) + 20);
    CHECK(width(std::string(100, 'w')) == 440);
}

TEST_CASE("a PNG holds the picture pixel by pixel") {
    screen::Scene scene = empty_scene();
    scene.items.push_back(item(screen::Figure::Kind::fill, {7, 9, 3, 2}, 0x12AB56));
    const Picture picture = drawing::draw(scene);
    const std::string bytes = drawing::png_bytes(picture);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) != 0);
    image.format = PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr) != 0);
    CHECK(image.width == 60);
    CHECK(image.height == 40);
    CHECK(read == picture.rgba);
}

}  // namespace fauxboard::testing
