#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::behaviour {

using Json = nlohmann::ordered_json;

/// One thing that is wrong with a file, in the parts a person and an editor need.
struct Problem {
    std::string file;
    std::size_t line = 0;  ///< 1 is the first; 0 unknown
    std::string pointer;   ///< JSON pointer, "" the whole file
    std::string message;   ///< what was found and what was expected
    std::string nearest;   ///< the known name most like the wrong one; may be empty

    /// "profiles/x.json:12: /frames/L2: unknown field "heaters.nozle"; did you mean
    /// "heaters.nozzle.printed"?"
    std::string sentence() const;
};

/// Everything that is wrong, found in one go. `what()` is the sentences, a line each.
class ProfileError : public std::runtime_error {
  public:
    explicit ProfileError(std::vector<Problem> problems);
    const std::vector<Problem>& problems() const { return problems_; }

  private:
    std::vector<Problem> problems_;
};

/// A text with the name to show for it.
struct SourceText {
    std::string name;
    std::string text;
};

/// Finds the source of a profile: by name ("smartto-base"), or by path; `from` is the file that extends it,
/// empty for the first. Nothing when there is none. The only way in which the core reads files.
using SourceFinder = std::function<std::optional<SourceText>(std::string_view name, std::string_view from)>;

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
