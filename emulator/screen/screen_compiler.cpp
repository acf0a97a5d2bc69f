#include "emulator/screen/screen_compiler.h"

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/operand.h"
#include "emulator/behaviour/wire_text.h"

namespace fauxboard::screen {

using behaviour::ExpressionError;
using behaviour::Json;
using behaviour::ObjectReader;

std::optional<std::size_t> Compiler::value(std::string_view name, const std::string& pointer) {
    const auto id = profile.values.want(name);
    if (!id) {
        findings.add(pointer, fmt::format("unknown value \"{}\"", name), profile.values.nearest(name));
    }
    return id;
}

Template Compiler::compile(std::string_view source, const std::string& pointer, Allowed allowed) {
    try {
        return {source, profile.values, allowed};
    } catch (const ExpressionError& error) {
        findings.add(pointer, error.what(), error.nearest);
        return {};
    }
}

std::optional<Condition> Compiler::condition(const std::string& left, const Json& right,
                                             const std::string& pointer, Allowed allowed) {
    try {
        return Condition(left, right, profile.values, allowed);
    } catch (const ExpressionError& error) {
        findings.add(pointer, error.what(), error.nearest);
        return std::nullopt;
    }
}

std::vector<Condition> Compiler::conditions(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::vector<Condition> out;
    const Json* node = reader.get(key);
    if (node == nullptr) {
        return out;
    }
    ObjectReader tests(*node, reader.pointer(key), findings);
    if (!node->is_object()) {
        return out;
    }
    const auto add = [&](const std::string& left, const Json& right) {
        if (auto one = condition(left, right, tests.pointer(left), allowed)) {
            out.push_back(std::move(*one));
        }
    };
    for (const auto& [left, right] : node->items()) {
        // Several tests of one value must all hold; min and max are one test.
        const bool several =
            right.is_object() && right.size() > 1 && !right.contains("min") && !right.contains("max");
        if (several) {
            for (const auto& [test, operand] : right.items()) {
                add(left, Json{{test, operand}});
            }
        } else {
            add(left, right);
        }
    }
    return out;
}

std::vector<Assign> Compiler::assigns(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::vector<Assign> out;
    const Json* node = reader.get(key);
    if (node == nullptr) {
        return out;
    }
    ObjectReader fields(*node, reader.pointer(key), findings);
    if (!node->is_object()) {
        return out;
    }
    for (const auto& [name, right] : node->items()) {
        const std::string pointer = fields.pointer(name);
        const auto id = value(name, pointer);
        if (!id) {
            continue;
        }
        Assign assign;
        assign.value = *id;
        const ValueKind kind = profile.values.at(*id).kind;
        if (profile.values.at(*id).field != nullptr) {
            findings.add(pointer,
                         fmt::format("\"{}\" is the machine's; \"do\": {{\"set\": ...}} sets it", name));
            continue;
        }
        if (kind == ValueKind::text && right.is_string()) {
            assign.text = compile(right.get_ref<const std::string&>(), pointer, allowed);
        } else if (kind == ValueKind::number && right.is_number()) {
            assign.expression = Expression::constant(right.get<double>());
        } else if (kind == ValueKind::number && right.is_string()) {
            try {
                assign.expression = Expression(right.get_ref<const std::string&>(), profile.values, allowed);
            } catch (const ExpressionError& error) {
                findings.add(pointer, error.what(), error.nearest);
            }
        } else {
            findings.add(pointer,
                         fmt::format("{}; expected {}", behaviour::found(right),
                                     kind == ValueKind::text     ? "a text"
                                     : kind == ValueKind::number ? "a number or an expression"
                                                                 : "nothing: a list comes from its frames"));
            continue;
        }
        out.push_back(std::move(assign));
    }
    return out;
}

std::string Compiler::line_text(ObjectReader& reader, std::string_view key) {
    std::string text;
    reader.wire_text(key, text, 512);
    if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; })) {
        findings.add(reader.pointer(key),
                     "a control character in a line; line ends are added by the framing");
        return {};
    }
    return text;
}

std::optional<Send> Compiler::send(const Json& node, const std::string& pointer, Allowed allowed) {
    Json wrapped = node.is_string() ? Json{{"line", node}} : node;
    ObjectReader reader(wrapped, pointer, findings);
    Send out;
    out.when = conditions(reader, "when", allowed);
    reader.required("line");
    const std::string text = line_text(reader, "line");
    reader.finish();
    out.line = compile(text, node.is_string() ? pointer : reader.pointer("line"), allowed);
    if (text.empty()) {
        return std::nullopt;
    }
    return out;
}

std::vector<Send> Compiler::sends(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::vector<Send> out;
    if (const Json* node = reader.get(key)) {
        for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
            if (auto one = send(item, pointer, allowed)) {
                out.push_back(std::move(*one));
            }
        });
    }
    return out;
}

std::optional<Target> Compiler::target(const Json& node, const std::string& pointer, Allowed allowed) {
    Json wrapped = node.is_string() ? Json{{"page", node}} : node;
    ObjectReader reader(wrapped, pointer, findings);
    Target out;
    out.when = conditions(reader, "when", allowed);
    std::string path;
    reader.required("page");
    reader.text("page", path);
    reader.finish();
    if (path == "<back>" || path == "<before>" || path == "<close>") {
        out.where = path == "<back>"     ? Target::Where::back
                    : path == "<before>" ? Target::Where::before
                                         : Target::Where::close;
        return out;
    }
    const auto hit = std::find(page_paths.begin(), page_paths.end(), path);
    if (hit == page_paths.end()) {
        findings.add(node.is_string() ? pointer : reader.pointer("page"),
                     fmt::format("there is no page \"{}\"; expected a page, <back> or <before>", path),
                     std::string(behaviour::nearest(path, page_paths)));
        return std::nullopt;
    }
    out.page = static_cast<std::size_t>(hit - page_paths.begin());
    return out;
}

std::vector<Target> Compiler::targets(ObjectReader& reader, std::string_view key, Allowed allowed) {
    std::vector<Target> out;
    if (const Json* node = reader.get(key)) {
        for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
            if (auto one = target(item, pointer, allowed)) {
                out.push_back(std::move(*one));
            }
        });
    }
    return out;
}

std::vector<std::string> Compiler::texts(ObjectReader& reader, std::string_view key) {
    std::vector<std::string> out;
    if (const Json* node = reader.get(key)) {
        for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
            if (item.is_string()) {
                out.push_back(behaviour::to_wire(item.get_ref<const std::string&>()).value_or(""));
            } else {
                findings.add(pointer, behaviour::found(item) + "; expected a text");
            }
        });
    }
    return out;
}

void Compiler::time(ObjectReader& reader, std::string_view key, SimTime& out, double min_ms, double max_ms) {
    double ms = static_cast<double>(out.count()) / 1000;
    reader.number(key, ms, min_ms, max_ms);
    out = SimTime{static_cast<SimTime::rep>(ms * 1000 + 0.5)};
}

}  // namespace fauxboard::screen
