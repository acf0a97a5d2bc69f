#include "emulator/record/transcript.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <utility>

#include "emulator/record/host_log.h"
#include "protocol/annotate.h"
#include "protocol/secrets.h"

namespace fauxboard::record {
namespace {

using machine::SimTime;
using protocol::Direction;
using Form = TranscriptEntry::Form;

constexpr SimTime one_second{1'000'000};
constexpr SimTime one_day = one_second * 86'400;
constexpr std::size_t shown_of_bad = 80;  // bytes
constexpr std::size_t most_passed_over = 16UL * 1024 * 1024;

struct ClockStamp {
    SimTime time_of_day{0};
    std::size_t clock_length = 0;  ///< of the text, to the microsecond
    std::size_t length = 0;        ///< with " - "
};

/// Two digits at `at`, up to `max`.
std::optional<int> two_digits(std::string_view text, std::size_t at, int max) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + at + 2, value);
    if (error != std::errc{} || end != text.data() + at + 2 || value < 0 || value > max) {
        return std::nullopt;
    }
    return value;
}

/// "15:15:12.123456789 - ", as `date +%T.%N` and an echo write it; up to nine digits behind the point, or no
/// point.
std::optional<ClockStamp> clock_stamp(std::string_view text) {
    constexpr std::size_t seconds_end = 8;
    if (text.size() < seconds_end || text[2] != ':' || text[5] != ':') {
        return std::nullopt;
    }
    const auto hours = two_digits(text, 0, 23);
    const auto minutes = two_digits(text, 3, 59);
    const auto seconds = two_digits(text, 6, 60);  // leap seconds
    if (!hours || !minutes || !seconds) {
        return std::nullopt;
    }
    ClockStamp stamp;
    stamp.time_of_day = one_second * (*hours * 3600 + *minutes * 60 + *seconds);
    std::size_t at = seconds_end;
    stamp.clock_length = at;
    if (at < text.size() && text[at] == '.') {
        SimTime digit = one_second / 10;
        const std::size_t first = ++at;
        for (; at < text.size() && at < first + 9 && text[at] >= '0' && text[at] <= '9'; ++at) {
            stamp.time_of_day += digit * (text[at] - '0');
            digit /= 10;
        }
        if (at == first) {
            return std::nullopt;
        }
        stamp.clock_length = std::min(at, first + 6);
    }
    // The echo that wrote it takes blanks off the line; an empty one leaves " -".
    if (!text.substr(at).starts_with(" -") || (text.size() > at + 2 && text[at + 2] != ' ')) {
        return std::nullopt;
    }
    stamp.length = std::min(text.size(), at + 3);
    return stamp;
}

bool blank(std::string_view text) {
    return text.find_first_not_of(" \t") == std::string_view::npos;
}

}  // namespace

std::string without_nuls(std::string_view line) {
    std::string out(line);
    std::erase(out, '\0');
    return out;
}

std::optional<Direction> telling_direction(std::string_view bytes) {
    const std::string line = without_nuls(bytes);
    const protocol::DecodedLine reply = protocol::decode_line(line, Direction::to_screen);
    if (!reply.checksum_ok()) {
        return std::nullopt;
    }
    const bool could_reply = reply.known();
    const bool could_request = protocol::decode_line(line, Direction::to_board).known();
    if (could_reply == could_request) {
        return std::nullopt;
    }
    return could_reply ? Direction::to_screen : Direction::to_board;
}

Direction likely_direction(std::string_view bytes, std::optional<Direction> if_open) {
    const std::string line = without_nuls(bytes);
    const protocol::DecodedLine reply = protocol::decode_line(line, Direction::to_screen);
    const protocol::DecodedLine request = protocol::decode_line(line, Direction::to_board);
    if (reply.known() != request.known()) {
        return reply.known() ? Direction::to_screen : Direction::to_board;
    }
    if (if_open) {
        return *if_open;
    }
    return reply.code == nullptr && request.code != nullptr ? Direction::to_board : Direction::to_screen;
}

// ---- one file ----

/// A disk that fails in the middle throws out of the stream's buffer: the end, and the stream is bad.
int TranscriptReader::next_byte() {
    try {
        return in_->rdbuf()->sbumpc();
    } catch (const std::ios_base::failure&) {
        in_->setstate(std::ios::badbit);
        return std::char_traits<char>::eof();
    }
}

/// The next line into text_, its end left off. A line ends with LF, CR or CR LF. False at the end.
bool TranscriptReader::read_text() {
    if (given_up_) {
        return false;
    }
    text_.clear();
    cut_ = false;
    number_ = lines_ + 1;
    std::size_t passed_over = 0;
    for (;;) {
        const int c = next_byte();
        if (c == std::char_traits<char>::eof()) {
            return !text_.empty();
        }
        const bool lf_of_cr = c == '\n' && std::exchange(after_cr_, false);
        if (lf_of_cr) {
            continue;
        }
        after_cr_ = c == '\r';
        if (c == '\n' || c == '\r') {
            ++lines_;
            return true;
        }
        if (text_.size() == max_text) {
            cut_ = true;
            if (++passed_over == most_passed_over) {
                in_->setstate(std::ios::badbit);  // zeros without end, a disk's image: no text
                return given_up_ = true;
            }
        } else {
            text_ += static_cast<char>(c);
        }
    }
}

std::optional<TranscriptEntry> TranscriptReader::next() {
    while (read_text()) {
        if (blank(text_)) {
            continue;
        }
        TranscriptEntry out = parse();
        out.bytes = protocol::mask_secrets(out.bytes);
        if (out.form == Form::bad || !blank(out.bytes)) {
            return out;
        }
    }
    return std::nullopt;
}

TranscriptEntry TranscriptReader::entry(Form form) const {
    TranscriptEntry out;
    out.form = form;
    out.file = name_;
    out.number = number_;
    return out;
}

TranscriptEntry TranscriptReader::bad(std::string problem) const {
    TranscriptEntry out = entry(Form::bad);
    out.problem = std::move(problem);
    out.bytes = text_.substr(0, shown_of_bad);
    return out;
}

TranscriptEntry TranscriptReader::parse() {
    if (cut_) {
        return bad(given_up_ ? "a line of more than 16 MiB; it and what is behind it is not read"
                             : "a line of more than 64 KiB");
    }
    if (text_[text_.find_first_not_of(" \t")] == '{') {
        return parse_json();
    }
    TranscriptEntry out = entry(Form::raw);
    if (form_ != Form::json && parse_host_log(out)) {
        return out;
    }
    out.form = Form::clock;
    if (!host_log_ && parse_clock(out)) {
        form_ = Form::clock;
        return out;
    }
    return parse_rest();
}

/// A line that shows no form: what it is follows from those before it.
TranscriptEntry TranscriptReader::parse_rest() {
    TranscriptEntry out = entry(Form::raw);
    out.bytes = text_;
    if (host_log_) {
        out.note = true;  // more of a note that has several lines
        return out;
    }
    if (form_) {
        return bad(*form_ == Form::json ? "no JSON object, in a recording of JSON lines"
                                        : "no time of day, in a recording of 'HH:MM:SS.nnnnnnnnn - line'");
    }
    if (begins_with_time(text_)) {
        return bad(
            "it begins with a date or a time, in a form that decode does not know (its --help names "
            "those that it does)");
    }
    guess(out);
    return out;
}

/// The log of a host program says who said each line. Clocks that are set back do not turn time round.
bool TranscriptReader::parse_host_log(TranscriptEntry& out) {
    const auto line = read_host_log_line(text_);
    if (!line) {
        return false;
    }
    host_log_ = true;
    out.note = line->kind == HostLogLine::Kind::note;
    out.from = line->kind == HostLogLine::Kind::received ? RecordedLine::From::usb : RecordedLine::From::host;
    out.bytes = line->text;
    if (line->stamp) {
        out.form = Form::clock;
        out.dated = true;
        last_ = std::max(last_, line->stamp->day.time_since_epoch() + line->stamp->time_of_day);
        out.t = last_;
        out.clock = line->stamp->text;
    }
    return true;
}

TranscriptEntry TranscriptReader::parse_json() {
    static constexpr std::string_view where = "json:1: ";  // what the reader's sentences start with here
    std::istringstream line(text_);
    try {
        std::optional<RecordedLine> recorded = RecordingReader(line, "json").next();
        if (!recorded) {
            TranscriptEntry note = entry(Form::raw);
            note.note = true;
            note.bytes = text_;
            return note;
        }
        form_ = Form::json;
        TranscriptEntry out = entry(Form::json);
        out.t = recorded->t;
        out.from = recorded->from;
        out.bytes = std::move(recorded->bytes);
        out.peer = recorded->peer;
        return out;
    } catch (const RecordingError& error) {
        std::string_view sentence = error.what();
        sentence.remove_prefix(sentence.starts_with(where) ? where.size() : 0);
        return bad(std::string(sentence));
    }
}

bool TranscriptReader::parse_clock(TranscriptEntry& out) {
    const auto stamp = clock_stamp(text_);
    if (!stamp) {
        return false;
    }
    if (last_ - stamp->time_of_day > one_day / 2) {
        ++day_;  // past midnight
    }
    last_ = stamp->time_of_day;
    out.t = stamp->time_of_day + one_day * day_;
    out.clock = text_.substr(0, stamp->clock_length);
    out.bytes = text_.substr(stamp->length);
    guess(out);
    return true;
}

/// A file with times of day holds one direction, so a line that does not tell goes with the one that did.
void TranscriptReader::guess(TranscriptEntry& out) {
    const Direction direction = likely_direction(out.bytes, out.form == Form::clock ? told_ : std::nullopt);
    out.from = direction == Direction::to_screen ? RecordedLine::From::board : RecordedLine::From::screen;
    out.guessed = true;
    if (const auto told = telling_direction(out.bytes)) {
        told_ = told;
    }
}

// ---- several files ----

Transcripts::Transcripts(std::vector<TranscriptReader> readers) {
    for (TranscriptReader& reader : readers) {
        sources_.emplace_back(std::move(reader));
    }
    // A single one is not read ahead: its lines may come as they are said.
    merged_ = sources_.size() > 1;
    for (Source& source : sources_) {
        merged_ = merged_ && look_ahead(source);
    }
    if (merged_) {
        align();
    }
}

bool Transcripts::fill(Source& source) {
    if (source.ahead.empty() && !source.ended) {
        auto entry = source.reader.next();
        source.ended = !entry;
        if (entry) {
            source.ahead.push_back(std::move(*entry));
        }
    }
    return !source.ahead.empty();
}

/// Whether one of the first lines has a time of day.
bool Transcripts::look_ahead(Source& source) {
    constexpr std::size_t far_enough = 8;
    while (source.ahead.size() < far_enough) {
        auto entry = source.reader.next();
        if (!entry) {
            source.ended = true;
            break;
        }
        const bool clock = entry->form == Form::clock;
        source.ahead.push_back(std::move(*entry));
        if (clock) {
            return true;
        }
    }
    return false;
}

/// Files without dates are of the same day, or two days in a row: half a day apart, the earlier time of day
/// is the later day's.
void Transcripts::align() {
    SimTime latest{0};
    for (const Source& source : sources_) {
        latest = std::max(latest, *source.ahead.back().t);
    }
    SimTime origin = machine::never;
    for (Source& source : sources_) {
        const SimTime first = *source.ahead.back().t;
        const bool next_day = !source.ahead.back().dated && latest - first > one_day / 2;
        source.shift = next_day ? one_day : SimTime{0};
        origin = std::min(origin, first + source.shift);
    }
    for (Source& source : sources_) {
        source.shift -= origin;
    }
    aligned_ = true;
}

SimTime Transcripts::time_of_next(const Source& source) const {
    const TranscriptEntry& entry = source.ahead.front();
    return entry.t ? *entry.t + source.shift : source.reached;
}

TranscriptEntry Transcripts::take(Source& source) {
    TranscriptEntry entry = std::move(source.ahead.front());
    source.ahead.pop_front();
    if (entry.form == Form::clock) {
        if (!std::exchange(aligned_, true)) {
            source.shift = -*entry.t;
        }
        entry.t = *entry.t + source.shift;
        source.reached = *entry.t;
    }
    return entry;
}

std::optional<TranscriptEntry> Transcripts::next() {
    if (!merged_) {
        for (; at_ < sources_.size(); ++at_, aligned_ = false) {
            if (fill(sources_[at_])) {
                return take(sources_[at_]);
            }
        }
        return std::nullopt;
    }
    Source* earliest = nullptr;
    for (Source& source : sources_) {
        if (fill(source) && (earliest == nullptr || time_of_next(source) < time_of_next(*earliest))) {
            earliest = &source;
        }
    }
    return earliest != nullptr ? std::optional(take(*earliest)) : std::nullopt;
}

}  // namespace fauxboard::record
