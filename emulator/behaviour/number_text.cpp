#include "emulator/behaviour/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace fauxboard::behaviour {
namespace {

constexpr double bound = 1e15;
constexpr std::array<double, 7> powers{1, 10, 100, 1e3, 1e4, 1e5, 1e6};

}  // namespace

std::size_t write_fixed(std::span<char> out, double value, int decimals) {
    decimals = std::clamp(decimals, 0, 6);
    value = std::isfinite(value) ? std::clamp(value, -bound, bound) : 0.0;
    const double scaled = std::fabs(value) * powers[static_cast<std::size_t>(decimals)];
    std::array<char, 40> text;
    char* end = text.data() + text.size();
    char* at = end;
    const bool small = scaled < 1e9;
    const auto whole = static_cast<std::int64_t>(small ? scaled : 0.0);
    const double rest = scaled - static_cast<double>(whole);
    if (small && std::fabs(rest - 0.5) > 1e-6) {
        auto digits = static_cast<std::uint32_t>(whole) + (rest > 0.5 ? 1U : 0U);
        for (int i = 0; i < decimals; ++i) {
            *--at = static_cast<char>('0' + digits % 10);
            digits /= 10;
        }
        if (decimals != 0) {
            *--at = '.';
        }
        do {
            *--at = static_cast<char>('0' + digits % 10);
            digits /= 10;
        } while (digits != 0);
        if (std::signbit(value)) {
            *--at = '-';
        }
    } else {
        // Near a tie the product above may have been rounded; the library decides from the exact value.
        const auto written = fmt::format_to_n(text.data(), text.size(), "{:.{}f}", value, decimals);
        at = text.data();
        end = written.out;
    }
    const auto size = static_cast<std::size_t>(end - at);
    if (size > out.size()) {
        return 0;
    }
    std::memcpy(out.data(), at, size);
    return size;
}

}  // namespace fauxboard::behaviour
