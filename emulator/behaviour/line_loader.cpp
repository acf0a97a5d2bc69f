#include "emulator/behaviour/line_loader.h"

#include <array>
#include <string_view>

namespace fauxboard::behaviour {

void load_line(const Json& node, const std::string& pointer, Findings& findings, LineConfig& line,
               bool& framed) {
    ObjectReader reader(node, pointer, findings);
    reader.unsigned_integer("baud", line.baud, 300, 4'000'000);
    reader.unsigned_integer("queue_lines", line.queue_lines, 1, 1024);
    constexpr std::array<std::string_view, 3> policies{"required", "if_present", "ignored"};
    auto policy = static_cast<std::size_t>(line.checksum);
    reader.choice("checksum", policies, policy);
    line.checksum = static_cast<protocol::ChecksumPolicy>(policy);
    reader.text("peer", line.peer, 16);
    reader.boolean("optional", line.optional);
    reader.boolean("none", line.none);
    double unfinished_ms = 0;
    reader.number("unfinished_ms", unfinished_ms, 0, 60'000);
    line.unfinished = machine::from_seconds(unfinished_ms / 1000);
    reader.boolean("framed", framed);
    line.framed = framed;
    reader.unsigned_integer("ring_bytes", line.ring_bytes, 16, 65536);
    reader.unsigned_integer("line_bytes", line.line_bytes, 16,
                            static_cast<unsigned>(protocol::max_line_bytes));
    std::string comment;
    reader.text("comment_from", comment, 1);
    line.comment = comment.empty() ? '\0' : comment[0];
    reader.text("codes", line.codes, 8);
    reader.finish();
}

void load_transmit(const Json& node, const std::string& pointer, Findings& findings, Profile& profile) {
    ObjectReader reader(node, pointer, findings);
    double ms = static_cast<double>(profile.tick.count()) / 1000;
    double first_ms = 0;
    reader.number("tick_ms", ms, 0.1, 10000);
    reader.number("first_ms", first_ms, 0, 60'000);
    reader.unsigned_integer("burst_bytes", profile.burst_bytes, 16, 65536);
    profile.piece_bytes = profile.burst_bytes;
    reader.unsigned_integer("piece_bytes", profile.piece_bytes, 16, 65536);
    reader.unsigned_integer("queue_codes", profile.queue_codes, 1, 1024);
    reader.finish();
    profile.tick = machine::from_seconds(ms / 1000);
    profile.first_tick = machine::from_seconds(first_ms / 1000);
}

}  // namespace fauxboard::behaviour
