#include "tools/describe_reference.h"

#include <algorithm>

#include "emulator/behaviour/reference.h"
#include "emulator/control/ops.h"
#include "emulator/fault/kind.h"
#include "emulator/machine/events.h"
#include "emulator/script/steps.h"
#include "protocol/catalogue.h"

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

void put_text(Json& out, const char* key, std::string_view text) {
    if (!text.empty()) {
        out[key] = text;
    }
}

Json events_json() {
    Json list = Json::array();
    for (const machine::EventId event : machine::events()) {
        list.push_back({{"name", event->name}, {"help", event->help}});
    }
    return list;
}

std::string_view kind_name(protocol::FieldKind kind) {
    switch (kind) {
        case protocol::FieldKind::integer:
            return "integer";
        case protocol::FieldKind::number:
            return "number";
        case protocol::FieldKind::text:
            return "text";
        case protocol::FieldKind::flag:
            return "flag";
        case protocol::FieldKind::word:
            return "word";
    }
    return "";
}

Json wire_field_json(const protocol::FieldInfo& field) {
    Json row{{"key", field.key}, {"name", field.name}, {"kind", kind_name(field.kind)}};
    put_text(row, "unit", field.unit);
    put_text(row, "meaning", field.meaning);
    if (field.decimals >= 0 && field.kind == protocol::FieldKind::number) {
        row["decimals"] = field.decimals;
    }
    if (field.when != protocol::always) {
        row["when_first_field_is"] = field.when;
    }
    if (!field.values.empty()) {
        Json values = Json::array();
        for (const protocol::ValueName& value : field.values) {
            values.push_back({{"value", value.value}, {"words", value.words}});
        }
        row["values"] = std::move(values);
    }
    return row;
}

Json codes_json() {
    Json list = Json::array();
    for (const protocol::CodeInfo& code : protocol::catalogue()) {
        Json row{{"code", protocol::code_text(code)},
                 {"direction", code.direction == protocol::Direction::to_board ? "to_board" : "to_screen"},
                 {"title", code.title},
                 {"meaning", code.meaning}};
        put_text(row, "answer", code.answer);
        Json fields = Json::array();
        for (const protocol::FieldInfo& field : code.fields) {
            fields.push_back(wire_field_json(field));
        }
        row["fields"] = std::move(fields);
        list.push_back(std::move(row));
    }
    return list;
}

}  // namespace

Json reference_json(std::span<const std::string_view> parts) {
    Json out = Json::object();
    for (const std::string_view part : parts) {
        const std::string name(part);
        if (part == "fields") {
            out[name] = behaviour::describe_fields();
        } else if (part == "actions") {
            out[name] = behaviour::describe_actions();
        } else if (part == "events") {
            out[name] = events_json();
        } else if (part == "codes") {
            out[name] = codes_json();
        } else if (part == "faults") {
            out[name] = fault::describe_kinds();
        } else if (part == "control") {
            out[name] = control::describe_control();
        } else if (part == "scenarios") {
            out[name] = script::describe_scenarios();
        }
    }
    return out;
}

}  // namespace fauxboard::tools
