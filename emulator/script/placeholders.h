#pragma once

// ${name} in the texts of a scenario: a parameter, or what a named group of a pattern has found. $${ is ${.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/document.h"

namespace fauxboard::script {

using behaviour::Json;

/// The JSON pointer of what lies below another one under `key`.
std::string below(const std::string& pointer, std::string_view key);

/// Letters, digits and '_', at most 64 of them, no digit first.
bool is_name(std::string_view text);

/// Gives the value of a name, or nothing when it is none of the caller's.
using Lookup = std::function<std::optional<Json>(std::string_view name)>;

enum class Escapes : bool { keep, resolve };

/// The value with all its texts filled in. A text that is nothing but one placeholder takes the value as it
/// is, a number too; in a longer text numbers stand as JSON writes them. Names that `lookup` does not know
/// stay. Lists under "steps" are left alone when `steps` is false.
Json filled(const Json& value, const Lookup& lookup, Escapes escapes, bool steps);

/// Names that stand in the value, and what looks like a placeholder and is none (as "").
struct Mention {
    std::string name;
    std::string pointer;
};
std::vector<Mention> mentions(const Json& value, const std::string& pointer, bool steps);

}  // namespace fauxboard::script
