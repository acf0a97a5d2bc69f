#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "emulator/behaviour/value.h"
#include "emulator/machine/machine.h"

namespace fauxboard::behaviour {

enum class FieldType : std::uint8_t { number, integer, boolean, text };
std::string_view type_name(FieldType type);

/// One value of the machine, declared once: frame templates, conditions, `set`, the EEPROM and the generated
/// reference all read this row.
struct Field {
    std::string_view path;
    FieldType type;
    std::string_view unit;
    double min;  ///< bounds for `set`; text: max is the number of bytes
    double max;
    bool stored;  ///< part of the EEPROM image
    std::string_view help;
    Value (*get)(const machine::Machine&);         ///< nothing on a machine of another kind
    void (*set)(machine::Machine&, const Value&);  ///< null: read only
    bool secret = false;                           ///< left out of what is made to be shared
};

/// Every field in the order of the reference: those of all machines, then each kind's. Paths are unique.
std::span<const Field> fields();

/// The field at `path`, or null.
const Field* find_field(std::string_view path);

/// The path that looks most like `path`, for error messages; empty when nothing does.
std::string_view nearest_field(std::string_view path);

enum class SetResult : std::uint8_t { done, clamped, refused };
/// Puts `value` into the field, within its bounds. Refused: read only, wrong kind, not a finite
/// number, or a field of another kind of machine.
SetResult set_field(machine::Machine& machine, const Field& field, const Value& value);

}  // namespace fauxboard::behaviour
