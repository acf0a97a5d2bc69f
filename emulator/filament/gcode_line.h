#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace fauxboard::filament {

/// One line of G-code, taken apart. Points into the text it was parsed from.
struct GcodeLine {
    static constexpr int no_code = -1;
    char letter = 0;  ///< 'G', 'M', 'T' or any other, also a small one; 0 in a line without a command
    int code = 0;     ///< the whole number behind it, at most 99999; "G29.1" is 29; or no_code
    std::string_view comment;  ///< behind the first ';', without it; empty when there is none
    std::string_view text;     ///< all behind the code up to the comment or checksum, blanks at its ends off

    bool has(char name) const { return (present_ & bit(name)) != 0; }
    /// The number behind the capital `name`; 0 when it stands there without one, `otherwise` when it does
    /// not.
    double number(char name, double otherwise = 0) const {
        return has(name) ? values_[index(name)] : otherwise;
    }
    void set(char name, double value) {
        present_ |= bit(name);
        values_[index(name)] = value;
    }
    void clear_parameters() { present_ = 0; }

  private:
    static std::size_t index(char name) { return static_cast<std::size_t>(name - 'A'); }
    static std::uint32_t bit(char name) { return std::uint32_t{1} << index(name); }

    std::uint32_t present_ = 0;
    std::array<double, 26> values_;  ///< valid where present_ says so: not worth clearing for every line
};

/// Takes `line` apart; any bytes give some result. Blanks and bytes below them (NUL, tab, CR) part words, a
/// line number "N12" in front, a checksum "*34" behind and remarks in brackets are passed over, and so are
/// small letters. Numbers are plain decimals, as firmware reads them: in "X1E5" E is the next parameter,
/// no exponent. They are kept within +-1e9. Of a parameter that comes twice the last counts.
void parse_gcode(std::string_view line, GcodeLine& out);

/// Reads a plain decimal at the start of `text` ("-1.50", ".5", "+3") and takes it off; 0 when there is none.
double take_decimal(std::string_view& text);

}  // namespace fauxboard::filament
