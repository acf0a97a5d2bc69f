#pragma once

// How rows of the field tables are written. Private to behaviour/fields_*.cpp.

#include <cmath>
#include <string>
#include <type_traits>

#include "emulator/behaviour/fields.h"

namespace fauxboard::behaviour::rows {

using machine::Printer;

template <class T>
Value as_value(const T& v) {
    if constexpr (std::is_same_v<T, std::string>) {
        return Value::of(std::string_view{v});
    } else if constexpr (std::is_same_v<T, std::string_view>) {
        return Value::of(v);
    } else {
        return Value::of(static_cast<double>(v));
    }
}

template <class T>
void assign(T& slot, const Value& v) {
    if constexpr (std::is_same_v<T, std::string>) {
        slot.assign(v.text);
    } else if constexpr (std::is_same_v<T, bool>) {
        slot = v.number != 0;
    } else if constexpr (std::is_integral_v<T>) {
        slot = static_cast<T>(std::lround(v.number));
    } else {
        slot = v.number;
    }
}

/// A value that simply lies in the machine's state; `ref` gives a reference to it.
template <class F>
constexpr Field plain(std::string_view path, FieldType type, std::string_view unit, double min, double max,
                      std::string_view help, F) {
    return {path,
            type,
            unit,
            min,
            max,
            false,
            help,
            [](const Printer& p) { return as_value(F{}(p)); },
            [](Printer& p, const Value& v) { assign(F{}(p), v); }};
}

/// The same, kept in the EEPROM.
template <class F>
constexpr Field stored(std::string_view path, FieldType type, std::string_view unit, double min, double max,
                       std::string_view help, F f) {
    Field row = plain(path, type, unit, min, max, help, f);
    row.stored = true;
    return row;
}

/// A value that is only shown; `get` computes it.
template <class F>
constexpr Field shown(std::string_view path, FieldType type, std::string_view unit, std::string_view help,
                      F) {
    return {path, type, unit, 0, 0, false, help, [](const Printer& p) { return as_value(F{}(p)); }, nullptr};
}

/// A value that is shown by `get` and changed by `set`, a call of the machine.
template <class Get, class Set>
constexpr Field handled(std::string_view path, FieldType type, std::string_view unit, double min, double max,
                        std::string_view help, Get, Set) {
    return {path,
            type,
            unit,
            min,
            max,
            false,
            help,
            [](const Printer& p) { return as_value(Get{}(p)); },
            [](Printer& p, const Value& v) { Set{}(p, v); }};
}

std::span<const Field> machine_fields();
std::span<const Field> settings_fields();
std::span<const Field> device_fields();
std::span<const Field> resin_fields();
std::span<const Field> transfer_fields();
std::span<const Field> fault_fields();

}  // namespace fauxboard::behaviour::rows

// A lambda that names a place in the printer, for plain() and stored().
#define FAUXBOARD_PLACE(member) \
    [](auto& p) -> auto& {      \
        return p.member;        \
    }
