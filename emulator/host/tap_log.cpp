#include "emulator/host/tap_log.h"

#include <fmt/format.h>

#include <string>

#include "emulator/behaviour/wire_text.h"
#include "emulator/record/transcript.h"
#include "protocol/annotate.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

constexpr std::size_t words_column = 36;  // most lines are shorter
constexpr std::size_t head_width = 14;

}  // namespace

void TapLog::print(SimTime now, Ink ink, std::string_view head, std::string_view text,
                   std::string_view words) {
    StyledLine line(colours_);
    line.add(fmt::format("{:13.6f}  ", machine::to_seconds(now))).add(head, ink, head_width).add("  ");
    line.add(text, Ink::plain, words.empty() ? 0 : words_column);
    if (!words.empty()) {
        line.add("  ").add(words, Ink::faint);
    }
    out_.write(line.end());
}

void TapLog::say(SimTime now, std::string_view line, protocol::Direction direction) {
    const protocol::DecodedLine decoded = protocol::decode_line(record::without_nuls(line), direction);
    const std::string_view peer = peer_.at(decoded);
    if (!options_.lines) {
        return;
    }
    const bool to_board = direction == protocol::Direction::to_board;
    print(now, to_board ? Ink::incoming : Ink::outgoing,
          to_board ? fmt::format("{} → board", peer) : fmt::format("board → {}", peer),
          behaviour::as_ascii(line), options_.words ? protocol::explain(decoded) : std::string());
}

void TapLog::on_received(SimTime now, board::Channel, std::string_view line, board::Verdict) {
    say(now, protocol::mask_secrets(line), protocol::Direction::to_board);
}

void TapLog::on_sent(SimTime now, board::Channel, std::string_view line) {
    say(now, line, protocol::Direction::to_screen);
}

void TapLog::on_notice(SimTime now, board::Level level, std::string_view text) {
    if (options_.lines || level >= board::Level::warning) {
        print(now, Ink::warning, level >= board::Level::warning ? "warning" : "note", text, "");
    }
}

void TapLog::on_link(SimTime now, link::LinkState, std::string_view why) {
    if (options_.lines) {
        print(now, Ink::warning, "link", why, "");
    }
}

}  // namespace fauxboard::host
