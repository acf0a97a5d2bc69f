// What comes as datagrams: requests, each answered to its sender, and pieces of files.

#include <algorithm>

#include "emulator/board/board.h"
#include "emulator/machine/event_rows.h"

namespace fauxboard::board {
namespace {

using machine::Transfer;

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
    if (!Transfer::is_network(peer) || network_.full() || machine_->hung()) {
        ++counters_.requests_lost;
        return;
    }
    machine_->advance(time_);
    if (options_.observer != nullptr) {
        options_.observer->on_datagram(time_, peer, true, bytes);
    }
    network_.answer(peer);
    machine_->transfer.asker = peer;
    const protocol::Chunk chunk = protocol::read_chunk(bytes);
    // A piece that nobody waits for is one too: were it taken for an unknown request, its sender would be
    // told that all is well.
    if (chunk.fault != protocol::ChunkFault::no_chunk ||
        (machine_->transfer.takes_from(peer) && !may_be_request(bytes))) {
        take_piece(peer, chunk);
    } else {
        take_request(without_end(bytes));
    }
    network_.answer(0);
    machine_->transfer.asker = Transfer::serial_line;
    settle();
}

/// What becomes of the next piece or block on its way. Chance is asked only where something is wrong, so that
/// a sound network leaves the machine's sequence alone.
Transfer::Mishap Board::mishap() {
    const Transfer::Trouble& trouble = machine_->transfer.trouble;
    return trouble.any() ? trouble.mishap(machine_->random()) : Transfer::Mishap::none;
}

void Board::take_piece(std::uint64_t peer, const protocol::Chunk& chunk) {
    const Transfer::Mishap what = mishap();
    if (what == Transfer::Mishap::lost) {
        notice(Level::debug, "a piece of a file was lost on its way");
        return;
    }
    const bool intact = chunk.fault == protocol::ChunkFault::none && what != Transfer::Mishap::damaged;
    asker_ = Channel::network;
    for (int times = what == Transfer::Mishap::repeated ? 2 : 1; times > 0; --times) {
        machine_->transfer.piece(time_, peer, intact, chunk.offset, chunk.payload);
        if (what == Transfer::Mishap::answer_lost) {
            network_.answer(0);
            notice(Level::debug, "the answer to a piece of a file was lost on its way");
        }
        run_rules(profile_->rules_for(machine::event("transfer.piece")), nullptr);
    }
}

/// Puts a message on its way to the one who asks; `block` says that it is one of a file.
void Board::put_datagrams(std::span<char> message, bool block) {
    const Transfer::Mishap what = block && !message.empty() ? mishap() : Transfer::Mishap::none;
    if (what == Transfer::Mishap::lost || what == Transfer::Mishap::answer_lost) {
        notice(Level::debug, "a block of a file was lost on its way");
        return;
    }
    if (what == Transfer::Mishap::damaged) {
        message.front() = static_cast<char>(message.front() ^ 1);
    }
    const auto tell = [this](std::string_view bytes) {
        if (options_.observer != nullptr) {
            options_.observer->on_datagram(time_, network_.peer(), false, bytes);
        }
    };
    for (int times = what == Transfer::Mishap::repeated ? 2 : 1; times > 0; --times) {
        network_.add({message.data(), message.size()}, block, tell);
    }
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
