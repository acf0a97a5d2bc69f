#include "protocol/framing.h"

#include <algorithm>

#include "protocol/scan.h"

namespace fauxboard::protocol {

namespace {

constexpr std::string_view prefix = "N-0 ";
constexpr std::string_view line_end = "\r\n";

constexpr std::string_view text_of(LineEnd end) {
    return end == LineEnd::crlf ? line_end : end == LineEnd::lf ? line_end.substr(1) : std::string_view{};
}

constexpr unsigned prefix_sum = 'N' ^ '-' ^ '0' ^ ' ';

char* put(char* at, std::string_view text) {
    return std::copy(text.begin(), text.end(), at);
}

std::string_view strip_nuls(std::string_view line) {
    while (!line.empty() && line.front() == '\0') {
        line.remove_prefix(1);
    }
    while (!line.empty() && line.back() == '\0') {
        line.remove_suffix(1);
    }
    return line;
}

/// `digits`: a sign or none, and digits. Clamped to int.
int number_from(std::string_view digits) {
    constexpr std::int64_t beyond = std::int64_t{1} << 31U;
    const bool negative = digits.starts_with('-');
    std::int64_t value = 0;
    for (const char digit : digits.substr(negative || digits.starts_with('+') ? 1 : 0)) {
        value = std::min(value * 10 + (digit - '0'), beyond);
    }
    return static_cast<int>(negative ? -value : std::min(value, beyond - 1));
}

/// What the policy says about a line whose bytes XOR to `expected`. `keeps_ours`: a bare M23, see unframe().
FrameFault judge(const scan::ChecksumToken& token, std::uint8_t expected, bool keeps_ours,
                 ChecksumPolicy policy) {
    if (policy == ChecksumPolicy::ignored) return FrameFault::none;
    const bool required = policy == ChecksumPolicy::required;
    switch (token.tail) {
        case scan::StarTail::number:
            if (keeps_ours && !required) return FrameFault::none;
            return token.value == expected ? FrameFault::none : FrameFault::checksum_wrong;
        case scan::StarTail::bad_number:
            return FrameFault::checksum_malformed;
        case scan::StarTail::no_star:
            return required ? FrameFault::checksum_missing : FrameFault::none;
        case scan::StarTail::nothing:
        case scan::StarTail::other:
            break;
    }
    return required ? FrameFault::checksum_malformed : FrameFault::none;
}

/// What nearly every line is, without the general way's questions: one "N-0 ", a body that begins with a
/// letter other than N, and a star with one to three digits behind it at the very end. False for anything
/// else.
bool unframe_usual(std::string_view line, ChecksumPolicy policy, Unframed& result) {
    constexpr std::size_t least = prefix.size() + 3;
    if (line.size() < least || !line.starts_with(prefix)) return false;
    const char first = line[prefix.size()];
    if (!scan::is_letter(first) || first == 'N') return false;
    unsigned value = 0;
    unsigned weight = 1;
    std::size_t star = line.size() - 1;
    for (; scan::is_digit(line[star]) && weight <= 100; --star, weight *= 10) {
        value += weight * static_cast<unsigned>(line[star] - '0');
    }
    if (line[star] != '*' || weight == 1 || value > 255) return false;
    result.body = line.substr(prefix.size(), star - prefix.size());
    result.prefixed = true;
    result.has_checksum = true;
    if (policy != ChecksumPolicy::ignored && xor_checksum(line.substr(0, star)) != value) {
        result.fault = FrameFault::checksum_wrong;
    }
    return true;
}

/// All of a frame but its body.
struct Dress {
    Dress(std::size_t body_size, unsigned body_sum, FrameStyle style, LineEnd line_ends)
        : end(text_of(line_ends)),
          head(frame_head(style)),
          starred(style == FrameStyle::framed || style == FrameStyle::star_only) {
        if (style == FrameStyle::framed) {
            sum = prefix_sum ^ body_sum;
            digits = sum > 99 ? 3 : sum > 9 ? 2 : 1;
        }
        size = head + body_size + (starred ? 1 : 0) + digits + end.size();
    }

    void put_around(char* out, std::size_t body_size) const {
        if (head != 0) put(out, prefix);
        char* at = out + head + body_size;
        if (starred) *at++ = '*';
        if (digits > 2) *at++ = static_cast<char>('0' + sum / 100);
        if (digits > 1) *at++ = static_cast<char>('0' + sum / 10 % 10);
        if (digits > 0) *at++ = static_cast<char>('0' + sum % 10);
        put(at, end);
    }

    std::string_view end;
    std::size_t head;
    std::size_t digits = 0;
    std::size_t size;
    unsigned sum = 0;
    bool starred;
};

}  // namespace

std::uint8_t xor_checksum(std::string_view bytes) {
    std::uint8_t sum = 0;
    for (const char byte : bytes) {
        sum = static_cast<std::uint8_t>(sum ^ static_cast<std::uint8_t>(byte));
    }
    return sum;
}

std::size_t frame_head(FrameStyle style) {
    return style == FrameStyle::bare ? 0 : prefix.size();
}

std::size_t dress_frame(std::span<char> out, std::size_t body_size, unsigned body_sum, FrameStyle style,
                        LineEnd end) {
    const Dress dress(body_size, body_sum, style, end);
    if (dress.size > out.size()) return 0;
    dress.put_around(out.data(), body_size);
    return dress.size;
}

std::size_t write_frame(std::span<char> out, std::string_view body, FrameStyle style) {
    const Dress dress(body.size(), xor_checksum(body), style, LineEnd::crlf);
    if (dress.size > out.size()) return 0;
    put(out.data() + dress.head, body);
    dress.put_around(out.data(), body.size());
    return dress.size;
}

std::string frame(std::string_view body, FrameStyle style) {
    std::string line(prefix.size() + body.size() + 4 + line_end.size(), '\0');
    line.resize(write_frame(line, body, style));
    return line;
}

Unframed unframe(std::string_view line, ChecksumPolicy policy) {
    if (Unframed usual; unframe_usual(line, policy, usual)) return usual;
    line = strip_nuls(line);
    line.remove_prefix(scan::blanks_at(line, 0));
    Unframed result;
    std::size_t start = 0;
    while (const auto token = scan::prefix_at(line.substr(start))) {
        result.prefixed = true;
        result.line_number = number_from(token->number);
        start += token->length;
    }
    result.body = line.substr(start);
    if (!result.prefixed && scan::starts_with_word(line, "log")) return result;

    const scan::ChecksumToken token = scan::checksum_of(line);
    result.has_checksum = token.tail == scan::StarTail::number;
    const bool keeps_ours = !result.prefixed && scan::starts_with_word(line, "M23");
    const std::uint8_t expected = result.has_checksum ? xor_checksum(line.substr(0, token.star)) : 0;
    result.fault = judge(token, expected, keeps_ours, policy);
    if (token.tail != scan::StarTail::other || policy == ChecksumPolicy::required) {
        // A prefix never holds a star, so the star stands at or behind the start of the body.
        result.body = line.substr(start, token.star - start);
    }
    return result;
}

std::size_t plain_run(std::string_view bytes) {
    // Eight bytes at a time: the expression is non-zero exactly when a byte is below 14, and so when one may
    // be NUL, LF (10) or CR (13). Text has next to none of the others.
    constexpr std::uint64_t ones = ~std::uint64_t{0} / 255;
    std::size_t at = 0;
    for (; at + 8 <= bytes.size(); at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, 8);
        if (((word - ones * 14) & ~word & (ones * 128)) == 0) continue;
        for (std::size_t i = at; i < at + 8; ++i) {
            if (bytes[i] == '\0' || bytes[i] == '\n' || bytes[i] == '\r') return i;
        }
    }
    for (; at < bytes.size(); ++at) {
        if (bytes[at] == '\0' || bytes[at] == '\n' || bytes[at] == '\r') return at;
    }
    return at;
}

}  // namespace fauxboard::protocol
