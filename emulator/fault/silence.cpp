#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { length };

constexpr std::array<Attribute, 1> attributes{{
    {"for", AttributeType::time, one_s, one_ms, 24 * one_hour, "how long, each time"},
}};

Interruption interrupt(const Values& values) {
    return {.length = values.time(length), .link_down = false};
}

}  // namespace

constinit const Kind silence{.name = "silence",
                             .help = "all bytes are lost for a time",
                             .attributes = attributes,
                             .interrupt = interrupt};

}  // namespace fauxboard::fault::rows
