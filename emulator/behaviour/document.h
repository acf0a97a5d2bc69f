#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/source.h"

namespace fauxboard::behaviour {

/// A JSON document that knows where each of its values stands, after `extends` was resolved.
struct Document {
    struct Place {
        std::size_t file = 0;
        std::size_t line = 0;
    };
    Json root;
    std::vector<std::string> files;
    std::map<std::string, Place, std::less<>> places;  ///< by JSON pointer

    Problem problem(std::string_view pointer, std::string message, std::string nearest = {}) const;
};

/// Parses one text. Throws ProfileError: no JSON, a key given twice, nested deeper than 64.
Document parse_document(const SourceText& source);

/// Loads `name` and all that it extends: objects are merged key by key, null takes a key away, everything
/// else is replaced. Throws ProfileError, also for a circle and for chains longer than 8.
Document load_document(const SourceText& source, const SourceFinder& find);

}  // namespace fauxboard::behaviour
