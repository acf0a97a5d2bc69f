#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/record/recording.h"

namespace fauxboard::record {

/// A recording asks for something that a board cannot do.
struct ReplayError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct ReplayOptions {
    std::uint64_t seed = 1;
    /// How long the board is listened to after the last entry of the recording.
    machine::SimTime tail{1'000'000};
    machine::Services services{};  ///< the disks that the board has; what its recording writes, goes there
};

struct ReplayNotice {
    machine::SimTime t{0};
    behaviour::Level level{};
    std::string text;
};

struct ReplayResult {
    std::vector<RecordedLine> lines;  ///< all that the board said
    std::vector<ReplayNotice> notices;
    board::Counters counters;
};

/// What a replay is made of, and who hears of it, piece by piece: nothing of it is kept.
struct ReplayTalk {
    std::function<std::optional<RecordedLine>()> next;     ///< the recording's entries, by time
    std::optional<machine::SimTime> first_board_line;      ///< when the recorded board first spoke
    std::function<void(const RecordedLine&)> on_line;      ///< all that our board says
    std::function<void(const ReplayNotice&)> on_notice{};  ///< the first 1000 of them
};

/// A recording that is silent for longer is none, or was put together by mistake.
inline constexpr machine::SimTime longest_gap = std::chrono::hours(366 * 24);

/// Does to a fresh board in virtual time what the recording says was done to the recorded one: screen and
/// host lines and datagrams come in, and things are done to the machine, at their times. What the recorded
/// board said is not looked at, but for one thing:
///
/// The recording is taken to begin with the board's power-on. The board is switched on so that its first line
/// ends when the recorded board's first line did (0 in most recordings); without a recorded board line, at 0.
/// What is older than that met no board and is left out.
///
/// Times, in and out, are those of the end of a line on the wire. Throws ReplayError for an unknown "do", and
/// for a gap longer than longest_gap.
board::Counters replay(std::shared_ptr<const behaviour::Profile> profile, const ReplayTalk& talk,
                       const ReplayOptions& options);
/// The same of a whole recording, with all of it kept.
ReplayResult replay(std::shared_ptr<const behaviour::Profile> profile,
                    const std::vector<RecordedLine>& recording, const ReplayOptions& options);

}  // namespace fauxboard::record
