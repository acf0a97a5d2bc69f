#include "protocol/command.h"

#include <algorithm>
#include <charconv>

#include "protocol/scan.h"

namespace fauxboard::protocol {

namespace {

constexpr double limit = 1e30;
/// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> powers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                        1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                        1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// A number as written: digits without the point, and where the point stands.
struct Decimal {
    std::uint64_t mantissa = 0;  // the first 18 significant digits
    int significant = 0;
    int exponent = 0;
    bool cut = false;  // digits beyond the 18th were left out
};

void add_digit(Decimal& decimal, char digit, bool fraction) {
    if (decimal.significant == 18) {
        decimal.cut = true;
        if (!fraction) ++decimal.exponent;
        return;
    }
    decimal.mantissa = decimal.mantissa * 10 + static_cast<std::uint64_t>(digit - '0');
    if (decimal.mantissa != 0) ++decimal.significant;
    if (fraction) --decimal.exponent;
}

int read_exponent(std::string_view text) {
    const bool negative = text.front() == '-';
    if (negative || text.front() == '+') text.remove_prefix(1);
    int value = 0;
    for (const char digit : text) {
        value = std::min(value * 10 + (digit - '0'), 100'000);
    }
    return negative ? -value : value;
}

Decimal read_decimal(std::string_view text) {
    Decimal decimal;
    bool fraction = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '.') {
            fraction = true;
        } else if (text[i] == 'e') {
            decimal.exponent += read_exponent(text.substr(i + 1));
            break;
        } else {
            add_digit(decimal, text[i], fraction);
        }
    }
    return decimal;
}

/// `text` is an unsigned number, complete.
double magnitude(std::string_view text) {
    const Decimal decimal = read_decimal(text);
    if (decimal.mantissa == 0) return 0.0;
    if (decimal.significant <= 15 && decimal.exponent >= -22 && decimal.exponent <= 22) {
        // Both factors are exact, so one operation rounds once: the nearest double, without the general
        // algorithm.
        const auto digits = static_cast<double>(decimal.mantissa);
        const auto power =
            static_cast<std::size_t>(decimal.exponent < 0 ? -decimal.exponent : decimal.exponent);
        return std::min(limit, decimal.exponent < 0 ? digits / powers[power] : digits * powers[power]);
    }
    if (decimal.significant + decimal.exponent > 32) return limit;
    double value = 0.0;  // stays so when the number is too small to hold
    std::from_chars(text.data(), text.data() + text.size(), value);
    return std::min(limit, value);
}

struct Reading {
    double value = 0.0;
    std::size_t length = 0;
};

/// Any number, by the general algorithm.
Reading read_general(std::string_view text) {
    text = text.substr(0, scan::number_length(text));
    if (text.empty()) return {};
    const std::size_t sign = text.front() == '-' || text.front() == '+' ? 1 : 0;
    const double value = magnitude(text.substr(sign));
    return {text.front() == '-' ? -value : value, text.size()};
}

/// The number that `text` begins with; its length is that of scan::number_length.
Reading read(std::string_view text) {
    // What stands on nearly every line: up to 15 digits, perhaps a point. All of it is exact but the one
    // division.
    const std::size_t sign = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    std::uint64_t mantissa = 0;
    std::size_t at = sign;
    for (; at < text.size() && scan::is_digit(text[at]); ++at) {
        mantissa = mantissa * 10 + static_cast<std::uint64_t>(text[at] - '0');
    }
    std::size_t digits = at - sign;
    std::size_t decimals = 0;
    if (at < text.size() && text[at] == '.') {
        const std::size_t point = at++;
        for (; at < text.size() && scan::is_digit(text[at]); ++at) {
            mantissa = mantissa * 10 + static_cast<std::uint64_t>(text[at] - '0');
        }
        decimals = at - point - 1;
        digits += decimals;
    }
    if (digits == 0) return {};
    if (digits > 15 || (at < text.size() && text[at] == 'e')) return read_general(text);
    double value = static_cast<double>(mantissa);
    if (decimals != 0) value /= powers[decimals];
    return {text[0] == '-' ? -value : value, at};
}

/// Reads each parameter; see Command for the rule.
void read_parameters(Command& command) {
    const std::string_view text = command.text;
    bool may_start = true;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i++];
        if (scan::is_blank(c)) {
            may_start = true;
        } else if (may_start && scan::is_capital(c)) {
            const auto index = static_cast<std::size_t>(c - 'A');
            const Reading number = read(text.substr(i));
            may_start = number.length != 0;
            if ((command.present >> index & 1U) == 0) {
                command.present |= 1U << index;
                const std::size_t blanks = may_start ? 0 : scan::blanks_at(text, i);
                command.numbers[index] = blanks == 0 ? number.value : read(text.substr(i + blanks)).value;
            }
            i += number.length;
        } else {
            may_start = false;
        }
    }
}

}  // namespace

double read_number(std::string_view text) {
    return read(text).value;
}

std::string_view Command::value_of(std::string_view key) const {
    if (key.empty()) return {};
    for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
        if (at != 0 && !scan::is_blank(text[at - 1]) && text[at - 1] != ';') continue;
        const std::string_view value = text.substr(at + key.size());
        return value.substr(0, value.find_first_of(" \t"));
    }
    return {};
}

bool parse_command(std::string_view body, Command& command) {
    body.remove_prefix(scan::blanks_at(body, 0));
    if (body.empty()) return false;
    command.letter = 0;
    command.number = 0;
    command.present = 0;
    const char first = body.front();
    const bool coded = (first == 'G' || first == 'M' || first == 'T' || first == 'L') && body.size() > 1 &&
                       scan::is_digit(body[1]);
    std::size_t end = 1;
    bool fits = coded;
    if (coded) {
        for (; fits && end < body.size() && scan::is_digit(body[end]); ++end) {
            command.number = command.number * 10 + static_cast<std::uint32_t>(body[end] - '0');
            fits = command.number <= 65535;
        }
    }
    if (fits) {
        command.letter = first;
    } else {
        command.number = 0;
        while (end < body.size() && !scan::is_blank(body[end])) {
            ++end;
        }
    }
    command.word = body.substr(0, end);
    command.text = body.substr(end);
    command.argument = scan::trim_right(command.text.substr(scan::blanks_at(command.text, 0)));
    read_parameters(command);
    return true;
}

std::optional<Command> parse_command(std::string_view body) {
    Command command;
    return parse_command(body, command) ? std::optional<Command>(command) : std::nullopt;
}

bool parse_host_command(std::string_view body, Command& command) {
    if (body.empty()) return false;
    std::size_t at = 1 + scan::blanks_at(body, 1);
    std::uint32_t number = 0;
    bool coded =
        (body[0] == 'G' || body[0] == 'M' || body[0] == 'T') && at < body.size() && scan::is_digit(body[at]);
    for (; coded && at < body.size() && scan::is_digit(body[at]); ++at) {
        number = std::min(number * 10 + static_cast<std::uint32_t>(body[at] - '0'), 100'000U);
    }
    if (coded && at < body.size() && body[at] == '.') {
        for (++at; at < body.size() && scan::is_digit(body[at]); ++at) {
        }
    }
    coded = coded && number <= 65535;
    at = coded ? at : std::min(body.find_first_of(" \t"), body.size());
    command.letter = coded ? body[0] : '\0';
    command.number = coded ? number : 0;
    command.word = body.substr(0, at);
    command.text = body.substr(at);
    command.argument = scan::trim_right(command.text.substr(scan::blanks_at(command.text, 0)));
    command.present = 0;
    for (std::size_t i = 0; i < command.text.size();) {
        const char name = command.text[i++];
        if (!scan::is_capital(name)) continue;
        const std::size_t from = i + scan::blanks_at(command.text, i);
        const Reading value = read(command.text.substr(from));
        const auto index = static_cast<std::size_t>(name - 'A');
        command.present |= 1U << index;
        command.numbers[index] = value.value;
        i = value.length == 0 ? i : from + value.length;
    }
    return true;
}

}  // namespace fauxboard::protocol
