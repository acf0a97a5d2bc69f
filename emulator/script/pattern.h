#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace re2 {
class RE2;
}

namespace fauxboard::script {

/// What named groups of patterns have found so far, by name. UTF-8.
using Captures = std::map<std::string, std::string, std::less<>>;

/// A wrong regular expression; what() says where.
class PatternError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A regular expression (RE2's syntax) over a line of the wire. Searching takes time linear in the line and
/// bounded memory, whatever the two are; so nothing that a peer sends can hold the board up.
class Pattern {
  public:
    static constexpr std::size_t most_bytes = 1024;  ///< of its text

    /// `utf8`: its characters up to U+00FF stand for bytes. Throws PatternError.
    explicit Pattern(const std::string& utf8);
    ~Pattern();

    /// Whether it is found anywhere in the line; ^ and $ are the line's ends. What its named groups
    /// (?P<name>...) found goes into `captures`; a group that took no part is an empty text.
    bool search(std::string_view line, Captures& captures) const;
    /// A measure of the memory it takes.
    std::size_t size() const;
    /// Names of its groups.
    std::vector<std::string> names() const;

  private:
    std::unique_ptr<re2::RE2> regex_;
};

}  // namespace fauxboard::script
