#include "emulator/behaviour/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "protocol/framing.h"

namespace fauxboard::behaviour {
namespace {

constexpr double bound = 1e15;
constexpr std::array<double, 7> powers{1, 10, 100, 1e3, 1e4, 1e5, 1e6};

}  // namespace

namespace {

/// Near a tie the product below may have been rounded; the library decides from the exact value.
Written write_exactly(std::span<char> out, double value, int decimals) {
    std::array<char, 40> text;
    const auto written = fmt::format_to_n(text.data(), text.size(), "{:.{}f}", value, decimals);
    const auto size = static_cast<std::size_t>(written.out - text.data());
    if (size > out.size()) {
        return {};
    }
    std::memcpy(out.data(), text.data(), size);
    return {size, protocol::xor_checksum({text.data(), size})};
}

std::size_t digits_of(std::uint32_t number) {
    std::size_t digits = 1;
    for (; number >= 1000; number /= 1000) {
        digits += 3;
    }
    return digits + (number >= 10 ? 1 : 0) + (number >= 100 ? 1 : 0);
}

/// "00" to "99", for two digits are found with one division.
constexpr auto pairs = [] {
    std::array<std::array<char, 2>, 100> all{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = {static_cast<char>('0' + i / 10), static_cast<char>('0' + i % 10)};
    }
    return all;
}();

}  // namespace

Written write_fixed(std::span<char> out, double value, int decimals) {
    decimals = std::clamp(decimals, 0, 6);
    value = std::isfinite(value) ? std::clamp(value, -bound, bound) : 0.0;
    const double scaled = std::fabs(value) * powers[static_cast<std::size_t>(decimals)];
    if (scaled >= 1e9) {
        return write_exactly(out, value, decimals);
    }
    auto number = static_cast<std::uint32_t>(scaled);
    const double rest = scaled - number;
    if (std::fabs(rest - 0.5) <= 1e-6) {
        return write_exactly(out, value, decimals);
    }
    number += rest > 0.5 ? 1U : 0U;
    const auto places = static_cast<std::size_t>(decimals);
    const std::size_t sign = std::signbit(value) ? 1 : 0;
    // Without the point; at least one digit stands before it.
    const std::size_t digits = std::max(digits_of(number), places + 1);
    const std::size_t size = sign + digits + (places != 0 ? 1 : 0);
    if (size > out.size()) {
        return {};
    }
    char* at = out.data() + size;
    unsigned sum = 0;
    const auto put = [&](unsigned character) {
        *--at = static_cast<char>(character);
        sum ^= character;
    };
    const auto put_digits = [&](std::size_t count) {
        for (; count >= 2; count -= 2, number /= 100) {
            const std::array<char, 2>& pair = pairs[number % 100];
            at -= pair.size();
            std::memcpy(at, pair.data(), pair.size());
            sum ^= static_cast<unsigned>(pair[0] ^ pair[1]);
        }
        if (count != 0) {
            put('0' + number % 10);
            number /= 10;
        }
    };
    if (places != 0) {
        put_digits(places);
        put('.');
    }
    put_digits(digits - places);
    if (sign != 0) {
        put('-');
    }
    return {size, sum};
}

}  // namespace fauxboard::behaviour
