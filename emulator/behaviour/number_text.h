#pragma once

#include <span>

#include "emulator/behaviour/written.h"

namespace fauxboard::behaviour {

/// Writes `value` as C's "%.<decimals>f" does, correctly rounded, at most 6 decimals. Numbers beyond +-1e15
/// are written as the bound. Nothing is written when it does not fit. Common sizes take a few
/// nanoseconds, the rest goes through the fmt library.
Written write_fixed(std::span<char> out, double value, int decimals);

}  // namespace fauxboard::behaviour
