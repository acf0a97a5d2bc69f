// The part of the profiles' schema that the code's tables know.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/machine/events.h"
#include "tools/describe_reference.h"

namespace fauxboard::tools {
namespace {

using behaviour::ActionInfo;
using behaviour::ArgInfo;
using behaviour::ArgType;
using behaviour::Field;
using behaviour::FieldType;
using Json = nlohmann::ordered_json;

Json reference(std::string_view definition, std::string_view description) {
    // Draft 7 looks at nothing beside a $ref; editors show the description of the one around it.
    return {{"description", description},
            {"allOf", {{{"$ref", fmt::format("#/definitions/{}", definition)}}}}};
}

std::string description(const Field& field, bool bounds) {
    std::string out(field.help);
    if (!field.unit.empty()) {
        out += fmt::format(" ({})", field.unit);
    }
    if (bounds && field.type == FieldType::text) {
        out += fmt::format("; at most {:.0f} bytes", field.max);
    } else if (bounds && field.type != FieldType::boolean) {
        out += fmt::format("; {} to {}", field.min, field.max);
    }
    return out;
}

/// One object with a property per field; `settable` ones only, for `set`.
void put_fields(Json& definition, std::string_view value, bool settable) {
    Json properties = Json::object();
    for (const Field& field : behaviour::fields()) {
        if (!settable || field.set != nullptr) {
            const std::string_view kind = settable && field.type == FieldType::text ? "text_value" : value;
            properties[std::string(field.path)] = reference(kind, description(field, settable));
        }
    }
    definition["properties"] = std::move(properties);
}

Json arguments_schema(const ActionInfo& action) {
    Json properties{{"comment", {{"$ref", "#/definitions/comment"}}}};
    Json required = Json::array();
    for (const ArgInfo& arg : action.args) {
        properties[std::string(arg.name)] =
            reference(arg.type == ArgType::text ? "text_value" : "number_value", arg.help);
        if (arg.required) {
            required.push_back(arg.name);
        }
    }
    Json out{{"description", action.help},
             {"type", "object"},
             {"properties", std::move(properties)},
             {"additionalProperties", false}};
    if (!required.empty()) {
        out["required"] = std::move(required);
    }
    return out;
}

void put_actions(Json& definitions) {
    Json properties = Json::object();
    Json names = Json::array();
    for (const ActionInfo& action : behaviour::actions()) {
        const std::string name(action.name);
        if (action.run == nullptr) {
            properties[name] = reference("assignments", action.help);
            continue;
        }
        properties[name] = arguments_schema(action);
        bool alone = true;
        for (const ArgInfo& arg : action.args) {
            alone = alone && !arg.required;
        }
        if (alone) {
            names.push_back(name);
        }
    }
    definitions["action"]["properties"] = std::move(properties);
    definitions["action_name"]["enum"] = std::move(names);
}

constexpr std::size_t line_width = 118;

/// As editors' formatters do it: what fits into a line stands in one, all else is opened up.
void write_json(const Json& node, std::size_t indent, std::size_t used, std::string& out) {
    const std::string flat = node.dump();
    // dump() leaves no blanks: one comes behind each colon and comma, two inside braces.
    const auto marks = static_cast<std::size_t>(
        std::count_if(flat.begin(), flat.end(), [](char c) { return c == ',' || c == ':'; }));
    if (!node.is_structured() || node.empty()) {
        out += flat;
        return;
    }
    const bool object = node.is_object();
    const bool opened = used + flat.size() + marks > line_width;
    const std::string gap = opened ? "\n" + std::string(indent + 2, ' ') : object ? " " : "";
    out += object ? '{' : '[';
    std::size_t count = 0;
    for (const auto& [key, value] : node.items()) {
        out += count++ == 0 ? gap : opened ? "," + gap : ", ";
        const std::string name = object ? Json(key).dump() + ": " : "";
        out += name;
        write_json(value, indent + 2, opened ? indent + 2 + name.size() : 0, out);
    }
    out += opened ? "\n" + std::string(indent, ' ') : object ? " " : "";
    out += object ? '}' : ']';
}

}  // namespace

std::string schema_text(const Json& schema) {
    std::string out;
    write_json(schema, 0, 0, out);
    return out + "\n";
}

Json refresh_schema(Json schema) {
    Json& definitions = schema["definitions"];
    put_fields(definitions["conditions"], "condition", false);
    put_fields(definitions["assignments"], "number_value", true);
    put_actions(definitions);
    Json properties{{"comment", {{"$ref", "#/definitions/comment"}}}};
    for (const machine::EventId event : machine::events()) {
        properties[std::string(event->name)] = reference("rules", event->help);
    }
    definitions["events"]["properties"] = std::move(properties);
    return schema;
}

}  // namespace fauxboard::tools
