#include "emulator/drawing/draw.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::drawing {
namespace {

using screen::Align;
using screen::Figure;
using screen::Scene;
using screen::SceneBox;
using screen::SceneItem;

/// Narrower than that no text is squeezed; what is still too long is cut.
constexpr double least_squeeze = 0.6;
constexpr int box_margin = 20;
constexpr int most_box_width = 440;
constexpr int text_top = 10;
constexpr std::uint32_t most_picture = 8192;

double squeeze_to(std::string_view text, double size, double width) {
    const double natural = text_width(text, size);
    return natural > width && natural > 0 ? width / natural : 1;
}

void draw_line(Canvas& canvas, std::string_view text, const SceneItem& item, double middle) {
    const double width = item.at.width;
    double squeeze = squeeze_to(text, item.size, width);
    std::string shown(text);
    if (squeeze < 1 && (item.cut || squeeze < least_squeeze)) {
        squeeze = item.cut ? 1 : least_squeeze;
        shown = shortened(text, item.size, width / squeeze);
    }
    const double left = width - text_width(shown, item.size) * squeeze;
    const double shift = item.align == Align::left ? 0 : item.align == Align::right ? left : left / 2;
    canvas.text(shown, item.at.x + shift, middle, item.size, item.color, squeeze);
}

void draw_text(Canvas& canvas, const SceneItem& item) {
    const auto lines = broken(item.text, item.size, item.at.width, item.lines);
    double middle =
        item.at.y + item.at.height / 2.0 - item.size * (static_cast<double>(lines.size()) - 1) / 2;
    for (const std::string& line : lines) {
        draw_line(canvas, line, item, middle);
        middle += item.size;
    }
}

void draw_icon(Canvas& canvas, const SceneItem& item) {
    const double scale = std::min(item.at.width / item.icon->width, item.at.height / item.icon->height);
    const double x = item.at.x + (item.at.width - item.icon->width * scale) / 2;
    const double y = item.at.y + (item.at.height - item.icon->height * scale) / 2;
    for (const screen::Icon::Shape& shape : item.icon->shapes) {
        auto outlines = shape.outlines;
        for (auto& outline : outlines) {
            for (auto& point : outline) {
                point = {x + point.x * scale, y + point.y * scale};
            }
        }
        canvas.fill(outlines, shape.color.value_or(item.color));
    }
}

/// A picture of the machine's, in its place: which of its rows and columns stand where.
void draw_picture(Canvas& canvas, const SceneItem& item, const Pictures& pictures) {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    if (!pictures.size(item.picture, item.index, width, height) || width == 0 || height == 0 ||
        width > most_picture || height > most_picture) {
        return;
    }
    const double wide = item.turned ? height : width;
    const double high = item.turned ? width : height;
    const double scale = item.whole ? std::min(item.at.width / wide, item.at.height / high) : 1.0 / item.step;
    const int shown_width = std::min(item.at.width, static_cast<int>(wide * scale));
    const int shown_height = std::min(item.at.height, static_cast<int>(high * scale));
    const int x = item.at.x + (item.whole ? (item.at.width - shown_width) / 2 : 0);
    const int y = item.at.y + (item.whole ? (item.at.height - shown_height) / 2 : 0);
    const auto from = [scale](int at, std::uint32_t most) {
        return std::min(static_cast<std::uint32_t>(at / scale), most - 1);
    };
    std::vector<std::uint32_t> row(width);
    for (int j = 0; j < (item.turned ? shown_width : shown_height); ++j) {
        if (!pictures.row(item.picture, item.index, from(j, height), row)) return;
        for (int i = 0; i < (item.turned ? shown_height : shown_width); ++i) {
            const Color pixel = row[from(i, width)];
            canvas.set(x + (item.turned ? j : i), y + (item.turned ? i : j),
                       item.painted && pixel != 0 ? item.color : pixel);
        }
    }
}

void draw_item(Canvas& canvas, const SceneItem& item, const Pictures* pictures) {
    switch (item.kind) {
        case Figure::Kind::fill:
            canvas.fill(item.at, item.color, item.radius);
            break;
        case Figure::Kind::frame:
            canvas.frame(item.at, item.color, item.radius);
            break;
        case Figure::Kind::text:
            draw_text(canvas, item);
            break;
        case Figure::Kind::icon:
            draw_icon(canvas, item);
            break;
        case Figure::Kind::picture:
            if (pictures != nullptr) draw_picture(canvas, item, *pictures);
            break;
    }
}

SceneItem line_of_box(const SceneBox& box, Rect at, const std::string& text, bool caption) {
    const screen::ControlStyle& style = caption ? box.caption_look : box.look;
    SceneItem out;
    out.kind = Figure::Kind::text;
    out.at = at;
    out.text = text;
    out.color = style.text;
    out.size = style.size;
    out.align = Align::center;
    return out;
}

void draw_box(Canvas& canvas, const SceneBox& box, int screen_width) {
    double widest = text_width(box.caption, box.caption_look.size);
    for (const std::string& line : box.lines) {
        widest = std::max(widest, text_width(line, box.look.size));
    }
    Rect at = box.at;
    at.width = std::clamp(static_cast<int>(std::ceil(widest)) + box_margin, box.at.width, most_box_width);
    at.x = (screen_width - at.width) / 2;
    const Rect caption{at.x, at.y, at.width, box.caption_height};
    canvas.fill(at, box.look.fill.value_or(0));
    canvas.fill(caption, box.caption_look.fill.value_or(0));
    canvas.frame(at, box.look.frame.value_or(box.caption_look.fill.value_or(0)));
    draw_item(canvas,
              line_of_box(box, {at.x + 8, caption.y, at.width - 16, caption.height}, box.caption, true),
              nullptr);
    const int line_height = static_cast<int>(box.look.size);
    const int bottom = box.buttons.empty() ? at.y + at.height : at.y + at.height - 46;
    const int text_height = line_height * static_cast<int>(box.lines.size());
    int y = std::max(caption.y + caption.height + text_top / 2,
                     (caption.y + caption.height + bottom - text_height) / 2);
    for (const std::string& line : box.lines) {
        draw_item(canvas, line_of_box(box, {at.x + 6, y, at.width - 12, line_height}, line, false), nullptr);
        y += line_height;
    }
}

}  // namespace

Picture draw(const Scene& scene, const Pictures* pictures) {
    Canvas canvas(scene.width, scene.height, scene.background);
    for (const SceneItem& item : scene.items) {
        draw_item(canvas, item, pictures);
    }
    if (scene.box) {
        draw_box(canvas, *scene.box, scene.width);
    }
    for (const SceneItem& item : scene.above) {
        draw_item(canvas, item, pictures);
    }
    if (scene.rotated) {
        canvas.turn();
    }
    return canvas.take();
}

double squeeze_of(const SceneItem& item) {
    double out = 1;
    for (const std::string& line : broken(item.text, item.size, item.at.width, item.lines)) {
        out = std::min(out, squeeze_to(line, item.size, item.at.width));
    }
    return out;
}

}  // namespace fauxboard::drawing
