#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { time, jitter };

constexpr std::array<Attribute, 2> attributes{{
    {"time", AttributeType::time, 200 * one_ms, 0, 60 * one_s,
     "how much later the line comes, from its arrival"},
    {"jitter", AttributeType::time, 0, 0, 60 * one_s, "a random time up to this comes on top"},
}};

Pace pace(const Values& values, Dice& dice) {
    const double us = values.number(time) + dice.fraction() * values.number(jitter);
    return {.delay = SimTime{static_cast<SimTime::rep>(us)}};
}

}  // namespace

constinit const Kind delay{.name = "delay",
                           .help = "the line comes later; what is behind it waits, so that order is kept",
                           .attributes = attributes,
                           .pace = pace};

}  // namespace fauxboard::fault::rows
