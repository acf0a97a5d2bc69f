// Places, colours, texts and drawings of a board's own screen.

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "emulator/behaviour/lists.h"
#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/operand.h"
#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::Json;
using behaviour::ObjectReader;

namespace {

constexpr std::array<std::string_view, 3> align_names{"left", "center", "right"};
constexpr std::size_t most_figures = 256;
constexpr int corners_of_a_circle = 32;

}  // namespace

std::optional<Color> Compiler::color(const Json& node, const std::string& pointer) {
    Color out = 0;
    if (node.is_string()) {
        const auto& text = node.get_ref<const std::string&>();
        const auto read = std::from_chars(text.data(), text.data() + text.size(), out, 16);
        if (text.size() == 6 && read.ec == std::errc{} && read.ptr == text.data() + text.size()) {
            return out;
        }
    }
    findings.add(pointer,
                 behaviour::found(node) + "; expected a colour of six hexadecimal digits: \"C80000\"");
    return std::nullopt;
}

std::optional<Color> Compiler::color(ObjectReader& reader, std::string_view key) {
    const Json* node = reader.get(key);
    return node == nullptr ? std::nullopt : color(*node, reader.pointer(key));
}

Paints Compiler::paints(ObjectReader& reader, std::string_view key, Allowed allowed) {
    Paints out;
    const Json* node = reader.get(key);
    if (node == nullptr) {
        return out;
    }
    for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
        Paint paint;
        if (!item.is_object()) {
            paint.color = color(item, pointer).value_or(0);
        } else {
            ObjectReader one(item, pointer, findings);
            paint.when = conditions(one, "when", allowed);
            one.required("is");
            paint.color = color(one, "is").value_or(0);
            one.finish();
        }
        out.push_back(std::move(paint));
    });
    return out;
}

Place Compiler::place(ObjectReader& reader, Allowed allowed) {
    Place out;
    reader.required("at");
    const Json* node = reader.get("at");
    if (node == nullptr) {
        return out;
    }
    if (!node->is_array() || node->size() != out.parts.size()) {
        findings.add(reader.pointer("at"),
                     behaviour::found(*node) + "; expected [x, y, width, height] in pixels");
        return out;
    }
    for (std::size_t i = 0; i < out.parts.size(); ++i) {
        out.parts[i] = expression((*node)[i], reader.pointer("at") + "/" + std::to_string(i), allowed);
    }
    return out;
}

Words Compiler::words(std::string_view source, const std::string& pointer, Allowed allowed) {
    Words out;
    const std::vector<Dictionary>& dictionaries = profile.display->dictionaries;  // one for each language
    for (std::size_t language = 0; language < dictionaries.size(); ++language) {
        const Dictionary* dictionary = language == 0 ? nullptr : &dictionaries[language];
        std::string_view text = source;
        if (dictionary != nullptr) {
            if (const auto hit = dictionary->find(source); hit != dictionary->end()) {
                text = hit->second;
            }
        }
        try {
            out.by_language.emplace_back(text, profile.values, allowed, dictionary);
        } catch (const behaviour::ExpressionError& error) {
            findings.add(pointer, error.what(), error.nearest);
            return out;
        }
    }
    translated.emplace(source);
    return out;
}

Words Compiler::words(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::string source;
    reader.text(key, source, 1024);
    return reader.has(key) ? words(source, reader.pointer(key), allowed) : Words{};
}

std::size_t Compiler::named(ObjectReader& reader, std::string_view key, std::span<const std::string> names,
                            std::string_view what) {
    std::string name;
    reader.text(key, name);
    const auto hit = std::find(names.begin(), names.end(), name);
    if (hit != names.end()) {
        return static_cast<std::size_t>(hit - names.begin());
    }
    if (reader.has(key)) {
        const std::vector<std::string_view> views(names.begin(), names.end());
        findings.add(reader.pointer(key), fmt::format("there is no {} \"{}\"", what, name),
                     std::string(behaviour::nearest(name, views)));
    }
    return 0;
}

std::size_t Compiler::icon_named(ObjectReader& reader, std::string_view key) {
    std::vector<std::string> names;
    for (const Icon& icon : profile.display->icons) {
        names.push_back(icon.name);
    }
    return named(reader, key, names, "icon");
}

Figure Compiler::figure(const Json& node, const std::string& pointer, Allowed allowed) {
    static constexpr std::array<std::string_view, 5> kinds{"fill", "frame", "text", "icon", "picture"};
    Figure out;
    ObjectReader reader(node, pointer, findings);
    std::size_t kind = kinds.size();
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (!reader.has(kinds[i])) continue;
        if (kind != kinds.size()) {
            findings.add(pointer, fmt::format("\"{}\" and \"{}\" at once", kinds[kind], kinds[i]));
        }
        kind = i;
    }
    if (kind == kinds.size()) {
        findings.add(pointer, fmt::format("expected one of {}", fmt::join(kinds, ", ")));
        return out;
    }
    out.kind = static_cast<Figure::Kind>(kind);
    out.when = conditions(reader, "when", allowed);
    out.at = place(reader, allowed);
    const bool plain = out.kind <= Figure::Kind::frame;
    out.paints = paints(reader, plain ? kinds[kind] : std::string_view("color"), allowed);
    if (out.kind == Figure::Kind::text) {
        out.text = words(reader, "text", allowed);
        text_keys(reader, out);
    } else if (out.kind == Figure::Kind::icon) {
        out.icon = icon_named(reader, "icon");
    } else if (out.kind == Figure::Kind::picture) {
        picture_keys(reader, out, allowed);
    }
    reader.finish();
    return out;
}

void Compiler::text_keys(ObjectReader& reader, Figure& out) {
    reader.number("size", out.size, 6, 400);
    auto align = static_cast<std::size_t>(out.align);
    reader.choice("align", align_names, align);
    out.align = static_cast<Align>(align);
    reader.unsigned_integer("lines", out.lines, 1, 16);
    reader.boolean("cut", out.cut);
}

void Compiler::picture_keys(ObjectReader& reader, Figure& out, Allowed allowed) {
    reader.text("picture", out.picture, 60);
    if (behaviour::find_picture(out.picture) == nullptr) {
        findings.add(reader.pointer("picture"), fmt::format("the machine has no picture \"{}\"", out.picture),
                     std::string(behaviour::nearest_picture(out.picture)));
    }
    out.index = Expression::constant(0);
    if (const Json* index = reader.get("index")) {
        out.index = expression(*index, reader.pointer("index"), allowed);
    }
    reader.boolean("turned", out.turned);
    if (reader.has("step")) {
        reader.integer("step", out.step, 1, 64);
        out.whole = false;
    }
}

std::vector<Figure> Compiler::figures(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::vector<Figure> out;
    if (const Json* node = reader.get(key)) {
        for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
            out.push_back(figure(item, pointer, allowed));
        });
        if (out.size() > most_figures) {
            findings.add(reader.pointer(key), "more than 256 figures");
        }
    }
    return out;
}

ControlStyle Compiler::look(const Json& node, const std::string& pointer) {
    ControlStyle out;
    ObjectReader reader(node, pointer, findings);
    out.fill = color(reader, "fill");
    out.frame = color(reader, "frame");
    out.pressed_fill = color(reader, "pressed_fill");
    out.text = color(reader, "text").value_or(out.text);
    out.pressed_text = color(reader, "pressed_text").value_or(out.text);
    out.disabled_text = color(reader, "disabled_text").value_or(out.disabled_text);
    reader.number("size", out.size, 6, 100);
    reader.integer("radius", out.radius, 0, 100);
    reader.integer("margin", out.margin, 0, 100);
    reader.boolean("vanishes", out.vanishes);
    reader.unsigned_integer("lines", out.lines, 1, 16);
    auto align = static_cast<std::size_t>(out.align);
    reader.choice("align", align_names, align);
    out.align = static_cast<Align>(align);
    reader.finish();
    return out;
}

Icon::Shape Compiler::shape(const Json& node, const std::string& pointer) {
    Icon::Shape out;
    ObjectReader reader(node, pointer, findings);
    out.color = color(reader, "color");
    std::array<double, 3> circle{};
    if (reader.has("circle")) {
        reader.numbers("circle", circle, -1000, 1000);
        auto& outline = out.outlines.emplace_back();
        for (int i = 0; i < corners_of_a_circle; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners_of_a_circle;
            outline.push_back(
                {circle[0] + circle[2] * std::cos(angle), circle[1] + circle[2] * std::sin(angle)});
        }
    }
    if (const Json* outlines = reader.get("outlines")) {
        for_each_item(*outlines, reader.pointer("outlines"), [&](const Json& item, const std::string& where) {
            if (!item.is_array() || item.size() < 6 || item.size() > 512 || item.size() % 2 != 0 ||
                !std::all_of(item.begin(), item.end(), [](const Json& one) { return one.is_number(); })) {
                findings.add(where, "expected the corners of a polygon: [x, y, x, y, x, y, ...]");
                return;
            }
            auto& outline = out.outlines.emplace_back();
            for (std::size_t i = 0; i < item.size(); i += 2) {
                outline.push_back({item[i].get<double>(), item[i + 1].get<double>()});
            }
        });
    }
    reader.finish();
    return out;
}

Icon Compiler::icon(const std::string& name, const Json& node, const std::string& pointer) {
    Icon out;
    out.name = name;
    ObjectReader reader(node, pointer, findings);
    std::array<double, 2> size{24, 24};
    reader.numbers("size", size, 1, 1000);
    out.width = size[0];
    out.height = size[1];
    reader.required("shapes");
    if (const Json* shapes = reader.get("shapes")) {
        for_each_item(*shapes, reader.pointer("shapes"), [&](const Json& item, const std::string& where) {
            out.shapes.push_back(shape(item, where));
        });
    }
    reader.finish();
    return out;
}

}  // namespace fauxboard::screen
