#include "emulator/drawing/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/drawing/font.h"

namespace fauxboard::drawing {
namespace {

using Outline = std::vector<screen::Icon::Point>;

constexpr int corner_points = 8;
constexpr int load_flags = FT_LOAD_TARGET_LIGHT;
/// Of a line's height: how far below its middle the baseline lies.
constexpr double baseline = 0.297;

/// A rectangle with round corners.
Outline rounded(double x, double y, double width, double height, double radius) {
    Outline out;
    if (radius <= 0) {
        return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    }
    const double r = std::min({radius, width / 2, height / 2});
    const screen::Icon::Point centers[] = {
        {x + width - r, y + r}, {x + width - r, y + height - r}, {x + r, y + height - r}, {x + r, y + r}};
    for (int corner = 0; corner < 4; ++corner) {
        for (int i = 0; i <= corner_points; ++i) {
            const double angle =
                (corner - 1) * std::numbers::pi / 2 + i * std::numbers::pi / 2 / corner_points;
            out.push_back({centers[corner].x + r * std::cos(angle), centers[corner].y + r * std::sin(angle)});
        }
    }
    return out;
}

bool load(FT_Face face, char32_t character, int flags) {
    return FT_Load_Char(face, character, flags) == 0;
}

}  // namespace

Color Picture::at(int x, int y) const {
    const std::size_t i =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
    return static_cast<Color>(rgba[i]) << 16U | static_cast<Color>(rgba[i + 1]) << 8U | rgba[i + 2];
}

double text_width(std::string_view utf8, double size) {
    Font& font = Font::get();
    font.set(size, 1);
    double out = 0;
    while (!utf8.empty()) {
        if (load(font.face(), take_character(utf8), load_flags)) {
            out += static_cast<double>(font.face()->glyph->linearHoriAdvance) / 65536;
        }
    }
    return out;
}

std::string shortened(std::string_view utf8, double size, double width) {
    if (text_width(utf8, size) <= width) {
        return std::string(utf8);
    }
    std::string_view rest = utf8;
    std::size_t fits = 0;
    while (!rest.empty()) {
        take_character(rest);
        const std::size_t taken = utf8.size() - rest.size();
        if (text_width(std::string(utf8.substr(0, taken)) + "...", size) > width) break;
        fits = taken;
    }
    return std::string(utf8.substr(0, fits)) + "...";
}

std::vector<std::string> broken(std::string_view utf8, double size, double width, unsigned lines) {
    std::vector<std::string> out;
    while (out.size() + 1 < lines && text_width(utf8, size) > width) {
        std::string_view rest = utf8;
        std::size_t fits = 0;
        std::size_t blank = 0;
        while (!rest.empty()) {
            const std::size_t before = utf8.size() - rest.size();
            if (rest.front() == ' ') blank = before;
            take_character(rest);
            if (text_width(utf8.substr(0, utf8.size() - rest.size()), size) > width) break;
            fits = utf8.size() - rest.size();
        }
        const std::size_t end = blank != 0 ? blank : std::max<std::size_t>(fits, 1);
        out.emplace_back(utf8.substr(0, end));
        utf8.remove_prefix(end + (blank != 0 ? 1 : 0));
    }
    out.emplace_back(utf8);
    return out;
}

Canvas::Canvas(int width, int height, Color background) {
    picture_.width = width;
    picture_.height = height;
    picture_.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 0xFF);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            set(x, y, background);
        }
    }
}

void Canvas::set(int x, int y, Color color) {
    blend(x, y, color, 255);
}

void Canvas::blend(int x, int y, Color color, unsigned coverage) {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) {
        return;
    }
    auto* pixel = &picture_.rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                                  static_cast<std::size_t>(x)) *
                                 4];
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned ink = color >> (16U - 8U * i) & 0xFFU;
        pixel[i] = static_cast<std::uint8_t>((pixel[i] * (255 - coverage) + ink * coverage + 127) / 255);
    }
}

void Canvas::fill(Rect at, Color color, int radius) {
    if (radius > 0) {
        const Outline outline = rounded(at.x, at.y, at.width, at.height, radius);
        fill(std::span(&outline, 1), color);
        return;
    }
    for (int y = std::max(at.y, 0); y < std::min(at.y + at.height, picture_.height); ++y) {
        for (int x = std::max(at.x, 0); x < std::min(at.x + at.width, picture_.width); ++x) {
            set(x, y, color);
        }
    }
}

void Canvas::frame(Rect at, Color color, int radius) {
    const std::vector<Outline> outlines{rounded(at.x, at.y, at.width, at.height, radius),
                                        rounded(at.x + 1, at.y + 1, at.width - 2, at.height - 2, radius - 1)};
    fill(outlines, color);
}

void Canvas::fill(std::span<const Outline> outlines, Color color) {
    std::vector<FT_Vector> points;
    std::vector<char> tags;
    std::vector<short> ends;
    for (const Outline& outline : outlines) {
        for (const auto& point : outline) {
            points.push_back({std::lround(point.x * 64), std::lround((picture_.height - point.y) * 64)});
            tags.push_back(FT_CURVE_TAG_ON);
        }
        ends.push_back(static_cast<short>(points.size() - 1));
    }
    if (points.empty() || points.size() > 30'000) {
        return;
    }
    FT_Outline shape{};
    shape.n_contours = static_cast<short>(ends.size());
    shape.n_points = static_cast<short>(points.size());
    shape.points = points.data();
    shape.tags = tags.data();
    shape.contours = ends.data();
    shape.flags = FT_OUTLINE_EVEN_ODD_FILL;
    std::vector<unsigned char> coverage(static_cast<std::size_t>(picture_.width) *
                                        static_cast<std::size_t>(picture_.height));
    FT_Bitmap bitmap{};
    bitmap.rows = static_cast<unsigned>(picture_.height);
    bitmap.width = static_cast<unsigned>(picture_.width);
    bitmap.pitch = picture_.width;
    bitmap.buffer = coverage.data();
    bitmap.num_grays = 256;
    bitmap.pixel_mode = FT_PIXEL_MODE_GRAY;
    if (FT_Outline_Get_Bitmap(Font::get().freetype(), &shape, &bitmap) != 0) {
        return;
    }
    for (int y = 0; y < picture_.height; ++y) {
        for (int x = 0; x < picture_.width; ++x) {
            const unsigned char one = coverage[static_cast<std::size_t>(y * picture_.width + x)];
            if (one != 0) blend(x, y, color, one);
        }
    }
}

void Canvas::text(std::string_view utf8, double x, double y, double size, Color color, double squeeze) {
    Font& font = Font::get();
    font.set(size, squeeze);
    const int base = static_cast<int>(std::lround(y + size * baseline));
    double pen = x;
    while (!utf8.empty()) {
        if (!load(font.face(), take_character(utf8), load_flags | FT_LOAD_RENDER)) continue;
        const FT_GlyphSlot glyph = font.face()->glyph;
        const int left = static_cast<int>(std::lround(pen)) + glyph->bitmap_left;
        for (unsigned row = 0; row < glyph->bitmap.rows; ++row) {
            for (unsigned column = 0; column < glyph->bitmap.width; ++column) {
                const unsigned char one =
                    glyph->bitmap.buffer[row * static_cast<unsigned>(glyph->bitmap.pitch) + column];
                if (one != 0) {
                    blend(left + static_cast<int>(column), base - glyph->bitmap_top + static_cast<int>(row),
                          color, one);
                }
            }
        }
        pen += static_cast<double>(glyph->linearHoriAdvance) / 65536 * squeeze;
    }
}

void Canvas::turn() {
    auto& bytes = picture_.rgba;
    const std::size_t pixels = bytes.size() / 4;
    for (std::size_t i = 0; i < pixels / 2; ++i) {
        std::swap_ranges(bytes.begin() + static_cast<std::ptrdiff_t>(i * 4),
                         bytes.begin() + static_cast<std::ptrdiff_t>(i * 4 + 4),
                         bytes.begin() + static_cast<std::ptrdiff_t>((pixels - 1 - i) * 4));
    }
}

}  // namespace fauxboard::drawing
