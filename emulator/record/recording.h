#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/machine/sim_time.h"

namespace fauxboard::record {

/// One entry of a recording: a line of the wire, a datagram, or something done to the machine.
struct RecordedLine {
    enum class From : std::uint8_t {
        board,    ///< the board said it to the screen
        screen,   ///< the screen said it to the board
        host,     ///< a command that came in over the board's USB port
        world,    ///< done to the machine by hand: "filament in"; see behaviour::action_words()
        usb,      ///< the board's reply over its USB port
        network,  ///< a datagram to the board
        module,   ///< a datagram from the board
        fault,    ///< said of a fault: what it did to a line, or that one of the printer begins or is over
    };
    /// Whether it is a datagram, which is kept whole.
    bool is_datagram() const { return from == From::network || from == From::module; }
    /// Whether it is a sentence for people, which nobody on a line has said.
    bool is_remark() const { return from == From::fault; }
    /// What its words stand under: "line", "do", "datagram" or "told".
    const char* key() const {
        return from == From::world ? "do" : is_datagram() ? "datagram" : is_remark() ? "told" : "line";
    }

    machine::SimTime t{0};  ///< end of the line on the wire, from the start of the recording
    From from = From::board;
    std::string bytes;  ///< the line as it went over the wire, without its line end; of `world` the words
    std::uint64_t peer = 0;  ///< of datagrams: who is at the other end, a number from 1
};

/// "board", "screen", "host", "world", "usb", "network", "module" or "fault".
std::string_view from_name(RecordedLine::From from);

/// A recording that cannot be read. what() is "FILE:LINE: what was found and what was expected".
class RecordingError : public std::runtime_error {
  public:
    RecordingError(std::string_view file, std::size_t line, std::string_view message);
};

/// Reads JSON lines, one entry each:
///     {"t": 16.451778, "from": "screen", "line": "N-0 M2134 FW:V1.02.xx*84"}
///     {"t": 135.5, "from": "world", "do": "filament in"}
///     {"t": 140.5, "from": "network", "peer": 1, "datagram": "M28 box.ctb\r\n"}
///     {"t": 150.5, "from": "fault", "told": "fault 1: drop to screen: N-0 L1 X0.000*13"}
/// `t` is in seconds, objects with a "note" and without it are passed over, bytes stand as the characters of
/// the same number (0xFF is \u00ff), blank lines are skipped, keys other than these are left alone. A line of
/// the file may have 64 KiB; memory does not grow with the file.
class RecordingReader {
  public:
    /// `name` is what errors call the file. `in` outlives the reader.
    RecordingReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

    /// The next entry, or nothing at the end. Throws RecordingError.
    std::optional<RecordedLine> next();
    /// Line of the file that next() looked at last; 1 is the first.
    std::size_t line() const { return line_; }
    const std::string& name() const { return name_; }

  private:
    int next_byte();
    bool read_text();
    std::optional<RecordedLine> parse();
    [[noreturn]] void fail(std::string_view message) const;

    std::istream& in_;
    std::string name_;
    std::string text_;
    std::size_t line_ = 0;
};

/// A recording's entries by time, of which no more than `window` are held: a small recording may be in any
/// order, a large one must be in order but for so many entries.
class OrderedRecording {
  public:
    static constexpr std::size_t window = 50'000;
    explicit OrderedRecording(RecordingReader reader) : reader_(std::move(reader)) {}
    /// The next entry, or nothing at the end. Throws RecordingError, also for one that comes too late.
    std::optional<RecordedLine> next();

  private:
    struct Held {
        RecordedLine line;
        std::uint64_t number;  ///< entries of the same time stay in their order
        bool operator>(const Held& other) const {
            return std::pair(line.t, number) > std::pair(other.line.t, other.number);
        }
    };
    RecordingReader reader_;
    std::vector<Held> heap_;
    std::uint64_t read_ = 0;
    machine::SimTime last_{0};
    bool any_ = false;
    bool ended_ = false;
};

/// Opens a recording, or throws RecordingError that says why not.
std::ifstream open_recording(const std::filesystem::path& file);
/// A whole recording, ordered by time (entries of the same time stay in the order of the file). Throws
/// RecordingError, also when the file cannot be read.
std::vector<RecordedLine> load_recording(const std::filesystem::path& file);
std::vector<RecordedLine> load_recording(std::istream& in, std::string_view name);

/// One entry as a line of a recording, "\n" included. `key` is "line" or "do". Pure ASCII, times with six
/// decimals.
std::string recording_line(machine::SimTime t, std::string_view from, std::string_view key,
                           std::string_view bytes);
std::string recording_line(const RecordedLine& line);

/// When lines have gone over the wire. A board hands over a line in one piece; on the line it takes 10 bit
/// times a byte, and cannot start before the one before it has ended. Recordings hold those ends.
class WireClock {
  public:
    explicit WireClock(unsigned baud) : baud_(baud) {}

    /// Puts `bytes` (line end included) on the wire at `now`; returns when the last bit has gone.
    machine::SimTime send(machine::SimTime now, std::size_t bytes) {
        const auto bits = static_cast<machine::SimTime::rep>(bytes) * 10;
        free_ = std::max(free_, now) + machine::SimTime{(bits * 1'000'000 + baud_ / 2) / baud_};
        return free_;
    }

  private:
    machine::SimTime::rep baud_;
    machine::SimTime free_{0};
};

}  // namespace fauxboard::record
