#include "emulator/host/line_log.h"

#include "emulator/behaviour/wire_text.h"
#include "emulator/fault/deed_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "protocol/annotate.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

constexpr std::size_t words_column = 44;  // longer lines have their words below
constexpr std::size_t text_column = 28;   // where the line itself starts
constexpr std::size_t head_width = 14;

std::string_view words_of(board::Verdict verdict) {
    switch (verdict) {
        case board::Verdict::bad_frame:
            return "  (refused: bad frame)";
        case board::Verdict::queue_full:
            return "  (lost: too many requests wait)";
        case board::Verdict::accepted:
            break;
    }
    return {};
}

LogLevel own_doings(Detail detail) {
    switch (detail) {
        case Detail::quiet:
            return LogLevel::warning;
        case Detail::verbose:
            return LogLevel::debug;
        case Detail::normal:
            break;
    }
    return LogLevel::info;
}

}  // namespace

LineLog::LineLog(TextOutput& out, Detail detail, double lines_per_second)
    : out_(out),
      detail_(detail),
      least_(own_doings(detail)),
      colours_(out.colours()),
      rate_(detail == Detail::verbose ? 0 : lines_per_second),
      burst_(4 * rate_) {
    for (Measure& measure : measures_) {
        measure.tokens = burst_;
    }
}

bool LineLog::passes(SimTime now, Kind kind) {
    if (rate_ <= 0) {
        return true;
    }
    Measure& measure = measures_[kind];
    measure.tokens = std::min(burst_, measure.tokens + machine::to_seconds(now - measure.refilled) * rate_);
    measure.refilled = now;
    if (measure.tokens < 1 || (measure.held_back != 0 && measure.tokens < burst_ / 4)) {
        ++measure.held_back;
        return false;
    }
    tell_held_back(now, kind);
    measure.tokens -= 1;
    return true;
}

void LineLog::tell_held_back(SimTime now, Kind kind) {
    static constexpr std::array<std::string_view, kinds> names{"lines", "warnings", "errors"};
    if (const std::uint64_t count = std::exchange(measures_[kind].held_back, 0); count != 0) {
        print(now, Ink::faint, "",
              fmt::format("{} {} left out of this log, there were too many", count, names[kind]), "");
    }
}

void LineLog::finish(SimTime now) {
    for (const Kind kind : {talk, warnings, errors}) {
        tell_held_back(now, kind);
    }
}

void LineLog::print(SimTime now, Ink ink, std::string_view head, std::string_view text,
                    std::string_view words) {
    StyledLine line(colours_);
    line.add(fmt::format("{:10.3f}  ", machine::to_seconds(now))).add(head, ink, head_width).add("  ");
    if (words.empty()) {
        line.add(fit(text, text_column));
    } else {
        const bool below = text.size() > words_column;
        if (below) {
            line.add(fit(text, text_column)).end().add("", Ink::plain, text_column);
        } else {
            line.add(text, Ink::plain, words_column).add("  ");
        }
        line.add(fit(words, below ? text_column : text_column + words_column + 2), Ink::faint);
    }
    out_.write(line.end());
}

std::string LineLog::fit(std::string_view text, std::size_t column) const {
    constexpr std::size_t least = 20;
    const std::size_t columns = detail_ == Detail::verbose ? 0 : out_.columns();
    const std::size_t room = std::max(least, columns - std::min(columns, column));
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
    const auto letters = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins));
    if (columns == 0 || letters <= room) {
        return std::string(text);
    }
    std::size_t end = 0;
    for (std::size_t kept = 0; kept < room; ++end) {  // to where the letter after the last one kept begins
        kept += begins(text[end]) ? 1U : 0U;
    }
    return std::string(text.substr(0, end - 1)) + "…";
}

std::string LineLog::words_of(board::Channel channel, const protocol::DecodedLine& line) const {
    std::string own = own_words_ ? own_words_(channel, line) : std::string();
    return own.empty() ? protocol::explain(line) : own;
}

void LineLog::on_received(SimTime now, board::Channel channel, std::string_view received,
                          board::Verdict verdict) {
    if (detail_ == Detail::quiet || !passes(now)) {
        return;
    }
    const std::string line = protocol::mask_secrets(received);
    std::string words = words_of(channel, protocol::decode_line(line, protocol::Direction::to_board));
    words += host::words_of(verdict);
    print(now, verdict == board::Verdict::accepted ? Ink::incoming : Ink::error,
          fmt::format("{} → board", other_end(channel)), behaviour::as_ascii(line), words);
}

void LineLog::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    if (detail_ != Detail::quiet && passes(now)) {
        const protocol::DecodedLine decoded = protocol::decode_line(line, protocol::Direction::to_screen);
        // What a board says to people on its USB port is in no list.
        const bool known = channel == board::Channel::main || decoded.code != nullptr;
        print(now, Ink::outgoing, fmt::format("board → {}", other_end(channel)), behaviour::as_ascii(line),
              known ? words_of(channel, decoded) : std::string());
    }
}

void LineLog::on_notice(SimTime now, board::Level level, std::string_view text) {
    struct Row {
        std::string_view name;
        Ink ink;
        Kind kind;
    };
    static constexpr std::array<Row, 4> rows{{{"debug", Ink::faint, talk},
                                              {"note", Ink::faint, talk},
                                              {"warning", Ink::warning, warnings},
                                              {"error", Ink::error, errors}}};
    const Row& row = rows[static_cast<std::size_t>(level)];
    if (log_level(level) >= least_ && passes(now, row.kind)) {
        print(now, row.ink, row.name, text, "");
    }
}

void LineLog::on_event(SimTime now, machine::EventId event) {
    if (least_ == LogLevel::trace && passes(now)) {
        print(now, Ink::faint, "event", event->name, "");
    }
}

void LineLog::on_link(SimTime now, link::LinkState, std::string_view why) {
    if (least_ <= LogLevel::info && passes(now)) {
        print(now, Ink::warning, "link", why, "");
    }
}

void LineLog::on_world(SimTime now, std::string_view words) {
    if (least_ <= LogLevel::info && passes(now)) {
        print(now, Ink::faint, "done", words, "");
    }
}

/// Part of the talk as much as of what was done: a line is not what was said.
void LineLog::on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) {
    if ((detail_ != Detail::quiet || least_ <= LogLevel::debug) && passes(now)) {
        print(now, Ink::error, fmt::format("fault {}", deed.fault),
              fault::deed_text(deed, other_end(channel)), "");
    }
}

}  // namespace fauxboard::host
