#pragma once

// The frame that host programs put around G-code: "N12 G1 X5*37". Both parts may be missing.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fauxboard::protocol {

/// Where firmwares of Marlin's family differ in what they make of a line.
struct HostLineRules {
    std::size_t most_chars = 511;    ///< of a line that count; the rest is dropped without a word (2.1: 95)
    bool drops_repeated = false;     ///< the last number, or the one before, is passed over without a word
    bool judges_unnumbered = false;  ///< a checksum wants a number
    bool first_star_ends = false;    ///< "M117 a*b" is "M117 a"; without it only a checksum is taken off
};

/// What the line reader keeps of the bytes of one line, as Marlin's does: blanks in front, all behind a ';',
/// and a '\' (whose next character stands for itself) are gone, a backspace takes the character before it,
/// and what is more than `most_chars` is dropped. Makes the copy in `room` where the line itself will not do.
std::string_view read_host_line(std::string_view bytes, std::array<char, 512>& room, std::size_t most_chars);

/// A host's line without its frame. The views point into the line given.
struct HostLine {
    std::string_view body;     ///< the command itself, blanks at both ends off
    bool numbered = false;     ///< it begins with an N; a small one is none
    bool sets_number = false;  ///< numbered, and "M110" stands in it: it may have any number
    std::int64_t number = 0;   ///< as strtol reads it, 0 for none; of an M110 the second N's, if there is one
    bool has_checksum = false;    ///< a star stood behind it
    bool checksum_right = false;  ///< and behind it the decimal XOR of every byte before it
};

/// Takes the frame off one line, as read_host_line() leaves it. Any bytes give some result.
///
/// The LAST star starts the checksum, and only in a numbered line or where nothing but digits stand behind
/// it: "M117 5*3=15" is a text.
HostLine unframe_host_line(std::string_view line, const HostLineRules& rules = {});

/// A line without what stands behind its first ';'.
std::string_view without_remark(std::string_view line);

/// What a board that checks line numbers has against a line.
enum class HostLineFault : std::uint8_t {
    none,
    repeated,        ///< had already; nothing is said to it
    wrong_number,    ///< not the last one plus one
    wrong_checksum,  ///< not the XOR of the line
    no_checksum,     ///< a numbered line must have one
    no_number        ///< a checksum wants a number
};

/// Judges a line as Marlin's get_serial_commands() does, `last` being the number of the last good line.
HostLineFault judge_host_line(const HostLine& line, std::int64_t last, const HostLineRules& rules);

}  // namespace fauxboard::protocol
