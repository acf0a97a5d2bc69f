#pragma once

#include <cstddef>
#include <cstdint>

namespace fauxboard::bench {

/// What operator new was asked for since the program began. The benchmark program replaces it to count.
struct Allocations {
    std::uint64_t calls = 0;
    std::uint64_t bytes = 0;      ///< asked for, ever
    std::int64_t live_bytes = 0;  ///< what the heap holds for those not given back
};

const Allocations& allocations();

}  // namespace fauxboard::bench
