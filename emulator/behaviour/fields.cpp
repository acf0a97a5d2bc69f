#include "emulator/behaviour/fields.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include "emulator/behaviour/field_tables.h"
#include "emulator/behaviour/kind.h"
#include "emulator/behaviour/nearest.h"

namespace fauxboard::behaviour {
namespace {

const std::vector<Field>& all() {
    static const std::vector<Field> table = [] {
        std::vector<Field> list;
        const auto append = [&](std::span<const Field> part) {
            list.insert(list.end(), part.begin(), part.end());
        };
        append(rows::device_fields());
        append(rows::host_fields());
        append(rows::transfer_fields());
        append(rows::fault_fields());
        for (const KindRow* kind : kinds()) {
            append(kind->fields());
        }
        return list;
    }();
    return table;
}

}  // namespace

std::string_view type_name(FieldType type) {
    switch (type) {
        case FieldType::number:
            return "number";
        case FieldType::integer:
            return "integer";
        case FieldType::boolean:
            return "boolean";
        case FieldType::text:
            return "text";
    }
    return "";
}

std::span<const Field> fields() {
    return all();
}

const Field* find_field(std::string_view path) {
    static const std::unordered_map<std::string_view, const Field*> index = [] {
        std::unordered_map<std::string_view, const Field*> map;
        for (const Field& field : all()) {
            map.emplace(field.path, &field);
        }
        return map;
    }();
    const auto hit = index.find(path);
    return hit == index.end() ? nullptr : hit->second;
}

std::string_view nearest_field(std::string_view path) {
    std::vector<std::string_view> names;
    for (const Field& field : all()) {
        names.push_back(field.path);
    }
    return nearest(path, names);
}

namespace {

/// Whole for an integer, 0 or 1 for a boolean.
double as_type(FieldType type, double wanted) {
    return type == FieldType::integer   ? std::round(wanted)
           : type == FieldType::boolean ? (wanted != 0 ? 1 : 0)
                                        : wanted;
}

}  // namespace

SetResult set_field(machine::Machine& machine, const Field& field, const Value& value) {
    if (field.set == nullptr) {
        return SetResult::refused;
    }
    if (field.type == FieldType::text) {
        if (!value.is_text() || field.get(machine).none()) {
            return SetResult::refused;
        }
        const auto room = static_cast<std::size_t>(field.max);
        const bool cut = value.text.size() > room;
        field.set(machine, Value::of(value.text.substr(0, room)));
        return cut ? SetResult::clamped : SetResult::done;
    }
    if (!value.is_number() || !std::isfinite(value.number) || field.get(machine).none()) {
        return SetResult::refused;
    }
    const double inside = std::clamp(value.number, field.min, field.max);
    const double wanted = as_type(field.type, inside);
    field.set(machine, Value::of(wanted));
    // The machine may allow less than the field, and keeps some numbers as floats.
    constexpr double slack = 1e-3;
    const double kept = field.get(machine).number;
    const bool as_asked =
        inside == value.number && std::abs(kept - wanted) <= slack * std::max(1.0, std::abs(wanted));
    return as_asked ? SetResult::done : SetResult::clamped;
}

}  // namespace fauxboard::behaviour
