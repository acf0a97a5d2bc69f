// The scene of a screen that hangs on a line: its profile says what stands on a page, not where.

#include <algorithm>

#include "emulator/screen/page_view.h"
#include "emulator/screen/scene.h"

namespace fauxboard::screen {
namespace {

constexpr int width = 480;
constexpr int height = 320;
constexpr int title_height = 26;
constexpr int gap = 4;
constexpr int most_line_height = 20;
constexpr int most_button_height = 44;
constexpr std::size_t most_columns = 4;

constexpr Color paper = 0xF2F4F5;
constexpr Color bar = 0x2B4A5E;
constexpr Color white = 0xFFFFFF;
constexpr Color ink = 0x00272E;
constexpr Color face = 0xD5E0E6;
constexpr Color edge = 0x8AA0AC;
constexpr Color grey = 0x808A90;

SceneItem fill(Rect at, Color color, Figure::Kind kind = Figure::Kind::fill) {
    SceneItem out;
    out.kind = kind;
    out.at = at;
    out.color = color;
    out.radius = 4;
    return out;
}

SceneItem words(Rect at, std::string text, Color color, double size, Align align) {
    SceneItem out;
    out.kind = Figure::Kind::text;
    out.at = at;
    out.text = std::move(text);
    out.color = color;
    out.size = size;
    out.align = align;
    return out;
}

/// How many lines of text and how many rows of buttons share the page below the title.
struct Grid {
    int columns = 2;
    int line_height = most_line_height;
    int button_height = most_button_height;
};

Grid grid_of(std::size_t lines, std::size_t buttons) {
    Grid out;
    const int room = height - title_height - 2 * gap;
    const std::size_t columns = std::clamp<std::size_t>((buttons + 6) / 7, buttons > 3 ? 2 : 1, most_columns);
    out.columns = static_cast<int>(columns);
    const int rows = static_cast<int>((buttons + columns - 1) / columns);
    const int rows_of_text = static_cast<int>(lines);
    if (rows_of_text > 0) {
        const int left = std::max(room - rows * 18, room / 3);
        out.line_height = std::clamp(left / rows_of_text, 8, most_line_height);
    }
    if (rows > 0) {
        out.button_height = std::clamp((room - rows_of_text * out.line_height) / rows, 9, most_button_height);
    }
    return out;
}

}  // namespace

Scene scene_of(const Standpoint& at) {
    const PageView view = view_page(at);
    Scene out;
    out.page = view.path;
    out.title = view.title;
    out.width = width;
    out.height = height;
    out.background = paper;
    out.items.push_back(fill({0, 0, width, title_height}, bar));
    out.items.back().radius = 0;
    out.items.push_back(words({8, 0, width - 16, title_height}, view.title, white, 17, Align::left));
    const Grid grid = grid_of(view.lines.size(), view.buttons.size());
    int y = title_height + gap;
    for (const std::string& line : view.lines) {
        out.items.push_back(words({8, y, width - 16, grid.line_height}, line, ink,
                                  std::min(15.0, grid.line_height * 0.9), Align::left));
        out.texts.push_back(line);
        y += grid.line_height;
    }
    const int column = (width - 2 * gap) / grid.columns;
    for (std::size_t i = 0; i < view.buttons.size(); ++i) {
        const ButtonView& button = view.buttons[i];
        const int place = static_cast<int>(i);
        SceneControl control;
        control.button = button.button;
        control.row = button.row;
        control.name = at.profile.buttons[button.button].name;
        if (at.profile.buttons[button.button].rows) control.name += " " + std::to_string(button.row);
        control.label = button.label;
        control.enabled = button.shut.empty();
        control.input = button.input;
        control.at = {gap + place % grid.columns * column + 1,
                      y + place / grid.columns * grid.button_height + 1, column - 2, grid.button_height - 2};
        out.items.push_back(fill(control.at, face));
        out.items.push_back(fill(control.at, edge, Figure::Kind::frame));
        out.items.push_back(words({control.at.x + 3, control.at.y, control.at.width - 6, control.at.height},
                                  button.label, control.enabled ? ink : grey,
                                  std::min(16.0, control.at.height * 0.8), Align::center));
        out.texts.push_back(button.label);
        out.controls.push_back(std::move(control));
    }
    return out;
}

}  // namespace fauxboard::screen
