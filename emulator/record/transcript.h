#pragma once

#include <cstdint>
#include <deque>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/record/recording.h"
#include "protocol/catalogue.h"

namespace fauxboard::record {

/// The line as a board takes it: NULs, which an A30 screen sends behind its message at power-up, do not
/// count.
std::string without_nuls(std::string_view line);

/// Who must have said this line: the direction in which alone all of it is in the catalogue. Nothing for a
/// line that either could have said, that nobody knows, or whose checksum is wrong.
std::optional<protocol::Direction> telling_direction(std::string_view line);

/// The same for a line of which somebody wants to read all the same: the likelier of the two.
protocol::Direction likely_direction(std::string_view line,
                                     std::optional<protocol::Direction> if_open = std::nullopt);

/// One line of a transcript: some record, in some form, of what was said on a line.
struct TranscriptEntry {
    enum class Form : std::uint8_t {
        json,   ///< of a recording: {"t": 16.451778, "from": "screen", "line": "..."}
        clock,  ///< "15:15:12.123456789 - line", one direction a file; a host program's log with times
        raw,    ///< the line and nothing else
        bad,    ///< cannot be read: see `problem`
    };
    Form form = Form::raw;
    std::string file;
    std::size_t number = 0;             ///< line of the file, 1 is the first
    std::optional<machine::SimTime> t;  ///< json: as it stands there; clock: since midnight of the first day
    bool dated = false;                 ///< clock: with its date, and `t` is since 1970
    std::string clock;                  ///< as it stands there, cut to microseconds
    RecordedLine::From from = RecordedLine::From::board;
    bool guessed = false;    ///< `from` was: the form does not say it
    bool note = false;       ///< no line of a wire: what a host program logged of itself
    std::string bytes;       ///< the line without its end; of `world` the words; of `bad` how it starts
    std::uint64_t peer = 0;  ///< of datagrams, which are kept whole
    std::string problem;     ///< of `bad`: what was found and what was expected

    /// The way that the line went.
    protocol::Direction direction() const {
        return from == RecordedLine::From::board || from == RecordedLine::From::module ||
                       from == RecordedLine::From::usb
                   ? protocol::Direction::to_screen
                   : protocol::Direction::to_board;
    }
};

/// Reads a transcript of any form, line by line, each told by its content; a form that shows itself in the
/// first lines is expected of the others. Never throws for what stands there. Memory does not grow with the
/// file, nor with its lines: of a line of more than `max_text` bytes that much is looked at, and behind one
/// of more than 16 MiB nothing.
class TranscriptReader {
  public:
    static constexpr std::size_t max_text = 64UL * 1024;

    /// `in` outlives the reader; `name` is what entries call the file.
    TranscriptReader(std::istream& in, std::string name) : in_(&in), name_(std::move(name)) {}

    /// The next entry; blank lines are passed over.
    std::optional<TranscriptEntry> next();

  private:
    int next_byte();
    bool read_text();
    TranscriptEntry parse();
    TranscriptEntry parse_json();
    bool parse_clock(TranscriptEntry& entry);
    bool parse_host_log(TranscriptEntry& entry);
    TranscriptEntry parse_rest();
    TranscriptEntry entry(TranscriptEntry::Form form) const;
    TranscriptEntry bad(std::string problem) const;
    void guess(TranscriptEntry& entry);

    std::istream* in_;
    std::string name_;
    std::string text_;
    bool cut_ = false;        ///< text_ is only the start of a line
    bool given_up_ = false;   ///< that line had no end
    std::size_t number_ = 0;  ///< of the line in text_
    std::size_t lines_ = 0;   ///< line ends seen
    bool after_cr_ = false;
    std::optional<TranscriptEntry::Form> form_;  ///< seen: json or clock
    bool host_log_ = false;                      ///< it is the log of a host program
    std::optional<protocol::Direction> told_;    ///< by the last line that told it
    std::int64_t day_ = 0;
    machine::SimTime last_{0};  ///< time of day of the last line
};

/// Several transcripts as one. If all are of the clock form they are merged by time: one recorded each
/// direction. Else they come one after the other. Clock times become times since the first line of all.
class Transcripts {
  public:
    explicit Transcripts(std::vector<TranscriptReader> readers);
    std::optional<TranscriptEntry> next();

  private:
    struct Source {
        explicit Source(TranscriptReader from) : reader(std::move(from)) {}
        TranscriptReader reader;
        std::deque<TranscriptEntry> ahead;  ///< read already
        machine::SimTime shift{0};          ///< added to clock times
        machine::SimTime reached{0};        ///< shifted time of the last entry with one
        bool ended = false;
    };

    bool look_ahead(Source& source);
    void align();
    bool fill(Source& source);
    TranscriptEntry take(Source& source);
    machine::SimTime time_of_next(const Source& source) const;

    std::vector<Source> sources_;
    bool merged_ = false;
    bool aligned_ = false;
    std::size_t at_ = 0;  ///< the source being read, where they are not merged
};

}  // namespace fauxboard::record
