#pragma once

// Where profiles come from and how their mistakes are told. Apart from document.h, since most of the house
// needs no more than this, and the JSON library's header takes longer to compile than most files that would
// include it.

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::behaviour {

/// Keeps the order of keys. Whoever does more than name it includes document.h.
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

/// Thrown by a finder that knows better than "no": what there is instead.
struct UnknownSource : std::runtime_error {
    UnknownSource(const std::string& message, std::string_view like)
        : std::runtime_error(message), nearest(like) {}
    std::string nearest;
};

/// Finds the source of a profile: by name ("smartto-base"), or by path; `from` is the file that extends it,
/// empty for the first. Nothing when there is none, or UnknownSource. The only way in which the core reads
/// files.
using SourceFinder = std::function<std::optional<SourceText>(std::string_view name, std::string_view from)>;

}  // namespace fauxboard::behaviour
