#include "emulator/host/tap_talk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "emulator/record/transcript.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

constexpr char letter(TapSide side) {
    return side == TapSide::a ? 'A' : 'B';
}

}  // namespace

TapTalk::TapTalk(LiveObserver& lines, record::PcapngWriter* packets, std::optional<TapSide> board)
    : lines_(lines), packets_(packets), board_(board) {}

void TapTalk::on_passed(SimTime now, TapSide from, std::string_view bytes) {
    Side& side = of(from);
    if (packets_ != nullptr) {
        const auto take = [&](std::string_view piece) { put(now, from, true, piece); };
        if (now - side.heard >= packet_pause) {
            const SimTime ended = side.heard;
            side.packet.flush([&](std::string_view piece) { put(ended, from, true, piece); });
        }
        side.packet.feed(bytes, take);
    }
    side.heard = now;
    side.line.feed(bytes, [&](std::string_view piece) { line(now, from, piece); });
}

void TapTalk::line(SimTime now, TapSide from, std::string_view piece) {
    while (!piece.empty() && (piece.back() == '\n' || piece.back() == '\r')) {
        piece.remove_suffix(1);
    }
    if (piece.empty()) {
        return;
    }
    ++of(from).lines;
    put(now, from, false, piece);
    if (!board_) {
        if (const auto direction = record::telling_direction(piece)) {
            decide(*direction == protocol::Direction::to_screen ? from : other(from));
        }
    }
}

void TapTalk::put(SimTime now, TapSide from, bool packet, std::string_view bytes) {
    if (board_) {
        tell(now, from, packet, bytes);
        return;
    }
    undecided_.push_back({now, from, packet, std::string(bytes)});
    if (undecided_.size() > undecided_limit) {
        decide(TapSide::b);
    }
}

void TapTalk::decide(TapSide board) {
    board_ = board;
    for (const Item& item : std::exchange(undecided_, {})) {
        tell(item.t, item.from, item.packet, item.bytes);
    }
}

void TapTalk::tell(SimTime now, TapSide from, bool packet, std::string_view bytes) {
    const bool from_board = from == *board_;
    if (packet) {
        packets_->packet(now, from_board ? protocol::Direction::to_screen : protocol::Direction::to_board,
                         protocol::mask_secrets(bytes));  // captures are made to be shared
    } else if (from_board) {
        lines_.on_sent(now, board::Channel::main, bytes);
    } else {
        lines_.on_received(now, board::Channel::main, bytes, board::Verdict::accepted);
    }
}

void TapTalk::on_link(SimTime now, TapSide side, link::LinkState state, std::string_view why) {
    lines_.on_link(now, state, fmt::format("{}: {}", letter(side), why));
}

SimTime TapTalk::due() const {
    SimTime due = machine::never;
    for (const Side& side : sides_) {
        if (!side.packet.empty()) {
            due = std::min(due, side.heard + packet_pause);
        }
    }
    return due;
}

void TapTalk::tick(SimTime now) {
    for (const TapSide from : {TapSide::a, TapSide::b}) {
        Side& side = of(from);
        if (now - side.heard >= packet_pause) {
            side.packet.flush([&](std::string_view piece) { put(side.heard, from, true, piece); });
        }
    }
}

void TapTalk::finish() {
    for (const TapSide from : {TapSide::a, TapSide::b}) {
        Side& side = of(from);
        side.packet.flush([&](std::string_view piece) { put(side.heard, from, true, piece); });
        side.line.flush([&](std::string_view piece) { line(side.heard, from, piece); });
    }
    if (!board_) {
        decide(TapSide::b);
    }
}

}  // namespace fauxboard::host
