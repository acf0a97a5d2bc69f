#pragma once

// What stands where on a screen, in pixels: for whoever draws it, touches it, or tells a program of it. No
// fonts and no pictures here.

#include <optional>
#include <string>
#include <vector>

#include "emulator/behaviour/document.h"
#include "emulator/screen/navigation.h"

namespace fauxboard::screen {

/// One thing to draw; later ones lie on top.
struct SceneItem {
    Figure::Kind kind = Figure::Kind::fill;
    Rect at;
    Color color = 0;
    int radius = 0;    ///< of the corners of a fill or a frame
    std::string text;  ///< UTF-8, perhaps not clean: names come from disks
    double size = 16;  ///< of the text, pixels from line to line
    Align align = Align::left;
    unsigned lines = 1;
    bool cut = false;
    const Icon* icon = nullptr;
    std::string picture;
    std::size_t index = 0;  ///< of the picture
    bool whole = true;
    int step = 1;
    bool turned = false;
    bool painted = false;  ///< `color` stands for all that is not black
};

/// A control that can be touched.
struct SceneControl {
    std::size_t button = 0;
    std::size_t row = 1;  ///< of the list, where it has one
    std::string name;     ///< "Light"; "Tile 2" of one with several places
    std::string label;
    Rect at;
    bool enabled = true;
    std::optional<Input> input;  ///< it asks for a number
};

/// The message box over the page.
struct SceneBox {
    std::string caption;
    std::vector<std::string> lines;
    std::vector<std::string> buttons;
    Rect at;  ///< at its narrowest; whoever knows the font widens it to its widest line + 20, at most 440
    ControlStyle look;
    ControlStyle caption_look;
    int caption_height = 0;
};

struct Scene {
    std::string page;
    std::string title;
    int width = 0;
    int height = 0;
    bool rotated = false;  ///< the glass shows it turned by 180 degrees
    Color background = 0;
    std::vector<SceneItem> items;
    std::optional<SceneBox> box;
    std::vector<SceneItem> above;        ///< over the box: its buttons
    std::vector<SceneControl> controls;  ///< of what is on top: the page's, or the box's alone
    std::vector<std::string> texts;      ///< all that can be read, but the title and the box's

    /// The control at a pixel of the picture as it is drawn, `rotated` left aside.
    const SceneControl* hit(int x, int y) const;
    /// The one that a person calls so: by its name, else by its label.
    const SceneControl* find(std::string_view name) const;
};

/// What of a board's own screen is on top of its page.
struct Layers {
    std::size_t page = 0;
    std::optional<std::size_t> box;
    std::optional<std::size_t> cover;
    std::optional<std::size_t> pressed;  ///< button
    std::size_t pressed_row = 1;
};

/// A board's own screen.
Scene scene_of(const ScreenProfile& profile, std::span<const Shown> values, const Layers& layers);

/// Any screen: one that hangs on a line has no places of its own and is laid out on 480 x 320.
Scene scene_of(const Standpoint& at);

/// {"page", "title", "texts", "box": null or {"caption", "text", "buttons"}, "controls": [{"name", "x", "y",
/// "w", "h", "label", "enabled"}]}, places as they are on the glass.
behaviour::Json page_json(const Scene& scene);

}  // namespace fauxboard::screen
