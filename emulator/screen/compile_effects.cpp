// What a touch or an event of a board's own screen does: values, actions of the machine, pages.

#include <fmt/format.h>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/operand.h"
#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::ExpressionError;
using behaviour::Json;
using behaviour::ObjectReader;

namespace {

std::string unknown_action(const std::string& name, std::string& nearest) {
    std::vector<std::string_view> names;
    for (const behaviour::ActionInfo& action : behaviour::actions()) {
        names.push_back(action.name);
    }
    nearest = behaviour::nearest(name, names);
    return fmt::format("there is no action \"{}\"", name);
}

}  // namespace

Expression Compiler::expression(const Json& node, const std::string& pointer, Allowed allowed) {
    if (node.is_number() || node.is_boolean()) {
        return Expression::constant(node.is_number() ? node.get<double>() : node.get<bool>() ? 1 : 0);
    }
    if (!node.is_string()) {
        findings.add(pointer, behaviour::found(node) + "; expected a number or an expression");
        return Expression::constant(0);
    }
    try {
        return {node.get_ref<const std::string&>(), profile.values, allowed};
    } catch (const ExpressionError& error) {
        findings.add(pointer, error.what(), error.nearest);
        return Expression::constant(0);
    }
}

Deed::Argument Compiler::argument(const Json& node, const std::string& pointer, bool is_text,
                                  Allowed allowed) {
    Deed::Argument out;
    out.given = true;
    out.is_text = is_text;
    if (!is_text) {
        out.number = expression(node, pointer, allowed);
    } else if (node.is_string()) {
        out.text = compile(node.get_ref<const std::string&>(), pointer, allowed);
    } else {
        findings.add(pointer, behaviour::found(node) + "; expected a text");
    }
    return out;
}

void Compiler::set_fields(const Json& node, const std::string& pointer, Allowed allowed,
                          std::vector<Deed>& out) {
    ObjectReader reader(node, pointer, findings);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, value] : node.items()) {
        Deed deed;
        deed.field = behaviour::find_field(name);
        if (deed.field == nullptr || deed.field->set == nullptr) {
            findings.add(reader.pointer(name),
                         fmt::format("\"{}\" is {}", name,
                                     deed.field == nullptr ? "no field of the machine" : "read only"),
                         std::string(behaviour::nearest_field(name)));
            continue;
        }
        deed.arguments.push_back(
            argument(value, reader.pointer(name), deed.field->type == behaviour::FieldType::text, allowed));
        out.push_back(std::move(deed));
    }
}

void Compiler::deed(const std::string& name, const Json& arguments, const std::string& pointer,
                    Allowed allowed, std::vector<Deed>& out) {
    if (name == "set") {
        set_fields(arguments, pointer, allowed, out);
        return;
    }
    Deed deed;
    deed.action = behaviour::find_action(name);
    if (deed.action == nullptr || deed.action->run == nullptr) {
        std::string nearest;
        std::string sentence = unknown_action(name, nearest);
        findings.add(pointer, std::move(sentence), std::move(nearest));
        return;
    }
    ObjectReader reader(arguments, pointer, findings);
    for (const behaviour::ArgInfo& info : deed.action->args) {
        const Json* node = reader.get(info.name);
        deed.arguments.emplace_back();
        if (node != nullptr) {
            deed.arguments.back() =
                argument(*node, reader.pointer(info.name), info.type == behaviour::ArgType::text, allowed);
        } else if (info.required) {
            reader.required(info.name);
        }
    }
    reader.finish();
    out.push_back(std::move(deed));
}

std::vector<Deed> Compiler::deeds(ObjectReader& reader, std::string_view key, Allowed allowed) {
    static const Json nothing = Json::object();
    std::vector<Deed> out;
    const Json* node = reader.get(key);
    if (node == nullptr) {
        return out;
    }
    for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
        if (item.is_string()) {
            deed(item.get<std::string>(), nothing, pointer, allowed, out);
            return;
        }
        ObjectReader named(item, pointer, findings);
        if (item.is_object()) {
            for (const auto& [name, arguments] : item.items()) {
                deed(name, arguments, named.pointer(name), allowed, out);
            }
        }
    });
    return out;
}

Effect Compiler::effect(ObjectReader& reader, Allowed allowed) {
    Effect out;
    out.assume = assigns(reader, "assume", allowed);
    out.deeds = deeds(reader, "do", allowed);
    out.leads_to = targets(reader, "leads_to", allowed);
    reader.boolean("uncovers", out.uncovers);
    time(reader, "idle_at_least_ms", out.idle_at_least, 0, hour_ms);
    return out;
}

Effects Compiler::effects(const Json& node, const std::string& pointer, Allowed allowed) {
    Effects out;
    for_each_item(node, pointer, [&](const Json& item, const std::string& where) {
        ObjectReader reader(item, where, findings);
        auto when = conditions(reader, "when", allowed);
        out.push_back(effect(reader, allowed));
        out.back().when = std::move(when);
        reader.finish();
    });
    return out;
}

Effects Compiler::effects(ObjectReader& reader, std::string_view key, Allowed allowed) {
    const Json* node = reader.get(key);
    return node == nullptr ? Effects{} : effects(*node, reader.pointer(key), allowed);
}

}  // namespace fauxboard::screen
