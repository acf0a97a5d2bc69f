#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { length };

constexpr std::array<Attribute, 1> attributes{{
    {"for", AttributeType::time, 2 * one_s, one_ms, 24 * one_hour, "how long, each time"},
}};

Interruption interrupt(const Values& values) {
    return {.length = values.time(length), .link_down = true};
}

}  // namespace

constinit const Kind disconnect{.name = "disconnect",
                                .help = "the link goes down for a time, in both directions, and comes back",
                                .attributes = attributes,
                                .interrupt = interrupt};

}  // namespace fauxboard::fault::rows
