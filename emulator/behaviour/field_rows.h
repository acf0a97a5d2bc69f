#pragma once

// How rows of the field tables are written, by this room and by the kinds of machines.

#include <cmath>
#include <string>
#include <type_traits>

#include "emulator/behaviour/fields.h"
#include "emulator/machine/machine.h"

namespace fauxboard::behaviour {

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

/// Rows of machines of the type M: machine::Machine for what every one has, else the machine of a kind. On a
/// machine of another kind such a field is nothing.
template <class M>
struct FieldRows {
    /// A value that is only shown; `get` computes it.
    template <class Get>
    constexpr Field shown(std::string_view path, FieldType type, std::string_view unit, std::string_view help,
                          Get) const {
        return {path, type, unit, 0, 0, false, help, getter<Get>, nullptr};
    }

    /// A value that is shown by `get` and changed by `set`, a call of the machine.
    template <class Get, class Set>
    constexpr Field handled(std::string_view path, FieldType type, std::string_view unit, double min,
                            double max, std::string_view help, Get, Set) const {
        return {path,
                type,
                unit,
                min,
                max,
                false,
                help,
                getter<Get>,
                [](machine::Machine& machine, const Value& v) {
                    if (M* own = of(machine)) {
                        Set{}(*own, v);
                    }
                }};
    }

    /// A value that simply lies in the machine's state; `place` gives a reference to it.
    template <class Place>
    constexpr Field plain(std::string_view path, FieldType type, std::string_view unit, double min,
                          double max, std::string_view help, Place) const {
        return {path,
                type,
                unit,
                min,
                max,
                false,
                help,
                getter<Place>,
                [](machine::Machine& machine, const Value& v) {
                    if (M* own = of(machine)) {
                        assign(Place{}(*own), v);
                    }
                }};
    }

    /// The same, kept in the EEPROM.
    template <class Place>
    constexpr Field stored(std::string_view path, FieldType type, std::string_view unit, double min,
                           double max, std::string_view help, Place place) const {
        Field row = plain(path, type, unit, min, max, help, place);
        row.stored = true;
        return row;
    }

  private:
    template <class T>
    static auto of(T& machine) {
        if constexpr (std::is_same_v<M, machine::Machine>) {
            return &machine;
        } else {
            return machine::as<M>(machine);
        }
    }

    template <class Get>
    static Value getter(const machine::Machine& machine) {
        // Only its type is kept: a function's name would be a pointer to nothing here.
        static_assert(std::is_empty_v<Get>, "a lambda is wanted");
        const M* own = of(machine);
        return own != nullptr ? as_value(Get{}(*own)) : Value{};
    }
};

}  // namespace fauxboard::behaviour

// A lambda that names a place in the machine, for plain() and stored().
#define FAUXBOARD_PLACE(member) \
    [](auto& m) -> auto& {      \
        return m.member;        \
    }
