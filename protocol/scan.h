#pragma once

// Private to this folder: the small scanners that framing, command and annotate share, so that what counts as
// a blank, a prefix, a checksum or a number is written down once.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fauxboard::protocol::scan {

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t';
}
constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_capital(char c) {
    return c >= 'A' && c <= 'Z';
}
constexpr bool is_letter(char c) {
    return is_capital(c) || (c >= 'a' && c <= 'z');
}

constexpr std::size_t blanks_at(std::string_view text, std::size_t from) {
    std::size_t end = from;
    while (end < text.size() && is_blank(text[end])) {
        ++end;
    }
    return end - from;
}

constexpr std::string_view trim_right(std::string_view text) {
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

/// `word` at the start of `text`, followed by a blank or the end.
constexpr bool starts_with_word(std::string_view text, std::string_view word) {
    return text.starts_with(word) && (text.size() == word.size() || is_blank(text[word.size()]));
}

constexpr std::size_t digits_at(std::string_view text, std::size_t from) {
    std::size_t end = from;
    while (end < text.size() && is_digit(text[end])) {
        ++end;
    }
    return end - from;
}

/// One "N<int>" at the start of a line.
struct PrefixToken {
    std::string_view number;  // "-0"
    std::size_t length;       // with the N and the blanks behind the number
};

/// The prefix `text` begins with, if any: N, a sign or none, digits, and then a blank, a capital letter, a
/// star or the end. So "Name" and "N1abc" are no prefixes.
constexpr std::optional<PrefixToken> prefix_at(std::string_view text) {
    if (text.size() < 2 || text[0] != 'N') return std::nullopt;
    const std::size_t sign = text[1] == '-' || text[1] == '+' ? 1 : 0;
    const std::size_t digits = digits_at(text, 1 + sign);
    if (digits == 0) return std::nullopt;
    const std::size_t end = 1 + sign + digits;
    if (end < text.size() && !is_blank(text[end]) && !is_capital(text[end]) && text[end] != '*') {
        return std::nullopt;
    }
    return PrefixToken{text.substr(1, sign + digits), end + blanks_at(text, end)};
}

enum class StarTail : std::uint8_t { no_star, nothing, number, bad_number, other };

/// What stands behind the last star of a line.
struct ChecksumToken {
    StarTail tail;
    std::size_t star;    // where the star stands; the length of the line where there is none
    std::uint8_t value;  // for StarTail::number
};

/// Up to three digits, at most 255, are a number; more or larger is a bad number; anything else is `other`.
/// Blanks behind the digits do not count.
inline ChecksumToken checksum_of(std::string_view line) {
    const std::size_t star = line.rfind('*');
    if (star == std::string_view::npos) return {StarTail::no_star, line.size(), 0};
    const std::string_view tail = trim_right(line.substr(star + 1));
    if (tail.empty()) return {StarTail::nothing, star, 0};
    unsigned value = 0;
    for (const char digit : tail) {
        if (!is_digit(digit)) return {StarTail::other, star, 0};
        value = value * 10 + static_cast<unsigned>(digit - '0');
    }
    if (tail.size() > 3 || value > 255) return {StarTail::bad_number, star, 0};
    return {StarTail::number, star, static_cast<std::uint8_t>(value)};
}

/// Bytes of the number `text` begins with: sign, digits, point, digits, and an exponent behind a small e (a
/// capital E is the extruder's letter). 0 where there is no digit, so "nan", "inf", "-" and "" are none, and
/// "0x10" is "0".
constexpr std::size_t number_length(std::string_view text) {
    std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const std::size_t whole = digits_at(text, at);
    at += whole;
    std::size_t fraction = 0;
    if (at < text.size() && text[at] == '.') {
        fraction = digits_at(text, at + 1);
        if (whole + fraction != 0) at += 1 + fraction;
    }
    if (whole + fraction == 0) return 0;
    if (at < text.size() && text[at] == 'e') {
        const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+') ? 1 : 0;
        const std::size_t digits = digits_at(text, at + 1 + sign);
        if (digits != 0) at += 1 + sign + digits;
    }
    return at;
}

}  // namespace fauxboard::protocol::scan
