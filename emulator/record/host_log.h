#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

#include "emulator/machine/sim_time.h"

namespace fauxboard::record {

/// A line of the log that a host program keeps of its talk with a board.
struct HostLogLine {
    enum class Kind : std::uint8_t {
        sent,      ///< the host said it to the board
        received,  ///< the board said it to the host
        note,      ///< of the program itself: "Changing monitor state from ..."
    };
    struct Stamp {
        std::chrono::sys_days day;
        machine::SimTime time_of_day{0};
        std::string_view text;  ///< as it stands there
    };
    Kind kind = Kind::note;
    std::optional<Stamp> stamp;
    std::string_view text;  ///< the line of the wire, or the note; points into the line given
};

/// OctoPrint's serial.log ("2024-01-02 10:00:00,100 - Send: N0 M110 N0*125"), its terminal's ("Recv: ok"),
/// and what Printrun's printcore writes ("SENT: M105"). Nothing for other lines. A note is only one with a
/// stamp.
std::optional<HostLogLine> read_host_log_line(std::string_view text);

/// Whether the line begins with a date or a time of day, in whatever form: no line of a wire does.
bool begins_with_time(std::string_view text);

}  // namespace fauxboard::record
