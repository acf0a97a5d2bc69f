// Pages and buttons.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::Json;
using behaviour::ObjectReader;

void Compiler::button(std::size_t page, const std::string& name, const Json& node,
                      const std::string& pointer) {
    Button out;
    out.name = name;
    out.page = page;
    out.path = page == no_page || page == profile.main_page ? name : profile.pages[page].path + "/" + name;
    ObjectReader reader(node, pointer, findings);
    if (const Json* input = reader.get("input")) {
        ObjectReader numbers(*input, reader.pointer("input"), findings);
        Input typed;
        numbers.required("normally");
        numbers.number("min", typed.min, -1e9, 1e9);
        numbers.number("max", typed.max, -1e9, 1e9);
        if (typed.min > typed.max) {
            findings.add(numbers.pointer("min"),
                         fmt::format("min {} is above max {}: nothing is within", typed.min, typed.max));
        }
        numbers.number("normally", typed.normally, typed.min, typed.max);
        numbers.finish();
        out.input = typed;
    }
    std::string list;
    reader.text("rows", list);
    if (!list.empty()) {
        out.rows = value(list, reader.pointer("rows"));
        if (out.rows && profile.values.at(*out.rows).kind != ValueKind::list) {
            findings.add(reader.pointer("rows"), "\"" + list + "\" is no list");
        }
    }
    const Allowed allowed{out.rows.has_value(), out.input.has_value(),
                          out.rows ? &profile.values.at(*out.rows).columns : nullptr};
    if (const Json* label = reader.get("label"); label != nullptr && label->is_string()) {
        out.label = compile(label->get_ref<const std::string&>(), reader.pointer("label"), allowed);
    } else {
        std::string plain;
        reader.text("label", plain);
        out.label = compile(name, pointer, {});
    }
    out.when = conditions(reader, "when", allowed);
    if (profile.display) {
        control(out, reader, pointer, allowed);
    } else {
        out.assume = assigns(reader, "assume", allowed);
        out.send = sends(reader, "send", allowed);
        out.leads_to = targets(reader, "leads_to", allowed);
        out.expect = expectations(reader, "expect", allowed);
    }
    out.prepare = preparations(reader, "prepare", {});
    time(reader, "settle_ms", out.settle, 0, 600'000);
    reader.finish();
    profile.buttons.push_back(std::move(out));
    if (page != no_page) {
        profile.pages[page].buttons.push_back(profile.buttons.size() - 1);
    }
}

void Compiler::line_page(Page& out, ObjectReader& reader) {
    if (const Json* shows = reader.get("shows")) {
        for_each_item(*shows, reader.pointer("shows"), [&](const Json& item, const std::string& where) {
            if (item.is_string()) {
                out.shows.push_back(compile(item.get_ref<const std::string&>(), where, {}));
            } else {
                findings.add(where, behaviour::found(item) + "; expected a text");
            }
        });
    }
    out.open_when = conditions(reader, "open_when", {});
    if (const Json* opening = reader.get("on_open")) {
        ObjectReader on_open(*opening, reader.pointer("on_open"), findings);
        out.assume = assigns(on_open, "assume", {});
        out.send = sends(on_open, "send", {});
        out.expect = expectations(on_open, "expect", {});
        on_open.finish();
    }
    reader.boolean("stays", out.stays);
    out.opened_by = texts(reader, "opened_by");
}

void Compiler::page(std::size_t id, const Json& node, const std::string& pointer) {
    ObjectReader reader(node, pointer, findings);
    Page& out = profile.pages[id];
    reader.text("title", out.title);
    if (profile.display) {
        page_face(out, reader);
    } else {
        line_page(out, reader);
    }
    texts(reader, "without");  // read with the buttons of every page
    const Json* buttons = reader.get("buttons");
    if (buttons != nullptr) {
        ObjectReader named(*buttons, reader.pointer("buttons"), findings);
        if (buttons->is_object()) {
            for (const auto& [name, one] : buttons->items()) {
                button(id, name, one, named.pointer(name));
            }
        }
    }
    reader.finish();
}

void Compiler::pages(const Json& node) {
    ObjectReader reader(node, "/pages", findings);
    for (std::size_t id = 0; id < profile.pages.size(); ++id) {
        if (profile.pages[id].face.kind != PageFace::Kind::box) {
            page(id, node[profile.pages[id].path], reader.pointer(profile.pages[id].path));
        }
    }
}

void Compiler::everywhere(const Json& node) {
    ObjectReader reader(node, "/everywhere", findings);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, one] : node.items()) {
        button(no_page, name, one, reader.pointer(name));
    }
}

}  // namespace fauxboard::screen
