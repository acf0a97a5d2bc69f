#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/screen/display.h"

namespace fauxboard::drawing {

using screen::Color;
using screen::Rect;

/// A picture: 4 bytes a pixel (red, green, blue, 255), row by row from the top, nothing between rows.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;

    Color at(int x, int y) const;
};

/// Widths of texts, in pixels. `size` is from line to line.
double text_width(std::string_view utf8, double size);

/// A text broken into lines of at most `width` pixels, at blanks where it can be; the last line takes what is
/// left. At most `lines` of them.
std::vector<std::string> broken(std::string_view utf8, double size, double width, unsigned lines);
/// The text as far as it goes in `width` pixels, with "..." where it was cut.
std::string shortened(std::string_view utf8, double size, double width);

/// Where something is drawn: plain colours with smooth edges, texts in the font within. What lies outside is
/// left out.
class Canvas {
  public:
    Canvas(int width, int height, Color background);

    void fill(Rect at, Color color, int radius = 0);
    void frame(Rect at, Color color, int radius = 0);
    /// What lies within an odd number of the outlines. Points in pixels of the canvas.
    void fill(std::span<const std::vector<screen::Icon::Point>> outlines, Color color);
    /// One line. Its left end is at `x`; `y` is the middle of its height. Squeezed to `squeeze` of its width.
    void text(std::string_view utf8, double x, double y, double size, Color color, double squeeze = 1);
    void set(int x, int y, Color color);

    Picture take() { return std::move(picture_); }
    void turn();  ///< by 180 degrees

  private:
    void blend(int x, int y, Color color, unsigned coverage);

    Picture picture_;
};

}  // namespace fauxboard::drawing
