#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/value.h"
#include "emulator/machine/machine.h"
#include "protocol/command.h"

namespace fauxboard::behaviour {

/// What an expression of a profile can see while it is evaluated.
struct Scope {
    const machine::Machine& machine;
    std::span<const double> variables;           ///< the profile's own, one set per board
    const protocol::Command* command = nullptr;  ///< the request; null in events and on the schedule
    const machine::CardEntry* entry = nullptr;   ///< inside `for_each`
    std::size_t index = 0;
};

/// Names that only the profile knows, while it is compiled.
struct Names {
    std::map<std::string, std::size_t, std::less<>> variables;
    bool request = false;  ///< parameters of a request may be used
    bool loop = false;     ///< entry.name, entry.index, entry.bytes and entry.folder may be used
};

/// A wrong expression. `what()` says what was found and expected; `nearest` is the known name most like it.
struct ExpressionError : std::runtime_error {
    ExpressionError(const std::string& message, std::string nearest_name)
        : std::runtime_error(message), nearest(std::move(nearest_name)) {}
    std::string nearest;
};

/// One value of an expression: a literal, or something looked up.
struct Operand {
    enum class Kind : std::uint8_t {
        none,
        number,
        text,
        field,
        variable,
        parameter,  ///< {S}: the number after S
        presence,   ///< {S?}: 1 when S stands on the line
        argument,   ///< {arg}: everything after the code, blanks trimmed
        name,       ///< {name}: the same without quotes and the colon of an absolute path
        file,       ///< {file}: the name of a file in it: up to the first blank, or from '!' to '#'
        raw_text,   ///< {text}: everything after the code, leading blank included
        keyed,      ///< {FW:}: the word after "FW:"
        behind,     ///< {ETE...}: all after the first "ETE", wherever it stands, up to a star
        entry_name,
        entry_index,
        entry_bytes,
        entry_folder,
        entry_long_name,
        entry_stamp,
    };
    Kind kind = Kind::none;
    char letter = 0;
    double number = 0;
    const Field* field = nullptr;
    std::size_t variable = 0;
    std::string text;                ///< literal, or the key of `keyed` and `behind`
    std::optional<double> fallback;  ///< {S|255}

    static Operand literal(double n);
    static Operand literal(std::string t);

    /// Nothing when a parameter is not on the line.
    Value evaluate(const Scope& scope) const {
        // What rules and frames are mostly made of, without a call.
        if (kind == Kind::field) {
            return field->get(scope.machine);
        }
        if (kind == Kind::number) {
            return Value::of(number);
        }
        if (kind == Kind::parameter && scope.command != nullptr && scope.command->has(letter)) {
            return Value::of(*scope.command->number_of(letter));
        }
        return evaluate_other(scope);
    }
    /// Whether the value is a text; parameters and fields say by their kind.
    bool is_text() const;

  private:
    Value evaluate_other(const Scope& scope) const;
};

/// Compiles what stands between braces: a field path, `var.NAME`, a parameter. Throws ExpressionError.
Operand parse_reference(std::string_view reference, const Names& names);

}  // namespace fauxboard::behaviour
