#include "emulator/host/line_log.h"

#include "emulator/behaviour/wire_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "protocol/annotate.h"

namespace fauxboard::host {
namespace {

constexpr std::string_view cyan = "\x1b[36m";
constexpr std::string_view green = "\x1b[32m";
constexpr std::string_view yellow = "\x1b[33m";
constexpr std::string_view red = "\x1b[31m";
constexpr std::string_view grey = "\x1b[90m";
constexpr std::string_view plain = "\x1b[0m";
constexpr std::size_t words_column = 44;  // longer lines have their words below
constexpr std::size_t text_column = 28;   // where the line itself starts

std::string words_of(std::string_view line, protocol::Direction direction) {
    return protocol::explain(protocol::decode_line(line, direction));
}

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
      burst_(4 * rate_),
      tokens_(burst_) {}

bool LineLog::passes(SimTime now) {
    if (rate_ <= 0) {
        return true;
    }
    tokens_ = std::min(burst_, tokens_ + machine::to_seconds(now - refilled_) * rate_);
    refilled_ = now;
    if (tokens_ < 1 || (held_back_ != 0 && tokens_ < burst_ / 4)) {
        ++held_back_;
        return false;
    }
    finish(now);
    tokens_ -= 1;
    return true;
}

void LineLog::finish(SimTime now) {
    if (held_back_ != 0) {
        const std::string text =
            fmt::format("{} lines left out of this log, there were too many", held_back_);
        held_back_ = 0;
        print(now, grey, "", text, "");
    }
}

void LineLog::print(SimTime now, std::string_view colour, std::string_view head, std::string_view text,
                    std::string_view words) {
    text_.clear();
    const auto out = std::back_inserter(text_);
    fmt::format_to(out, "{:10.3f}  {}{:<14}{}  ", machine::to_seconds(now), colours_ ? colour : "", head,
                   colours_ ? plain : "");
    if (words.empty()) {
        fmt::format_to(out, "{}\n", text);
    } else {
        if (text.size() > words_column) {
            fmt::format_to(out, "{}\n{:{}}", text, "", text_column);
        } else {
            fmt::format_to(out, "{:<{}}  ", text, words_column);
        }
        fmt::format_to(out, "{}{}{}\n", colours_ ? grey : "", words, colours_ ? plain : "");
    }
    out_.write(text_);
}

void LineLog::on_received(SimTime now, board::Channel channel, std::string_view line,
                          board::Verdict verdict) {
    if (detail_ == Detail::quiet || !passes(now)) {
        return;
    }
    std::string words = words_of(line, protocol::Direction::to_board);
    words += words_of(verdict);
    print(now, verdict == board::Verdict::accepted ? cyan : red,
          fmt::format("{} → board", other_end(channel)), behaviour::as_ascii(line), words);
}

void LineLog::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    if (detail_ != Detail::quiet && passes(now)) {
        const bool screen = channel == board::Channel::main;
        print(now, green, fmt::format("board → {}", other_end(channel)), behaviour::as_ascii(line),
              screen ? words_of(line, protocol::Direction::to_screen) : std::string());
    }
}

void LineLog::on_notice(SimTime now, board::Level level, std::string_view text) {
    static constexpr std::string_view names[] = {"debug", "note", "warning", "error"};
    static constexpr std::string_view colours[] = {grey, grey, yellow, red};
    const board::Level least = detail_ == Detail::quiet    ? board::Level::warning
                               : detail_ == Detail::normal ? board::Level::info
                                                           : board::Level::debug;
    if (level >= least && passes(now)) {
        const auto index = static_cast<std::size_t>(level);
        print(now, colours[index], names[index], text, "");
    }
}

void LineLog::on_link(SimTime now, link::LinkState, std::string_view why) {
    if (detail_ != Detail::quiet && passes(now)) {
        print(now, yellow, "link", why, "");
    }
}

}  // namespace fauxboard::host
