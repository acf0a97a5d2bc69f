#include "emulator/control/names.h"

#include <fmt/format.h>

#include <cmath>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/reader.h"
#include "emulator/behaviour/wire_text.h"

namespace fauxboard::control {
namespace {

using behaviour::Field;
using behaviour::FieldType;
using behaviour::Operand;
using behaviour::Value;
using behaviour::VariableInfo;

constexpr std::string_view variable_prefix = "var.";

bool in_group(std::string_view name, std::string_view group) {
    return name.size() > group.size() && name.starts_with(group) && name[group.size()] == '.';
}

[[noreturn]] void unknown(const board::Board& board, const std::string& name) {
    const std::vector<Place> places = all_places(board);
    std::vector<std::string_view> names;
    for (const Place& place : places) {
        names.push_back(place.name);
        // Groups too: "heaters", "heaters.nozzle".
        for (std::size_t dot = place.name.find('.'); dot != std::string::npos;
             dot = place.name.find('.', dot + 1)) {
            names.push_back(std::string_view(place.name).substr(0, dot));
        }
    }
    throw ControlError(
        ErrorCode::unknown_field,
        fmt::format("There is no field or variable \"{}\"; `fauxboard describe fields` lists them.",
                    name.substr(0, 100)),
        behaviour::nearest(name, names));
}

struct Bounds {
    double min;
    double max;
    std::string_view unit;
};

void check_number(const std::string& name, double number, const Bounds& bounds) {
    if (!std::isfinite(number) || number < bounds.min || number > bounds.max) {
        throw ControlError(ErrorCode::out_of_range,
                           fmt::format("{} is out of bounds for {}; expected {} to {}{}{}.", number, name,
                                       bounds.min, bounds.max, bounds.unit.empty() ? "" : " ", bounds.unit));
    }
}

void check_text(const std::string& name, std::string_view text, double most) {
    if (static_cast<double>(text.size()) > most) {
        throw ControlError(
            ErrorCode::out_of_range,
            fmt::format("The text for {} has {} bytes; at most {} fit.", name, text.size(), most));
    }
}

[[noreturn]] void wrong_type(const std::string& name, const Json& value, std::string_view expected) {
    throw ControlError(ErrorCode::wrong_type,
                       fmt::format("{}: {}; expected {}.", name, behaviour::found(value), expected));
}

Operand text_operand(const Place& place, const Json& value) {
    if (!value.is_string()) {
        wrong_type(place.name, value, "a text");
    }
    auto text = behaviour::to_wire(value.get_ref<const std::string&>());
    if (!text) {
        throw ControlError(ErrorCode::wrong_type,
                           place.name + ": the line carries bytes; expected characters up to U+00FF only.");
    }
    return Operand::literal(std::move(*text));
}

Operand number_operand(const Place& place, const Json& value, FieldType type) {
    if (value.is_boolean()) {
        if (type != FieldType::boolean && place.field != nullptr) {
            wrong_type(place.name, value, "a number");
        }
        return Operand::literal(value.get<bool>() ? 1.0 : 0.0);
    }
    if (!value.is_number()) {
        wrong_type(place.name, value, type == FieldType::boolean ? "true or false" : "a number");
    }
    const double number = value.get<double>();
    const bool whole = type == FieldType::integer || type == FieldType::boolean;
    if (whole && std::isfinite(number) && number != std::floor(number)) {
        wrong_type(place.name, value, type == FieldType::boolean ? "true or false" : "a whole number");
    }
    return Operand::literal(number);
}

}  // namespace

std::vector<Place> all_places(const board::Board& board) {
    std::vector<Place> out;
    for (const Field& field : behaviour::fields()) {
        out.push_back({&field, 0, std::string(field.path)});
    }
    const std::vector<VariableInfo>& variables = board.profile().variables;
    for (std::size_t i = 0; i < variables.size(); ++i) {
        out.push_back({nullptr, i, std::string(variable_prefix) + variables[i].name});
    }
    return out;
}

Place find_place(const board::Board& board, const std::string& name) {
    if (const Field* field = behaviour::find_field(name)) {
        return {field, 0, name};
    }
    const std::vector<VariableInfo>& variables = board.profile().variables;
    for (std::size_t i = 0; i < variables.size() && name.starts_with(variable_prefix); ++i) {
        if (std::string_view(name).substr(variable_prefix.size()) == variables[i].name) {
            return {nullptr, i, name};
        }
    }
    unknown(board, name);
}

void find_places(const board::Board& board, const std::string& name, std::vector<Place>& out) {
    if (behaviour::find_field(name) != nullptr) {
        out.push_back(find_place(board, name));
        return;
    }
    const std::size_t before = out.size();
    for (Place& place : all_places(board)) {
        if (place.name == name || in_group(place.name, name)) {
            out.push_back(std::move(place));
        }
    }
    if (out.size() == before) {
        unknown(board, name);
    }
}

Json value_of(const board::Board& board, const Place& place) {
    if (place.field == nullptr) {
        return board.variables()[place.variable];
    }
    const Value value = place.field->get(board.machine());
    if (value.is_text()) {
        return behaviour::from_wire(value.text);
    }
    if (!value.is_number() || !std::isfinite(value.number)) {
        return nullptr;
    }
    if (place.field->type == FieldType::boolean) {
        return value.number != 0;
    }
    if (place.field->type == FieldType::integer && std::abs(value.number) < 1e15) {
        return static_cast<std::int64_t>(std::llround(value.number));
    }
    return value.number;
}

Json values_of(const board::Board& board, const std::vector<Place>& places) {
    Json out = Json::object();
    for (const Place& place : places) {
        out[place.name] = value_of(board, place);
    }
    return out;
}

behaviour::ActionCall assignment(const board::Board& board, const Place& place, const Json& value) {
    behaviour::ActionCall call;
    call.info = behaviour::find_action("set");
    if (place.field == nullptr) {
        call.variable = place.variable;
        call.args.push_back(number_operand(place, value, FieldType::number));
    } else {
        if (place.field->set == nullptr) {
            throw ControlError(ErrorCode::read_only, place.name + " can be read but not set.");
        }
        call.field = place.field;
        call.args.push_back(place.field->type == FieldType::text
                                ? text_operand(place, value)
                                : number_operand(place, value, place.field->type));
    }
    check_bounds(board, call);
    return call;
}

void check_bounds(const board::Board& board, const behaviour::ActionCall& call) {
    if (call.args.empty() || (call.field == nullptr && !call.variable)) {
        return;
    }
    const Operand& value = call.args[0];
    if (call.field != nullptr && value.kind == Operand::Kind::text) {
        check_text(std::string(call.field->path), value.text, call.field->max);
    } else if (value.kind == Operand::Kind::number && !call.add) {
        if (call.field != nullptr) {
            check_number(std::string(call.field->path), value.number,
                         {call.field->min, call.field->max, call.field->unit});
        } else {
            const VariableInfo& info = board.profile().variables[*call.variable];
            check_number(std::string(variable_prefix) + info.name, value.number, {info.min, info.max, ""});
        }
    }
}

}  // namespace fauxboard::control
