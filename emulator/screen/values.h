#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::behaviour {
struct Field;
struct List;
}  // namespace fauxboard::behaviour

namespace fauxboard::screen {

enum class ValueKind : std::uint8_t { number, text, list };

/// Where a value comes from that no frame brings: the line that is being taken, or the page that is open.
enum class ValueSource : std::uint8_t { own, line_bytes, longest_word, page };

/// One thing a screen knows and may show, as its profile declares it: "nozzle.target".
struct ValueInfo {
    std::string name;
    ValueKind kind = ValueKind::number;
    ValueSource is = ValueSource::own;
    std::string unit;                           ///< for people; may be empty
    std::string help;                           ///< one sentence; may be empty
    double start = 0;                           ///< at power-on
    std::string start_text;                     ///< the same for texts
    std::map<std::int64_t, std::string> names;  ///< words for whole numbers; may be empty
    std::size_t most = 0;                       ///< lists: entries it holds at most
    const behaviour::Field* field = nullptr;    ///< a board's own screen: the machine's value; else its own
    const behaviour::List* source = nullptr;    ///< the same of a list
    std::vector<std::string> columns;           ///< of such a list, beside what its entries are called
    std::size_t shows_most = 0;                 ///< lists: of more than that none is shown
    bool at_end = false;                        ///< lists: shown when complete, and not as its entries come
};

/// The values of one screen, in the order of the declarations.
struct Shown {
    double number = 0;  ///< of a list: nothing; its length is its number
    std::string text;
    std::vector<std::string> list;
    std::vector<std::vector<std::string>> cells;  ///< of each entry: its columns; empty when it has none
    std::vector<std::string> coming;              ///< entries of a list that is shown when complete
};

/// All declarations of a profile. A value is known by its index from then on.
class ValueTable {
  public:
    /// False when the name is taken.
    bool add(ValueInfo info);
    std::optional<std::size_t> find(std::string_view name) const;
    /// From now on want() takes in what the machine has: the screen of a board's own reads it directly.
    void open_to_machine() { machine_ = true; }
    /// As find(); a field or a list of the machine becomes a value when it is first asked for.
    std::optional<std::size_t> want(std::string_view name);
    const ValueInfo& at(std::size_t id) const { return infos_[id]; }
    std::size_t size() const { return infos_.size(); }
    /// The declared name most like a wrong one, or "".
    std::string nearest(std::string_view name) const;
    /// What a screen that was just switched on knows.
    std::vector<Shown> power_on() const;

  private:
    std::deque<ValueInfo> infos_;  ///< one that is known stays where it is while others become known
    std::map<std::string, std::size_t, std::less<>> ids_;
    bool machine_ = false;
};

/// What an expression sees while it is evaluated.
struct Scope {
    std::span<const Shown> values;
    std::size_t row = 0;        ///< of a button that stands once per entry of a list: 1 is the first
    std::string_view row_text;  ///< that entry
    double input = 0;           ///< the number a person typed in
    std::span<const std::string> row_cells = {};  ///< columns of that entry
};

/// The number as the screens print it: `decimals` digits, never "-0.00".
std::string fixed_text(double value, int decimals);
/// Bytes of the line as UTF-8 that a terminal can be trusted with: control bytes come out as \xHH.
std::string printable(std::string_view bytes);
/// The shortest text with at most 3 decimals: 30 is "30", 0.5 is "0.5".
std::string short_text(double value);

}  // namespace fauxboard::screen
