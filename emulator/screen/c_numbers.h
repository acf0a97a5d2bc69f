#pragma once

// Private to this folder: the C library's number readers as a 32-bit ARM firmware has them.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace fauxboard::screen {

struct ReadInteger {
    std::int32_t value = 0;
    std::size_t used = 0;  ///< bytes; 0 where no number stands
};
/// strtol, base 10: blanks and a sign before it; beyond 32 bits it stops at the bound.
ReadInteger read_integer(std::string_view text);

struct ReadReal {
    float value = 0;
    std::size_t used = 0;
};
/// strtof: blanks, sign, exponent, hexadecimal, inf and nan are taken.
ReadReal read_real(std::string_view text);

}  // namespace fauxboard::screen
