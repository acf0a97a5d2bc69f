#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { rate };

constexpr std::array<Attribute, 1> attributes{{
    {"rate", AttributeType::rate, 960, 1, 1e7, "bytes per second; \"9600baud\" is 960B/s"},
}};

Pace pace(const Values& values, Dice&) {
    return {.bytes_per_s = values.number(rate)};
}

}  // namespace

constinit const Kind slow{.name = "slow",
                          .help = "the bytes trickle in at a rate; what is behind them waits",
                          .attributes = attributes,
                          .pace = pace};

}  // namespace fauxboard::fault::rows
