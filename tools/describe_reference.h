#pragma once

// The reference, made from the tables in the code: what `fauxboard describe` prints, what
// profiles/REFERENCE.md holds, and the generated part of the profiles' schema. Tests compare the files with
// it.

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/profile.h"

namespace fauxboard::tools {

/// The parts of the reference, in its order.
inline constexpr std::array<std::string_view, 7> reference_parts{"fields", "actions", "events",   "codes",
                                                                 "faults", "control", "scenarios"};

/// The parts asked for, each under its name: an array of rows; faults, control and scenarios an object of
/// several.
nlohmann::ordered_json reference_json(std::span<const std::string_view> parts);

/// What somebody asks for by words: parts, and rows of them ("heaters.nozzle", "L3", "jam").
struct Choice {
    nlohmann::ordered_json reference;  ///< as reference_json(), with the rows asked for
    std::string wrong;                 ///< of a word that nothing has, with the nearest one; empty for none
};
/// Without words all of it. With a profile, what it calls codes of its own is among the codes.
Choice choose_reference(const std::vector<std::string>& words, const behaviour::Profile* profile = nullptr);

/// For a terminal.
std::string reference_text(const nlohmann::ordered_json& reference);

/// The whole reference as a Markdown page.
std::string reference_markdown();

/// The schema of profiles with what the tables know put in anew: the fields of `when`, `set`, `add` and
/// `defaults`, the actions with their arguments, the events. The rest stays as it is.
nlohmann::ordered_json refresh_schema(nlohmann::ordered_json schema);

/// A schema as it stands in its file.
std::string schema_text(const nlohmann::ordered_json& schema);

}  // namespace fauxboard::tools
