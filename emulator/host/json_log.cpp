#include "emulator/host/json_log.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "emulator/behaviour/wire_text.h"
#include "protocol/annotate.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

/// A JSON string in ASCII. Text that is no UTF-8 (a path, say) shows U+FFFD for its odd bytes.
std::string json_text(std::string_view text) {
    return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

std::string_view refusal(board::Verdict verdict) {
    switch (verdict) {
        case board::Verdict::bad_frame:
            return R"(, "refused": "bad frame")";
        case board::Verdict::queue_full:
            return R"(, "refused": "queue full")";
        case board::Verdict::accepted:
            break;
    }
    return "";
}

}  // namespace

std::string JsonLog::line_members(board::Channel channel, std::string_view from, std::string_view line,
                                  protocol::Direction direction) const {
    const protocol::DecodedLine decoded = protocol::decode_line(line, direction);
    const std::string own = own_words_ ? own_words_(channel, decoded) : std::string();
    return fmt::format(R"("from": "{}", "line": {}, "words": {})", from,
                       json_text(behaviour::from_wire(line)),
                       json_text(own.empty() ? protocol::explain(decoded) : own));
}

void JsonLog::write(SimTime now, std::string_view members) {
    const double t = machine::to_seconds(now);
    const std::uint64_t left_out = out_.left_out();
    if (left_out != told_left_out_ &&
        out_.write(fmt::format("{{\"t\": {:.6f}, \"left_out\": {}}}\n", t, left_out - told_left_out_))) {
        told_left_out_ = left_out;
    }
    out_.write(fmt::format("{{\"t\": {:.6f}, {}}}\n", t, members));
}

void JsonLog::on_received(SimTime now, board::Channel channel, std::string_view line,
                          board::Verdict verdict) {
    std::string members = line_members(channel, board::other_end(channel), protocol::mask_secrets(line),
                                       protocol::Direction::to_board);
    members += refusal(verdict);
    write(now, members);
}

void JsonLog::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    write(now, line_members(channel, board::own_end(channel), line, protocol::Direction::to_screen));
}

void JsonLog::on_notice(SimTime now, board::Level level, std::string_view text) {
    static constexpr std::string_view names[] = {"debug", "info", "warning", "error"};
    write(now, fmt::format(R"("notice": {}, "level": "{}")", json_text(text),
                           names[static_cast<std::size_t>(level)]));
}

void JsonLog::on_link(SimTime now, link::LinkState state, std::string_view why) {
    write(now, fmt::format(R"("link": "{}", "why": {})", link::state_name(state), json_text(why)));
}

void JsonLog::on_world(SimTime now, std::string_view words) {
    write(now, fmt::format(R"("done": {})", json_text(words)));
}

void JsonLog::on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) {
    const bool to_board = deed.direction == fault::Direction::to_board;
    write(now, fmt::format(R"("fault": {}, "kind": "{}", "from": "{}", "line": {})", deed.fault, deed.kind,
                           to_board ? board::other_end(channel) : board::own_end(channel),
                           json_text(behaviour::from_wire(protocol::mask_secrets(deed.line)))));
}

}  // namespace fauxboard::host
