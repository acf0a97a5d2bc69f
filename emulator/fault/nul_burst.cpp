#include <algorithm>
#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { bytes, where };
enum : std::size_t { before, inside, after };

constexpr std::array<std::string_view, 3> places{"before", "inside", "after"};
constexpr std::array<Attribute, 2> attributes{{
    {"bytes", AttributeType::integer, 8, 1, 1024, "how many NUL bytes"},
    {"where", AttributeType::choice, before, 0, 2,
     "before the line, at a random place inside, or behind its end", places},
}};

void edit(LineEdit& line, const Values& values, Dice& dice) {
    if (!line.first) {
        return;
    }
    std::size_t at = 0;
    if (values.count(where) == inside) {
        at = dice.below(line.text_size());
    } else if (values.count(where) == after) {
        at = line.bytes.size();
    }
    line.bytes.insert(at, std::min(values.count(bytes), line.room), '\0');
}

}  // namespace

constinit const Kind nul_burst{
    .name = "nul_burst", .help = "NUL bytes come with the line", .attributes = attributes, .edit = edit};

}  // namespace fauxboard::fault::rows
