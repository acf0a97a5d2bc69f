#include "emulator/host/tap_log.h"

#include <fmt/format.h>

#include <string>

#include "emulator/behaviour/wire_text.h"
#include "emulator/host/line_log.h"
#include "emulator/record/transcript.h"
#include "protocol/annotate.h"

namespace fauxboard::host {
namespace {

constexpr std::string_view cyan = "\x1b[36m";
constexpr std::string_view green = "\x1b[32m";
constexpr std::string_view yellow = "\x1b[33m";
constexpr std::string_view grey = "\x1b[90m";
constexpr std::string_view plain = "\x1b[0m";
constexpr int words_column = 36;  // most lines are shorter

std::string words_of(std::string_view line, protocol::Direction direction) {
    return protocol::explain(protocol::decode_line(record::without_nuls(line), direction));
}

}  // namespace

void TapLog::print(SimTime now, std::string_view colour, std::string_view head, std::string_view text,
                   std::string_view words) {
    std::string line = fmt::format("{:13.6f}  {}{:<14}{}  ", machine::to_seconds(now), colours_ ? colour : "",
                                   head, colours_ ? plain : "");
    if (words.empty()) {
        line += text;
    } else {
        line += fmt::format("{:<{}}  {}{}{}", text, words_column, colours_ ? grey : "", words,
                            colours_ ? plain : "");
    }
    line += '\n';
    out_.write(line);
}

void TapLog::on_received(SimTime now, board::Channel, std::string_view line, board::Verdict) {
    if (options_.lines) {
        print(now, cyan, "screen → board", behaviour::as_ascii(line),
              options_.words ? words_of(line, protocol::Direction::to_board) : std::string());
    }
}

void TapLog::on_sent(SimTime now, board::Channel, std::string_view line) {
    if (options_.lines) {
        print(now, green, "board → screen", behaviour::as_ascii(line),
              options_.words ? words_of(line, protocol::Direction::to_screen) : std::string());
    }
}

void TapLog::on_notice(SimTime now, board::Level level, std::string_view text) {
    if (options_.lines || level >= board::Level::warning) {
        print(now, yellow, level >= board::Level::warning ? "warning" : "note", text, "");
    }
}

void TapLog::on_link(SimTime now, link::LinkState, std::string_view why) {
    if (options_.lines) {
        print(now, yellow, "link", why, "");
    }
}

}  // namespace fauxboard::host
