#pragma once

#include <cstddef>
#include <string_view>

#include "emulator/behaviour/source.h"

namespace fauxboard::behaviour {

/// As deep as JSON from outside may be nested. What copies, prints or walks a value goes as deep on the
/// stack.
constexpr std::size_t most_levels = 64;

/// One value from outside: a line, a file, a word of the command line. It is_discarded() when it is not JSON,
/// or nested deeper than most_levels.
Json parse_json(std::string_view text);

}  // namespace fauxboard::behaviour
