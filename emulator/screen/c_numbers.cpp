#include "emulator/screen/c_numbers.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace fauxboard::screen {
namespace {

constexpr bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}
constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Blanks and one sign; `negative` says which.
std::size_t lead(std::string_view text, bool& negative) {
    std::size_t at = 0;
    while (at < text.size() && is_space(text[at])) {
        ++at;
    }
    negative = at < text.size() && text[at] == '-';
    return at + (at < text.size() && (text[at] == '-' || text[at] == '+') ? 1 : 0);
}

/// A number beyond all that a double holds: whether it lies between 0 and the least of them.
bool too_small(std::string_view number, bool hex) {
    const std::size_t mark = std::min(number.find_first_of(hex ? "pP" : "eE"), number.size());
    std::string_view exponent_text = number.substr(std::min(mark + 1, number.size()));
    const bool minus = exponent_text.starts_with('-');
    exponent_text.remove_prefix(minus || exponent_text.starts_with('+') ? 1 : 0);
    constexpr std::int64_t endless = 1'000'000'000;
    std::int64_t exponent = 0;
    const auto read =
        std::from_chars(exponent_text.data(), exponent_text.data() + exponent_text.size(), exponent);
    exponent = read.ec == std::errc::result_out_of_range ? endless : std::min(exponent, endless);
    const std::string_view digits = number.substr(0, mark);
    const auto dot = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
    const auto first = static_cast<std::int64_t>(std::min(digits.find_first_not_of("0."), digits.size()));
    return (dot - first) * (hex ? 4 : 1) + (minus ? -exponent : exponent) < 0;
}

}  // namespace

ReadInteger read_integer(std::string_view text) {
    bool negative = false;
    const std::size_t start = lead(text, negative);
    std::int64_t value = 0;
    std::size_t at = start;
    for (; at < text.size() && is_digit(text[at]); ++at) {
        value = std::min<std::int64_t>(value * 10 + (text[at] - '0'), std::int64_t{1} << 32);
    }
    if (at == start) {
        return {};
    }
    using Limits = std::numeric_limits<std::int32_t>;
    value = std::clamp<std::int64_t>(negative ? -value : value, Limits::min(), Limits::max());
    return {static_cast<std::int32_t>(value), at};
}

ReadReal read_real(std::string_view text) {
    bool negative = false;
    const std::size_t start = lead(text, negative);
    std::string_view rest = text.substr(start);
    if (rest.starts_with('-') || rest.starts_with('+')) {
        return {};
    }
    std::chars_format format = std::chars_format::general;
    std::size_t prefix = 0;
    if (rest.size() > 2 && rest[0] == '0' && (rest[1] == 'x' || rest[1] == 'X')) {
        format = std::chars_format::hex;
        prefix = 2;
    }
    double value = 0;
    const char* begin = rest.data() + prefix;
    auto read = std::from_chars(begin, rest.data() + rest.size(), value, format);
    if (read.ec == std::errc::invalid_argument && prefix != 0) {
        read.ptr = rest.data() + 1;  // "0x" and no digit: the 0 alone
    } else if (read.ec == std::errc::invalid_argument) {
        return {};
    } else if (read.ec == std::errc::result_out_of_range) {
        const std::string_view number(begin, static_cast<std::size_t>(read.ptr - begin));
        value = too_small(number, prefix != 0) ? 0 : std::numeric_limits<double>::infinity();
    }
    constexpr double most = std::numeric_limits<float>::max();
    const auto single = value > most ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
    return {negative ? -single : single, start + static_cast<std::size_t>(read.ptr - rest.data())};
}

}  // namespace fauxboard::screen
