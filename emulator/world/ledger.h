#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/machine/sim_time.h"
#include "emulator/world/print_watch.h"

namespace fauxboard::world {

using machine::SimTime;

/// What a world has seen of its board, as far as invariants speak of it. Written by the world as it happens,
/// read by invariants.cpp alone.
struct Ledger {
    SimTime before{0};  ///< the board's time after the last step
    SimTime now{0};     ///< the world's

    // Lines, as the observer was told, since the board was made.
    std::uint64_t lines_heard = 0;
    std::uint64_t lines_said = 0;

    // The USB side. Commands that a reset or a power cut swallowed are neither.
    std::uint64_t commands_taken = 0;
    std::uint64_t commands_acknowledged = 0;
    bool ok_of_resend = false;        ///< the next ok belongs to a line that is to be sent again
    std::uint64_t damaged_taken = 0;  ///< frames with a wrong checksum that were carried out all the same
    std::uint64_t lost_counted = 0;   ///< lines that were not taken, and whose number counts as taken

    // The job under way.
    std::uint64_t job_byte = 0;
    std::uint64_t job_number = 0;  ///< counts starts and deliberate jumps within a file
    std::uint64_t job_seen = 0;
    std::uint64_t job_executed = 0;  ///< where it was last executed
    bool paused = false;             ///< since the last step
    bool job_over = false;           ///< the last one came to its end, or was ended

    PrintWatch prints;
    std::optional<Tally> proof;  ///< what the print at the end should come to; nothing: there was none

    std::string eeprom_at_first;  ///< its image when the board was made: the factory's, or what was kept

    bool harmed = false;  ///< some of the printer was broken since power-on
    bool misset = false;  ///< settings were changed with which a printer may be unable to print

    // What one call did.
    std::size_t most_output = 0;
    std::uint64_t most_bytes_read = 0;
    std::uint64_t stops_at_one_moment = 0;

    // Files: all that ever was the whole content of one.
    std::map<std::string, std::set<std::string>, std::less<>> whole;
    // Places at which a job really was, by path.
    std::map<std::string, std::set<std::uint64_t>, std::less<>> places;

    // A good request on each line, put to the board once it has been given peace.
    std::vector<std::string> unanswered;

    // A walk of the head by many short moves at the end: where it should have led, and where it did.
    struct Walk {
        std::array<double, 2> asked_mm{};
        std::array<double, 2> came_mm{};
    };
    std::vector<Walk> walks;
    int too_soon = 0;       ///< answers that came within a turn, when there should have been one
    bool unheard = false;   ///< the user has continued again and again, and the board still waits for him
    std::string not_saved;  ///< a file that was acknowledged and is not there
};

}  // namespace fauxboard::world
