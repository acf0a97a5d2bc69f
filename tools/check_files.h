#pragma once

// What `fauxboard check` finds out about a file, without printing it.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/document.h"
#include "emulator/behaviour/profile.h"

namespace fauxboard::tools {

/// A rule of the schema that a document breaks.
struct SchemaError {
    std::string pointer;  ///< JSON pointer; "" the whole document
    std::string message;
};

/// What is wrong by the schema: the innermost places only, each once. Throws std::runtime_error when `schema`
/// is none.
std::vector<SchemaError> check_schema(const nlohmann::json& schema, const nlohmann::json& document);

struct CheckedFile {
    std::string file;
    bool readable = true;
    std::string nearest;  ///< for a name that is not known: what may have been meant, with its kind
    std::vector<behaviour::Problem> problems;
    std::string remark;  ///< what could not be checked, and why, or what is worth knowing; may be empty
};

/// What a profile may send in one go that is more than its screen's receiving ring holds; empty: nothing.
std::string overrun_remark(const behaviour::Profile& profile);

/// Checks one file, or a profile by name: first its meaning, with all that it extends, then its form against
/// the schema in the profiles' folders. What the loader has found already is not told twice.
CheckedFile check_file(const std::string& file);

}  // namespace fauxboard::tools
