#pragma once

// A line of the wire in its parts, back to bytes, and in words. For people and tools; the board itself does
// without.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/catalogue.h"
#include "protocol/framing.h"

namespace fauxboard::protocol {

/// One "N<int>" before the body.
struct DecodedPrefix {
    std::string number;  ///< "-0"
    std::string gap;     ///< the blanks behind it
};

/// One field of a body, in wire order.
struct DecodedField {
    const FieldInfo* info = nullptr;  ///< nullptr: the code knows no such field
    std::string lead;                 ///< the blanks before the key
    std::string key;   ///< as written; of an unknown field its capital letter, or all up to its colon
    std::string text;  ///< the value as written
    /// The value, when `text` is just how it prints with `decimals` digits ("-0.01", not "+1" or "007").
    std::optional<double> number;
    int decimals = 0;
    bool closed = false;  ///< the closing mark of FieldInfo was there
};

/// One line.
struct DecodedLine {
    Direction direction = Direction::to_screen;
    std::vector<DecodedPrefix> prefixes;    ///< usually one; none: a bare line
    FrameStyle style = FrameStyle::framed;  ///< framed: a checksum is there; bare lines may have one too
    std::uint8_t checksum_given = 0;        ///< when style is framed
    std::uint8_t checksum_expected = 0;     ///< the XOR of the line, when style is framed
    const CodeInfo* code = nullptr;         ///< nullptr: not in the catalogue
    std::string lead;                       ///< blanks before the body
    std::string code_text;  ///< "L24", "SD printing byte", or the first word of an unknown line
    std::vector<DecodedField> fields;
    std::string tail;  ///< blanks at the end of the body

    /// Code and all fields are in the catalogue.
    bool known() const;
    bool checksum_ok() const { return style != FrameStyle::framed || checksum_given == checksum_expected; }
    /// The first field with this key, or nullptr.
    const DecodedField* field(std::string_view key) const;
};

/// Takes one line (without its line end) apart. Never fails: what the catalogue lacks comes out as unknown.
DecodedLine decode_line(std::string_view line, Direction direction);

/// Whether only the line of a control board and its touch screen carries it: framed with "N-0", an L code, or
/// what a screen says as it starts. Hosts number from 0 up, and boards answer them in words.
bool is_of_a_screen(const DecodedLine& line);

/// What the other end of a line is called that does not say it: "screen" from the first line on that only a
/// screen's line carries, "host" before.
class PeerName {
  public:
    /// Once for each line, in their order.
    std::string_view at(const DecodedLine& line) {
        screen_ = screen_ || is_of_a_screen(line);
        return get();
    }
    std::string_view get() const { return screen_ ? "screen" : "host"; }

  private:
    bool screen_ = false;
};

/// Puts the parts together again: numbers are printed from their value and decimals, the checksum is
/// computed. Gives the bytes decoded (but for blanks behind the checksum, leading zeros in it, and a wrong
/// checksum, which comes out right). No line end.
std::string encode_line(const DecodedLine& line);

/// The body alone, without prefixes and checksum.
std::string encode_body(const DecodedLine& line);

/// The line in words, in one line of UTF-8: "temperatures: bed 22.0 °C (target 0.0 °C, off), ...". Bytes that
/// are not printable ASCII come out as \xHH. What is wrong with the frame stands in square brackets at the
/// end.
std::string explain(const DecodedLine& line);

}  // namespace fauxboard::protocol
