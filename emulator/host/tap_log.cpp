#include "emulator/host/tap_log.h"

#include <fmt/format.h>

#include <string>

#include "emulator/behaviour/wire_text.h"
#include "emulator/fault/deed_text.h"
#include "emulator/record/transcript.h"
#include "protocol/annotate.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

constexpr std::size_t words_column = 36;  // most lines are shorter
constexpr std::size_t head_width = 14;

std::string words_of(std::string_view line, protocol::Direction direction) {
    return protocol::explain(protocol::decode_line(record::without_nuls(line), direction));
}

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

void TapLog::on_received(SimTime now, board::Channel, std::string_view line, board::Verdict) {
    if (options_.lines) {
        print(now, Ink::incoming, "screen → board", behaviour::as_ascii(protocol::mask_secrets(line)),
              options_.words ? words_of(protocol::mask_secrets(line), protocol::Direction::to_board)
                             : std::string());
    }
}

void TapLog::on_sent(SimTime now, board::Channel, std::string_view line) {
    if (options_.lines) {
        print(now, Ink::outgoing, "board → screen", behaviour::as_ascii(line),
              options_.words ? words_of(line, protocol::Direction::to_screen) : std::string());
    }
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

void TapLog::on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) {
    if (options_.lines) {
        print(now, Ink::error, fmt::format("fault {}", deed.fault),
              fault::deed_text(deed, board::other_end(channel)), "");
    }
}

}  // namespace fauxboard::host
