#pragma once

// How much fits where. Private to board/.

#include <cstddef>

#include "protocol/framing.h"

namespace fauxboard::board {

/// Longest message: a card listing.
inline constexpr std::size_t scratch_bytes = 8 * 1024;
/// A message of one line.
inline constexpr std::size_t line_bytes = protocol::max_line_bytes + 16;
/// Without pacing, output is made as input comes; beyond this much untaken, requests wait.
inline constexpr std::size_t output_limit = 16 * 1024;

}  // namespace fauxboard::board
