#include <algorithm>
#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { copies };

constexpr std::array<Attribute, 1> attributes{{
    {"copies", AttributeType::integer, 1, 1, 10, "how many times it comes again"},
}};

bool applies(const LineEdit& line) {
    return line.whole();
}

void edit(LineEdit& line, const Values& values, Dice&) {
    if (line.whole()) {
        line.copies += std::min(values.count(copies), line.room / line.copy_cost());
    }
}

}  // namespace

constinit const Kind duplicate{.name = "duplicate",
                               .help = "the line comes again at once; later faults see each copy as a line",
                               .attributes = attributes,
                               .edit = edit,
                               .applies = applies};

}  // namespace fauxboard::fault::rows
