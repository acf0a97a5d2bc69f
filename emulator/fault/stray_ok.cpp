#include <fmt/format.h>

#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { number, where };
enum : std::size_t { before, after };

constexpr std::array<std::string_view, 2> places{"before", "after"};
constexpr std::array<Attribute, 2> attributes{{
    {"number", AttributeType::integer, 0, 0, 1e9, "n of `ok N:n`"},
    {"where", AttributeType::choice, before, 0, 1, "before the line, or behind it", places},
}};

bool applies(const LineEdit& line) {
    return line.whole();
}

void edit(LineEdit& line, const Values& values, Dice&) {
    const std::string stray = fmt::format("ok N:{}\r\n", values.count(number));
    if (line.whole() && stray.size() <= line.room) {
        line.bytes.insert(values.count(where) == before ? 0 : line.bytes.size(), stray);
    }
}

}  // namespace

constinit const Kind stray_ok{.name = "stray_ok",
                              .help =
                                  "an acknowledgement that nobody asked for comes with the line, as ChiTu "
                                  "boards send them while they print",
                              .attributes = attributes,
                              .edit = edit,
                              .applies = applies};

}  // namespace fauxboard::fault::rows
