#include "emulator/behaviour/reference.h"

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"

namespace fauxboard::behaviour {
namespace {

void put_text(Json& out, const char* key, std::string_view text) {
    if (!text.empty()) {
        out[key] = text;
    }
}

std::string_view type_name(ArgType type) {
    switch (type) {
        case ArgType::number:
            return "number";
        case ArgType::boolean:
            return "boolean";
        case ArgType::text:
            return "text";
    }
    return "";
}

}  // namespace

Json describe_fields() {
    Json list = Json::array();
    for (const Field& field : fields()) {
        Json row{{"path", field.path}, {"type", type_name(field.type)}};
        put_text(row, "unit", field.unit);
        row["settable"] = field.set != nullptr;
        if (field.set != nullptr && field.type == FieldType::text) {
            row["max_bytes"] = static_cast<int>(field.max);
        } else if (field.set != nullptr && field.type != FieldType::boolean) {
            row["min"] = field.min;
            row["max"] = field.max;
        }
        row["stored"] = field.stored;
        row["help"] = field.help;
        list.push_back(std::move(row));
    }
    return list;
}

Json describe_actions() {
    Json list = Json::array();
    for (const ActionInfo& action : actions()) {
        Json row{{"name", action.name}};
        put_text(row, "phrase", action.phrase);
        row["help"] = action.help;
        Json arguments = Json::array();
        for (const ArgInfo& arg : action.args) {
            arguments.push_back({{"name", arg.name},
                                 {"type", type_name(arg.type)},
                                 {"required", arg.required},
                                 {"help", arg.help}});
        }
        row["arguments"] = std::move(arguments);
        list.push_back(std::move(row));
    }
    return list;
}

}  // namespace fauxboard::behaviour
