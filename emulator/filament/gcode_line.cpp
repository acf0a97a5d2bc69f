#include "emulator/filament/gcode_line.h"

#include <algorithm>

namespace fauxboard::filament {
namespace {

constexpr double largest = 1e9;
constexpr int largest_code = 99999;
/// Digits that fit into 64 bits whatever they are.
constexpr int exact_digits = 18;

constexpr std::array<double, exact_digits + 1> shrink{1e0,   1e-1,  1e-2,  1e-3,  1e-4,  1e-5,  1e-6,
                                                      1e-7,  1e-8,  1e-9,  1e-10, 1e-11, 1e-12, 1e-13,
                                                      1e-14, 1e-15, 1e-16, 1e-17, 1e-18};

bool blank(char c) {
    return static_cast<unsigned char>(c) <= ' ';
}

bool digit(char c) {
    return c >= '0' && c <= '9';
}

/// A capital; 0 for all else.
char capital(char c) {
    return c >= 'A' && c <= 'Z' ? c : '\0';
}

const char* skip_blanks(const char* at, const char* end) {
    while (at != end && blank(*at)) {
        ++at;
    }
    return at;
}

const char* read_decimal(const char* at, const char* end, double& out) {
    bool negative = false;
    if (at != end && (*at == '-' || *at == '+')) {
        negative = *at == '-';
        ++at;
    }
    std::uint64_t digits = 0;
    int count = 0;
    int decimals = 0;
    double beyond = 1;  // factor of the digits that no longer fit
    for (; at != end && digit(*at); ++at) {
        if (count < exact_digits) {
            digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
            count += digits != 0 ? 1 : 0;
        } else {
            beyond = std::min(beyond * 10, largest);
        }
    }
    if (at != end && *at == '.') {
        for (++at; at != end && digit(*at); ++at) {
            if (count < exact_digits && decimals < exact_digits) {
                digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
                count += digits != 0 ? 1 : 0;
                ++decimals;
            }
        }
    }
    const double value =
        std::min(static_cast<double>(digits) * beyond * shrink[static_cast<std::size_t>(decimals)], largest);
    out = negative ? -value : value;
    return at;
}

/// Where the command's text ends: at a comment or a checksum.
const char* end_of_command(const char* at, const char* end) {
    while (at != end && *at != ';' && *at != '*') {
        ++at;
    }
    return at;
}

const char* skip_remark(const char* at, const char* end) {
    at = std::find(at, end, ')');
    return at == end ? end : at + 1;
}

/// The letter and number of the command itself; a line number in front of it is passed over.
const char* read_code(const char* at, const char* end, GcodeLine& out) {
    for (bool first = true;; first = false) {
        at = skip_blanks(at, end);
        while (at != end && *at == '(') {
            at = skip_blanks(skip_remark(at, end), end);
        }
        const char letter = at == end ? '\0' : *at;
        if (capital(letter) == 0 && !(letter >= 'a' && letter <= 'z')) {
            return at;
        }
        const char* const number_at = skip_blanks(at + 1, end);
        double number = 0;
        const char* const behind = read_decimal(number_at, end, number);
        if (letter == 'N' && first) {
            at = behind;
            continue;
        }
        out.letter = letter;
        // A word is no code, whatever its first letter: "TIMELAPSE_TAKE_FRAME" is not T0.
        const bool numbered = number_at != end && digit(*number_at);
        out.code = numbered ? static_cast<int>(std::min(number, double{largest_code})) : GcodeLine::no_code;
        return numbered ? behind : at + 1;
    }
}

}  // namespace

double take_decimal(std::string_view& text) {
    double value = 0;
    const char* const behind = read_decimal(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(behind - text.data()));
    return value;
}

void parse_gcode(std::string_view line, GcodeLine& out) {
    out.letter = 0;
    out.code = 0;
    out.comment = {};
    out.text = {};
    out.clear_parameters();
    const char* const end = line.data() + line.size();
    const char* at = read_code(line.data(), end, out);
    const char* const text = skip_blanks(at, end);
    while (at != end && *at != ';' && *at != '*') {
        const char name = capital(*at);
        if (name != 0) {
            double value = 0;
            at = read_decimal(skip_blanks(at + 1, end), end, value);
            out.set(name, value);
        } else {
            at = *at == '(' ? skip_remark(at, end) : at + 1;
        }
    }
    const char* behind = end_of_command(std::min(text, at), end);
    while (behind > text && blank(behind[-1])) {
        --behind;
    }
    if (behind > text) {
        out.text = {text, static_cast<std::size_t>(behind - text)};
    }
    const char* const comment = std::find(at, end, ';');
    if (comment != end) {
        out.comment = {comment + 1, static_cast<std::size_t>(end - comment - 1)};
    }
}

}  // namespace fauxboard::filament
