#include "tests/bench/mix.h"

#include <array>
#include <string_view>

#include "protocol/framing.h"

namespace fauxboard::bench {
namespace {

struct Share {
    std::string_view body;
    unsigned count;
};

constexpr std::array shares{
    Share{"M2134 FW:V1.02.xx", 2},
    Share{"M20 LCD", 1},
    Share{"M104 S200", 2},
    Share{"M105", 3},
    Share{"M27", 2},
    Share{"M2105 S2", 3},
    Share{"M2105 S4", 3},
    Share{"M2138 S1", 4},
    Share{"M165 A40 B30 C30", 5},
    Share{"M2140 S5", 12},
    Share{"M290 Z-0.05", 37},
    Share{"M290 Z0.15", 37},
    Share{"M500", 5},
    Share{"G28", 1},
};

}  // namespace

std::vector<std::string> recorded_mix() {
    std::vector<std::string> lines;
    for (const Share& share : shares) {
        lines.insert(lines.end(), share.count, protocol::frame(share.body));
    }
    return lines;
}

}  // namespace fauxboard::bench
