// What comes as datagrams: requests, each answered to its sender, and pieces of files.

#include <algorithm>

#include "emulator/board/board.h"

namespace fauxboard::board {
namespace {

using printer::Transfer;

static_assert(Transfer::max_block == protocol::max_chunk_payload);

/// Senders end a request with nothing, with one or two NULs, or with CR LF.
std::string_view without_end(std::string_view bytes) {
    using namespace std::string_view_literals;
    return bytes.substr(0, bytes.find_last_not_of("\0\r\n "sv) + 1);
}

/// While a file is open a damaged piece may have lost its mark. It is longer than a request, mostly, and
/// holds an offset, mostly with a control byte in it; a request has none, and begins with a letter.
bool may_be_request(std::string_view bytes) {
    const std::string_view line = without_end(bytes);
    const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
    return !line.empty() && line.size() <= protocol::max_line_bytes && letter(line.front()) &&
           std::none_of(line.begin(), line.end(),
                        [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

}  // namespace

void Board::receive_datagram(SimTime now, std::uint64_t peer, std::string_view bytes) {
    catch_up(now);
    if (peer == Transfer::serial_line || peer == Transfer::usb_side || network_.full() || machine_.hung()) {
        ++counters_.requests_lost;
        return;
    }
    machine_.advance(time_);
    network_.answer(peer);
    machine_.transfer.asker = peer;
    const protocol::Chunk chunk = protocol::read_chunk(bytes);
    // A piece that nobody waits for is one too: were it taken for an unknown request, its sender would be
    // told that all is well.
    if (chunk.fault != protocol::ChunkFault::no_chunk ||
        (machine_.transfer.takes_from(peer) && !may_be_request(bytes))) {
        take_piece(peer, chunk);
    } else {
        take_request(without_end(bytes));
    }
    network_.answer(0);
    machine_.transfer.asker = Transfer::serial_line;
    settle();
}

void Board::take_piece(std::uint64_t peer, const protocol::Chunk& chunk) {
    machine_.transfer.piece(time_, peer, chunk.fault == protocol::ChunkFault::none, chunk.offset,
                            chunk.payload);
    asker_ = Channel::network;
    run_rules(profile_->events[static_cast<std::size_t>(printer::EventId::transfer_piece)], nullptr);
}

void Board::take_request(std::string_view bytes) {
    const std::string_view line = bytes.substr(0, bytes.find_first_of("\r\n"));
    if (line.empty()) {
        return;
    }
    ++counters_.lines_received;
    std::string_view body;
    const bool bad = !unframe(line, body);
    counters_.bad_frames += bad ? 1 : 0;
    tell_received(Channel::network, line, bad ? Verdict::bad_frame : Verdict::accepted);
    if (!bad) {
        execute(Channel::network, body);
    }
}

}  // namespace fauxboard::board
