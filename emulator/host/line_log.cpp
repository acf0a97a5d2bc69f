#include "emulator/host/line_log.h"

#include "emulator/behaviour/wire_text.h"

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

}  // namespace

LineLog::LineLog(TextOutput& out, Detail detail, double lines_per_second)
    : out_(out),
      detail_(detail),
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

void LineLog::on_received(SimTime now, board::Channel channel, std::string_view received,
                          board::Verdict verdict) {
    if (detail_ == Detail::quiet || !passes(now)) {
        return;
    }
    const std::string line = protocol::mask_secrets(received);
    const protocol::DecodedLine decoded = protocol::decode_line(line, protocol::Direction::to_board);
    const bool own = decoded.code == nullptr && knows_ && knows_(channel, decoded.code_text);
    std::string words = own ? decoded.code_text + ": the profile's own" : protocol::explain(decoded);
    words += words_of(verdict);
    print(now, verdict == board::Verdict::accepted ? Ink::incoming : Ink::error,
          fmt::format("{} → board", other_end(channel)), behaviour::as_ascii(line), words);
}

void LineLog::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    if (detail_ != Detail::quiet && passes(now)) {
        const protocol::DecodedLine decoded = protocol::decode_line(line, protocol::Direction::to_screen);
        // What a board says to people on its USB port is in no list.
        const bool known = channel == board::Channel::main || decoded.code != nullptr;
        print(now, Ink::outgoing, fmt::format("board → {}", other_end(channel)), behaviour::as_ascii(line),
              known ? protocol::explain(decoded) : std::string());
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
    const board::Level least = detail_ == Detail::quiet    ? board::Level::warning
                               : detail_ == Detail::normal ? board::Level::info
                                                           : board::Level::debug;
    const Row& row = rows[static_cast<std::size_t>(level)];
    if (level >= least && passes(now, row.kind)) {
        print(now, row.ink, row.name, text, "");
    }
}

void LineLog::on_link(SimTime now, link::LinkState, std::string_view why) {
    if (detail_ != Detail::quiet && passes(now)) {
        print(now, Ink::warning, "link", why, "");
    }
}

void LineLog::on_world(SimTime now, std::string_view words) {
    if (detail_ != Detail::quiet && passes(now)) {
        print(now, Ink::faint, "done", words, "");
    }
}

void LineLog::on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) {
    if (detail_ == Detail::quiet || !passes(now)) {
        return;
    }
    const std::string_view peer = other_end(channel);
    const bool to_board = deed.direction == fault::Direction::to_board;
    print(now, Ink::error, fmt::format("fault {}", deed.fault),
          fmt::format("{} {} {}: {}", deed.kind, to_board ? "from" : "to", peer,
                      behaviour::as_ascii(protocol::mask_secrets(deed.line))),
          "");
}

}  // namespace fauxboard::host
