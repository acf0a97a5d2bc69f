#pragma once

// A request's body taken apart, without copying and without allocation.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fauxboard::protocol {

/// One request. All views point into the body it was parsed from.
///
/// A parameter is a capital letter behind a blank, behind the code, or behind another parameter's number
/// ("G1X10Y20"), with or without a number after it. A small e is an exponent ("S1e9"), a capital E the
/// extruder's parameter. Of a text ("M117 Layer 1") the table holds the letters its words start with, which
/// harms nobody.
struct Command {
    char letter = 0;            ///< 'G', 'M', 'T' or 'L'; 0 for a word such as "log", and for anything else
    std::uint32_t number = 0;   ///< 0..65535; 0 for a word
    std::string_view word;      ///< the code or word as written: "M290", "log"
    std::string_view text;      ///< all behind it, its leading blank included: "M117 Layer 1" -> " Layer 1"
    std::string_view argument;  ///< the text without blanks at either end

    /// Whether the parameter is there, with or without a number. False for anything but 'A'..'Z'.
    bool has(char parameter) const {
        return parameter >= 'A' && parameter <= 'Z' && (present >> (parameter - 'A') & 1U) != 0;
    }

    /// The number of the parameter's first occurrence; nothing when it is absent. As the firmware's strtod
    /// reads it: blanks before the number are skipped, an empty or unreadable number is 0.0. Unlike strtod it
    /// takes no inf, nan or hexadecimal (0.0), and values beyond +-1e30 become +-1e30, so that the result is
    /// always finite.
    std::optional<double> number_of(char parameter) const {
        if (!has(parameter)) return std::nullopt;
        return numbers[static_cast<std::size_t>(parameter - 'A')];
    }

    /// What stands behind `key` ("FW:") up to the next blank or the end; empty when the key is absent. The
    /// key counts at the start of the text, behind a blank and behind a semicolon only.
    std::string_view value_of(std::string_view key) const;

    // Filled by parse_command: many rules may ask for the same parameter.
    std::uint32_t present = 0;       ///< bit 0 for A, bit 25 for Z
    std::array<double, 26> numbers;  ///< of those present, what number_of() gives; of the others, anything

    // Not the compiler's own: it would set all of `numbers`, which takes longer than reading a request.
    Command() {}  // NOLINT(modernize-use-equals-default)
};

/// Takes a body (what unframe() returns) apart. A code is one of G M T L with digits right behind it; what
/// follows the digits may be anything. All else is a word: the run up to the first blank, letter 0, so junk
/// can be logged by it. So is a code over 65535 ("M99999", by which ChiTu boards are found). Nothing for an
/// empty or blank body.
std::optional<Command> parse_command(std::string_view body);

/// The same into a Command that stands there already, without copying one about: false where the other gives
/// nothing.
bool parse_command(std::string_view body, Command& command);

/// The same of a command as hosts send it and Marlin reads it: blanks may stand between letter and number
/// ("G 1"), behind a dot more digits (passed over), a parameter needs no blank before it, and of one that
/// comes twice the last counts. Only G, M and T are codes.
bool parse_host_command(std::string_view body, Command& command);

/// Reads a decimal number as number_of() does, from the first byte of `text`; what follows the number is left
/// alone.
double read_number(std::string_view text);

}  // namespace fauxboard::protocol
