#include <algorithm>
#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { bytes, line_end };
enum : std::size_t { kept, lost };

constexpr std::array<std::string_view, 2> line_ends{"kept", "lost"};
constexpr std::array<Attribute, 2> attributes{{
    {"bytes", AttributeType::integer, 0, 0, 4096, "how many of its last bytes are lost; 0: a random number"},
    {"line_end", AttributeType::choice, kept, 0, 1, "whether the line end goes with them", line_ends},
}};

void edit(LineEdit& line, const Values& values, Dice& dice) {
    const std::size_t size = line.text_size();
    std::size_t left = 0;  // of a further part nothing is left
    if (line.first) {
        const std::size_t wanted = values.count(bytes) != 0 ? values.count(bytes) : 1 + dice.below(size);
        left = size - std::min(size, wanted);
    }
    line.bytes.erase(left, values.count(line_end) == lost ? std::string::npos : size - left);
}

}  // namespace

constinit const Kind cut{
    .name = "cut", .help = "the line loses its end", .attributes = attributes, .edit = edit};

}  // namespace fauxboard::fault::rows
