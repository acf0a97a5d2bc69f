// The display of a board's own screen: controls, pages' faces, message boxes, and the display itself.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::Json;
using behaviour::ObjectReader;

namespace {

constexpr std::size_t most_icons = 256;
constexpr std::size_t most_languages = 8;

/// What a box may be, and the buttons it then has: a name as it stands on it, and its key.
struct BoxKind {
    std::string_view name;
    std::array<std::pair<std::string_view, std::string_view>, 2> buttons;
};
constexpr std::array<BoxKind, 4> box_kinds{{{"wait", {}},
                                            {"ok", {{{"OK", "ok"}, {"", ""}}}},
                                            {"ok_cancel", {{{"OK", "ok"}, {"Cancel", "cancel"}}}},
                                            {"yes_no", {{{"Yes", "yes"}, {"No", "no"}}}}}};

/// For each effect its ways, under the conditions of both: what navigation looks at.
std::vector<Target> ways_of(const Effects& effects) {
    std::vector<Target> out;
    for (const Effect& effect : effects) {
        for (const Target& target : effect.leads_to) {
            out.push_back(target);
            out.back().when.insert(out.back().when.begin(), effect.when.begin(), effect.when.end());
        }
    }
    return out;
}

}  // namespace

// Controls
// -----------------------------------------------------------------------------------------------

void Compiler::key(ObjectReader& reader, Control& out) {
    static constexpr std::array<std::pair<std::string_view, EntryKey>, 4> keys{{{".", EntryKey::dot},
                                                                                {"erase", EntryKey::erase},
                                                                                {"clear", EntryKey::clear},
                                                                                {"sign", EntryKey::sign}}};
    std::string name;
    reader.text("key", name);
    if (!reader.has("key")) {
        return;
    }
    const auto* hit =
        std::find_if(keys.begin(), keys.end(), [&](const auto& one) { return one.first == name; });
    if (hit != keys.end()) {
        out.key = hit->second;
    } else if (name.size() == 1 && name[0] >= '0' && name[0] <= '9') {
        out.key = EntryKey::digit;
        out.digit = name[0];
    } else {
        findings.add(reader.pointer("key"),
                     fmt::format("\"{}\" is no key; expected a digit, \".\", erase, clear or sign", name));
    }
}

void Compiler::control(Button& button, ObjectReader& reader, const std::string& pointer, Allowed allowed) {
    Control out;
    out.at = place(reader, allowed);
    out.look = named(reader, "look", profile.display->look_names, "look");
    if (!reader.has("label") && button.rows) {
        out.label = words("{row.text}", pointer, allowed);
    } else {
        out.label = words(reader, "label", allowed);
    }
    if (reader.has("icon")) {
        out.icon = icon_named(reader, "icon");
    }
    out.icon_paints = paints(reader, "icon_color", allowed);
    out.enabled = conditions(reader, "enabled", allowed);
    out.draw = figures(reader, "draw", allowed);
    Effect plain = effect(reader, allowed);
    const bool has_plain = !plain.assume.empty() || !plain.deeds.empty() || !plain.leads_to.empty();
    if (reader.has("touch")) {
        if (has_plain)
            findings.add(pointer, "\"touch\" beside \"assume\", \"do\" or \"leads_to\": expected one");
        out.touch = effects(reader, "touch", allowed);
    } else if (has_plain) {
        out.touch.push_back(std::move(plain));
    }
    if (const Json* hold = reader.get("hold")) {
        ObjectReader held(*hold, reader.pointer("hold"), findings);
        time(held, "after_ms", out.hold_after, 100, 60'000);
        held.required("after_ms");
        held.required("then");
        out.hold = effects(held, "then", allowed);
        held.finish();
    }
    reader.unsigned_integer("slots", out.slots, 1, 64);
    if (out.slots != 0 && !button.rows) {
        findings.add(reader.pointer("slots"), "a control without \"rows\" has none");
    }
    out.first = Expression::constant(0);
    if (const Json* first = reader.get("first")) {
        out.first = expression(*first, reader.pointer("first"), {});
    }
    key(reader, out);
    button.leads_to = ways_of(out.touch);
    button.control = std::move(out);
}

// Pages
// -----------------------------------------------------------------------------------------------

void Compiler::entry(ObjectReader& reader, PageFace& out) {
    const Json* node = reader.get("entry");
    if (node == nullptr) {
        return;
    }
    ObjectReader keys(*node, reader.pointer("entry"), findings);
    Entry entry;
    const auto into = [&](std::string_view key, ValueKind kind, std::size_t& id) {
        std::string name;
        keys.required(key);
        keys.text(key, name);
        const auto found = keys.has(key) ? value(name, keys.pointer(key)) : std::nullopt;
        if (found && profile.values.at(*found).kind == kind) {
            id = *found;
        } else if (found) {
            findings.add(keys.pointer(key), fmt::format("\"{}\" is of the wrong kind", name));
        }
    };
    into("text", ValueKind::text, entry.text);
    into("number", ValueKind::number, entry.number);
    entry.start = Expression::constant(0);
    entry.decimals = Expression::constant(3);
    for (const auto& [key, expression_out] :
         {std::pair{"start", &entry.start}, std::pair{"decimals", &entry.decimals}}) {
        if (const Json* one = keys.get(key)) {
            *expression_out = expression(*one, keys.pointer(key), {});
        }
    }
    unsigned most = 10;
    keys.unsigned_integer("most", most, 1, 40);
    entry.most = most;
    keys.finish();
    out.entry = std::move(entry);
}

void Compiler::page_face(Page& page, ObjectReader& reader) {
    PageFace& out = page.face;
    out.title = words(page.title, reader.pointer("title"), {});
    std::string parent;
    reader.text("parent", parent);
    if (const auto above = profile.find_page(parent)) {
        page.parent = *above;
    } else if (reader.has("parent")) {
        findings.add(reader.pointer("parent"), fmt::format("there is no page \"{}\"", parent),
                     std::string(behaviour::nearest(parent, page_paths)));
    }
    bool cover = false;
    reader.boolean("cover", cover);
    out.kind = cover ? PageFace::Kind::cover : PageFace::Kind::page;
    out.background = color(reader, "background");
    reader.boolean("bare", out.bare);
    out.draw = figures(reader, "draw", {});
    out.on_open = effects(reader, "on_open", {});
    out.on_close = effects(reader, "on_close", {});
    entry(reader, out);
}

void Compiler::box_button(std::size_t page, std::string_view name, std::string_view key, int number, int of,
                          ObjectReader& reader) {
    Button button;
    button.name = name;
    button.page = page;
    button.path = profile.pages[page].path + "/" + button.name;
    button.label = compile(name, reader.pointer(key), {});
    Control control;
    control.label = words(name, reader.pointer(key), {});
    control.look = profile.display->box_button;
    control.touch = effects(reader, key, {});
    // Every button closes the box, whatever else it does.
    button.leads_to = ways_of(control.touch);
    button.leads_to.push_back({{}, Target::Where::close, no_page});
    const int x = of == 1 ? (profile.display->width - box_button_width) / 2
                          : (profile.display->width - box_button_gap) / 2 +
                                (number == 0 ? -box_button_width : box_button_gap);
    control.at.parts[0] = Expression::constant(x);
    control.at.parts[2] = Expression::constant(box_button_width);
    control.at.parts[3] = Expression::constant(box_button_height);
    button.control = std::move(control);
    profile.buttons.push_back(std::move(button));
    profile.pages[page].buttons.push_back(profile.buttons.size() - 1);
}

void Compiler::box(std::size_t id, const Json& node, const std::string& pointer) {
    ObjectReader reader(node, pointer, findings);
    Page& page = profile.pages[id];
    page.face.kind = PageFace::Kind::box;
    BoxFace face;
    face.caption = words(reader, "caption", {});
    face.text = words(reader, "text", {});
    reader.text("caption", page.title);
    reader.required("caption");
    reader.required("text");
    page.face.box = std::move(face);
    page.face.on_open = effects(reader, "on_open", {});
    page.face.on_close = effects(reader, "on_close", {});
    std::vector<std::string_view> names;
    for (const BoxKind& kind : box_kinds) {
        names.push_back(kind.name);
    }
    std::size_t kind = 0;
    reader.required("kind");
    reader.choice("kind", names, kind);
    const auto& buttons = box_kinds[kind].buttons;
    const int of = static_cast<int>(
        std::count_if(buttons.begin(), buttons.end(), [](const auto& one) { return !one.first.empty(); }));
    for (int i = 0; i < of; ++i) {
        const auto& [name, key] = buttons[static_cast<std::size_t>(i)];
        box_button(id, name, key, i, of, reader);
    }
    reader.finish();
}

void Compiler::boxes(const Json& node) {
    ObjectReader reader(node, "/boxes", findings);
    for (std::size_t id = 0; id < profile.pages.size(); ++id) {
        const std::string& path = profile.pages[id].path;
        if (node.is_object() && profile.pages[id].face.kind == PageFace::Kind::box) {
            box(id, node[path], reader.pointer(path));
        }
    }
}

// The display
// -----------------------------------------------------------------------------------------------

void Compiler::looks_and_icons(const Json& looks, const Json& icons) {
    Display& display = *profile.display;
    ObjectReader look_reader(looks, "/looks", findings);
    if (looks.is_object()) {
        for (const auto& [name, node] : looks.items()) {
            display.look_names.push_back(name);
            display.looks.push_back(look(node, look_reader.pointer(name)));
        }
    }
    if (display.looks.empty()) {
        findings.add("/looks", "expected at least one look: the first is that of controls which name none");
        display.looks.emplace_back();
        display.look_names.emplace_back();
    }
    ObjectReader icon_reader(icons, "/icons", findings);
    if (icons.is_object()) {
        for (const auto& [name, node] : icons.items()) {
            display.icons.push_back(icon(name, node, icon_reader.pointer(name)));
        }
    }
    if (display.icons.size() > most_icons) {
        findings.add("/icons", "more than 256 icons");
    }
}

void Compiler::translations(const Json& node) {
    Display& display = *profile.display;
    ObjectReader reader(node, "/translations", findings);
    display.dictionaries.resize(std::max<std::size_t>(display.languages.size(), 1));
    for (std::size_t i = 1; i < display.languages.size(); ++i) {
        const Json* words = reader.get(display.languages[i]);
        if (words == nullptr) continue;
        ObjectReader dictionary(*words, reader.pointer(display.languages[i]), findings);
        if (!words->is_object()) continue;
        for (const auto& [from, to] : words->items()) {
            if (to.is_string()) {
                display.dictionaries[i].emplace(from, to.get<std::string>());
            } else {
                findings.add(dictionary.pointer(from), behaviour::found(to) + "; expected a text");
            }
        }
    }
    reader.finish();
}

/// A translation of a text that stands nowhere is a text that was changed and not looked after.
void Compiler::check_translations() {
    const Display& display = *profile.display;
    std::vector<std::string_view> known(translated.begin(), translated.end());
    for (std::size_t i = 0; i < profile.values.size(); ++i) {
        for (const auto& [number, word] : profile.values.at(i).names) {
            known.emplace_back(word);
        }
    }
    for (std::size_t i = 1; i < display.dictionaries.size(); ++i) {
        for (const auto& [from, to] : display.dictionaries[i]) {
            if (std::find(known.begin(), known.end(), from) == known.end()) {
                ObjectReader at(Json::object(), "/translations/" + display.languages[i], findings);
                findings.add(at.pointer(from), "no text of this screen reads so",
                             std::string(behaviour::nearest(from, known)));
            }
        }
    }
}

void Compiler::display_start(const Json& node) {
    profile.display.emplace();
    profile.values.open_to_machine();
    Display& out = *profile.display;
    ObjectReader reader(node, "/display", findings);
    reader.required("width");
    reader.required("height");
    reader.integer("width", out.width, 16, 4096);
    reader.integer("height", out.height, 16, 4096);
    out.background = color(reader, "background").value_or(out.background);
    for (const std::string& language : texts(reader, "languages")) {
        out.languages.push_back(behaviour::from_wire(language));
    }
    if (out.languages.size() > most_languages) {
        findings.add(reader.pointer("languages"), "more than 8 languages");
        out.languages.resize(most_languages);
    }
}

void Compiler::display_rest(const Json& node) {
    Display& out = *profile.display;
    ObjectReader reader(node, "/display", findings);
    for (const char* known : {"width", "height", "background", "languages"}) {
        reader.has(known);
    }
    const auto number = [&](std::string_view key, Expression& expression_out) {
        const Json* one = reader.get(key);
        expression_out = one == nullptr ? Expression::constant(0) : expression(*one, reader.pointer(key), {});
    };
    number("language", out.language);
    number("rotated", out.rotated);
    if (const Json* finger = reader.get("finger")) {
        ObjectReader timing(*finger, reader.pointer("finger"), findings);
        time(timing, "tick_ms", out.finger.tick, 1, 1000);
        time(timing, "look_ms", out.finger.look, 1, 1000);
        timing.unsigned_integer("press_ticks", out.finger.press_ticks, 1, 1000);
        timing.unsigned_integer("long_ticks", out.finger.long_ticks, 1, 100'000);
        timing.finish();
    }
    for (const auto& [key, id] : {std::pair{"touch_x", &out.touch_x}, std::pair{"touch_y", &out.touch_y}}) {
        std::string name;
        reader.text(key, name);
        if (reader.has(key)) *id = value(name, reader.pointer(key));
    }
    if (const Json* felt = reader.get("felt")) {
        if (!felt->is_array() || felt->size() != 2) {
            findings.add(reader.pointer("felt"), "expected two expressions, for x and for y");
        } else {
            for (const Json& one : *felt) {
                out.felt.push_back(expression(one, reader.pointer("felt"), {}));
            }
        }
    }
    out.draw = figures(reader, "draw", {});
    if (const Json* title = reader.get("title")) {
        ObjectReader keys(*title, reader.pointer("title"), findings);
        out.title.kind = Figure::Kind::text;
        out.title.at = place(keys, {});
        out.title.paints = paints(keys, "color", {});
        text_keys(keys, out.title);
        keys.finish();
    }
    for (const auto& [key, look_out] : {std::pair{"box", &out.box}, std::pair{"caption", &out.caption}}) {
        if (const Json* one = reader.get(key)) *look_out = look(*one, reader.pointer(key));
    }
    out.box_button = named(reader, "box_button", out.look_names, "look");
    out.power_on = effects(reader, "power_on", {});
    out.press = effects(reader, "press", {});
    reader.finish();
}

void Compiler::machine_events(const Json& node) {
    ObjectReader reader(node, "/events", findings);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, effects_node] : node.items()) {
        if (const auto event = machine::find_event(name)) {
            profile.display->events[*event] = effects(effects_node, reader.pointer(name), {});
            continue;
        }
        std::vector<std::string_view> names;
        for (const machine::EventId known : machine::events()) {
            names.push_back(known->name);
        }
        findings.add(reader.pointer(name), fmt::format("there is no event \"{}\"", name),
                     std::string(behaviour::nearest(name, names)));
    }
}

void Compiler::display_idle(const Json& node) {
    ObjectReader reader(node, "/idle", findings);
    profile.display->idle_ms = Expression::constant(0);
    if (const Json* after = reader.get("after_ms")) {
        profile.display->idle_ms = expression(*after, reader.pointer("after_ms"), {});
    }
    profile.display->idle_values = profile.display->idle_ms.values();
    profile.display->idle = effects(reader, "then", {});
    reader.finish();
}

}  // namespace fauxboard::screen
