// What must come back, and what the tour does before it touches a button.

#include <fmt/format.h>

#include "emulator/behaviour/nearest.h"
#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::Json;
using behaviour::ObjectReader;

void Compiler::check_frame_name(const std::string& name, const std::string& pointer) {
    std::vector<std::string> names;
    for (const auto& [code, rule] : profile.codes) {
        names.push_back(rule.name);
    }
    for (const FrameRule& rule : profile.words) {
        names.push_back(rule.name);
    }
    const std::vector<std::string_view> views(names.begin(), names.end());
    if (std::find(views.begin(), views.end(), name) == views.end()) {
        findings.add(
            pointer,
            fmt::format("this screen takes no frame \"{}\"; it knows {}", name, fmt::join(views, ", ")),
            std::string(behaviour::nearest(name, views)));
    }
}

Expectation Compiler::expectation(const Json& node, const std::string& pointer, Allowed allowed) {
    Json wrapped = node.is_string() ? Json{{"frame", node}} : node;
    ObjectReader reader(wrapped, pointer, findings);
    Expectation out;
    out.within = profile.silence;
    reader.text("frame", out.frame);
    out.line = line_text(reader, "line");
    if (out.frame.empty() == out.line.empty()) {
        findings.add(pointer, "expected either \"frame\" or \"line\"");
    } else if (!out.frame.empty()) {
        check_frame_name(out.frame, node.is_string() ? pointer : reader.pointer("frame"));
    }
    for (const std::string& name : texts(reader, "with")) {
        if (const auto id = value(name, reader.pointer("with"))) {
            out.with.push_back(*id);
        }
    }
    out.where = conditions(reader, "where", allowed);
    if (const Json* where = reader.get("where"); where != nullptr && where->is_object()) {
        for (const auto& [name, test] : where->items()) {
            if (const auto id = profile.values.find(name)) {
                out.with.push_back(*id);
            }
        }
    }
    time(reader, "within_ms", out.within, 1, hour_ms);
    reader.finish();
    return out;
}

std::vector<Expectation> Compiler::expectations(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::vector<Expectation> out;
    const Json* node = reader.get(key);
    if (node == nullptr || *node == "silence") {
        return out;
    }
    for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
        out.push_back(expectation(item, pointer, allowed));
    });
    return out;
}

Prepare Compiler::preparation(const Json& node, const std::string& pointer, Allowed allowed) {
    Json wrapped = node.is_string() ? Json{{"press", node}} : node;
    ObjectReader reader(wrapped, pointer, findings);
    Prepare out;
    out.when = conditions(reader, "when", allowed);
    int kinds = 0;
    if (reader.has("press")) {
        ++kinds;
        reader.text("press", out.text);
    }
    if (reader.has("receive")) {
        ++kinds;
        out.kind = Prepare::Kind::receive;
        out.text = line_text(reader, "receive");
    }
    if (reader.has("wait_for")) {
        ++kinds;
        out.kind = Prepare::Kind::wait_for;
        out.until = conditions(reader, "wait_for", allowed);
        out.limit = SimTime{60'000'000};
        time(reader, "limit_ms", out.limit, 1, hour_ms);
    }
    if (reader.has("wait_ms")) {
        ++kinds;
        out.kind = Prepare::Kind::wait;
        time(reader, "wait_ms", out.limit, 1, hour_ms);
    }
    if (kinds != 1) {
        findings.add(pointer, "expected exactly one of \"press\", \"receive\", \"wait_for\" and \"wait_ms\"");
    }
    reader.finish();
    return out;
}

std::vector<Prepare> Compiler::preparations(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::vector<Prepare> out;
    if (const Json* node = reader.get(key)) {
        for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
            out.push_back(preparation(item, pointer, allowed));
        });
    }
    return out;
}

}  // namespace fauxboard::screen
