#pragma once

#include <cstddef>
#include <span>

namespace fauxboard::behaviour {

/// Writes `value` as C's "%.<decimals>f" does, correctly rounded, at most 6 decimals. Numbers beyond +-1e15
/// are written as the bound. Returns the bytes written, 0 when they do not fit. Common sizes take a few
/// nanoseconds, the rest goes through the fmt library.
std::size_t write_fixed(std::span<char> out, double value, int decimals);

}  // namespace fauxboard::behaviour
