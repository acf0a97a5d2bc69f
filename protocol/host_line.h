#pragma once

// The frame that host programs put around G-code: "N12 G1 X5*37". Both parts may be missing.

#include <cstdint>
#include <optional>
#include <string_view>

namespace fauxboard::protocol {

/// A host's line without its frame. The views point into the line given.
struct HostLine {
    std::string_view body;        ///< the command itself, blanks at both ends off
    bool numbered = false;        ///< "N12" stood before it
    std::int64_t number = 0;      ///< 12; clamped to 32 bits, as the firmware's strtol does on its processor
    bool has_checksum = false;    ///< a star stood behind it
    bool checksum_right = false;  ///< and behind it the decimal XOR of every byte before it
};

/// Takes the frame off one line (without its line end). Any bytes give some result.
///
/// The LAST star starts the checksum, and only in a numbered line or where nothing but digits stand behind
/// it: "M117 5*3=15" is a text. What is behind a ';' is a remark and no part of the body; a checksum stands
/// before it.
HostLine unframe_host_line(std::string_view line);

/// What a board that checks line numbers has against a line.
enum class HostLineFault : std::uint8_t {
    none,
    wrong_number,    ///< not the last one plus one
    wrong_checksum,  ///< not the XOR of the line
    no_checksum,     ///< a numbered line must have one
    no_number        ///< a checksum wants a number
};

/// Judges a line as Marlin's get_serial_commands() does, `last` being the number of the last good line.
/// M110 sets the number and may have any.
HostLineFault judge_host_line(const HostLine& line, std::int64_t last);

/// Whether it is an M110, which sets the number that the next lines count from.
bool sets_line_number(const HostLine& line);

/// The number that an "M110 N7" sets beside the one in front of the line; nothing where there is none.
std::optional<std::int64_t> number_set(const HostLine& line);

}  // namespace fauxboard::protocol
