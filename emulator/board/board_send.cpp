// What a board says: frames composed, and put where they leave.

#include <algorithm>

#include "emulator/board/board.h"
#include "emulator/board/sizes.h"

namespace fauxboard::board {
namespace {

using behaviour::ActionContext;
using behaviour::Frame;
using behaviour::Scope;
using behaviour::Send;

/// Of the longest message the last lines must always fit; entries before them may be left out.
constexpr std::size_t closing_room = 256;
/// What stands in a line beside the names of its entry.
constexpr std::size_t around_entry = 64;
/// A reply to the USB side that begins so is all the acknowledgement its command gets.
constexpr std::string_view acknowledgement = "ok";

}  // namespace

void Board::send(const Send& entry, const Scope& here) {
    if (unasked_ || machine_->hung() || !behaviour::all_hold(entry.when, here)) {
        return;
    }
    const Frame& frame = profile_->frames[entry.frame];
    const std::optional<Channel> to = frame.everywhere ? std::nullopt : frame.to ? frame.to : asker_;
    const bool host_like = profile_->line.framing == behaviour::Framing::commands;
    if (muted_ && !to && !frame.everywhere) {
        return;
    }
    if (to || !(frame.everywhere || host_like)) {
        send_to(to.value_or(Channel::main), entry, here);
        return;
    }
    send_to(Channel::main, entry, here);
    send_to(Channel::host, entry, here);
}

/// Where a message is put together that does not go straight out.
std::span<char> Board::scratch() {
    if (scratch_ == nullptr) {
        scratch_ = std::make_unique_for_overwrite<char[]>(scratch_bytes);
    }
    return {scratch_.get(), scratch_bytes};
}

void Board::send_to(Channel to, const Send& entry, const Scope& here) {
    const Frame& frame = profile_->frames[entry.frame];
    if (to == Channel::network ? !network_.asking() : !port(to).connected) {
        return;
    }
    const bool paced = options_.pacing && to == Channel::main && !takes_commands(to);
    if (profile_->queue_codes != 0 && paced && !entry.now) {
        queue(entry, here);
        return;
    }
    for (unsigned i = 0; i < entry.times; ++i) {
        const bool at_once = to != Channel::network && (entry.now || !paced);
        const bool short_one = frame.lines.size() == 1 && !frame.lines[0].for_each_entry;
        OutputBuffer& output = port(to).output;
        Draft draft{at_once ? output.room(short_one ? line_bytes : room_for(frame)) : scratch()};
        compose(frame, here, draft);
        said(entry.frame, here);
        const std::string_view message(draft.room.data(), draft.size);
        if (to == Channel::network) {
            counters_.lines_sent += draft.lines;
            if (!frame.chunk) {
                tell_sent(to, message);
            }
            put_datagrams(draft.room.first(draft.size), frame.chunk);
        } else if (at_once) {
            output.grow(draft.size);
            counters_.lines_sent += draft.lines;
            answered_ = answered_ || (takes_commands(to) && message.starts_with(acknowledgement));
            tell_sent(to, message);
        } else if (!put_in_queue(message)) {
            ++counters_.messages_lost;
            notice(Level::warning, "message " + frame.name + " lost: the board's transmit queue is full");
        }
    }
}

/// Whole, or in pieces that the other end can take. False when there is no room for all of it.
bool Board::put_in_queue(std::string_view message) {
    if (profile_->burst_bytes == 0 || message.size() <= profile_->burst_bytes) {
        return outbox_.push(message);
    }
    while (!message.empty()) {
        std::size_t size = std::min<std::size_t>(profile_->piece_bytes, message.size());
        if (size < message.size()) {
            const std::size_t end = message.rfind('\n', size - 1);
            size = (end == std::string_view::npos ? message.find('\n') : end) + 1;
        }
        if (!outbox_.push(message.substr(0, size))) {
            return false;
        }
        message.remove_prefix(size);
    }
    return true;
}

/// What the board remembers of a frame that it has put together.
void Board::said(std::size_t frame, const Scope& here) {
    schedule_.sent(frame, *machine_);
    if (profile_->frames[frame].then.empty()) {
        return;
    }
    ActionContext context{*machine_, variables_, *this};
    for (const behaviour::ActionCall& call : profile_->frames[frame].then) {
        behaviour::run_action(call, here, profile_->variables, context);
    }
}

/// Of a board that stores which frames are to go: what they say is put together when they leave, but for what
/// was given with the order, of which the last is kept.
void Board::queue(const Send& entry, const Scope& here) {
    const Frame& frame = profile_->frames[entry.frame];
    for (unsigned i = 0; i < entry.times; ++i) {
        if (!codes_.push(entry.frame)) {
            ++counters_.messages_lost;
            notice(Level::warning, "message " + frame.name + " lost: the board's transmit queue is full");
        } else if (frame.cell) {
            Draft draft{scratch()};
            compose(frame, here, draft);
            codes_.keep(*frame.cell, {draft.room.data(), draft.size});
        }
    }
}

void Board::emit_code(std::size_t id) {
    const Frame& frame = profile_->frames[id];
    said(id, scope());
    if (frame.cell) {
        emit(codes_.kept(*frame.cell));
        return;
    }
    Draft draft{scratch()};
    compose(frame, scope(), draft);
    emit({draft.room.data(), draft.size});
}

/// Room for the longest this message can be: of a list that goes straight out, all of it.
std::size_t Board::room_for(const Frame& frame) {
    std::size_t bytes = scratch_bytes;
    for (const Frame::Line& line : frame.lines) {
        if (line.all_files) {
            for (const machine::CardEntry& entry : machine_->files()) {
                bytes += entry.name.size() + entry.long_name.size() + around_entry;
            }
        }
    }
    return bytes;
}

/// Adds a line to the draft, of which it may use the room up to `end`.
void Board::compose_line(const Frame& frame, const behaviour::FrameTemplate& text, const Scope& here,
                         std::size_t end, Draft& draft) {
    const std::span<char> room = draft.room.subspan(draft.size, end - draft.size);
    const std::size_t head = std::min(protocol::frame_head(frame.style), room.size());
    const std::size_t most = std::min(room.size() - head, protocol::max_line_bytes);
    bool cut = false;
    const behaviour::Written body = text.render(here, room.subspan(head, most), cut);
    if (cut && most < protocol::max_line_bytes) {
        return;  // no room for the line: it is left out
    }
    counters_.lines_cut += cut ? 1 : 0;
    const std::size_t size = protocol::dress_frame(room, body.size, body.sum, frame.style, frame.end);
    draft.size += size;
    draft.lines += size != 0 ? 1 : 0;
}

void Board::compose(const Frame& frame, const Scope& here, Draft& draft) {
    if (frame.chunk) {
        const machine::Transfer& transfer = machine_->transfer;
        const std::string_view block = transfer.last_block.view();
        draft.size = protocol::write_chunk(
            draft.room, static_cast<std::uint32_t>(transfer.position() - block.size()), block);
        draft.lines = 1;
        return;
    }
    const std::size_t end = draft.room.size();
    for (const Frame::Line& line : frame.lines) {
        if (!line.for_each_entry) {
            if (behaviour::all_hold(line.when, here)) {
                compose_line(frame, line.text, here, end, draft);
            }
            continue;
        }
        Scope inside = here;
        for (const machine::CardEntry& entry : line.all_files ? machine_->files() : machine_->listing()) {
            inside.entry = &entry;
            if (behaviour::all_hold(line.when, inside)) {
                compose_line(frame, line.text, inside, std::max(draft.size, end - closing_room), draft);
            }
            ++inside.index;
        }
    }
}

/// A message out of the queue goes on the wire.
void Board::emit(std::string_view message) {
    port(Channel::main).output.append(message);
    counters_.lines_sent += static_cast<std::uint64_t>(std::count(message.begin(), message.end(), '\n'));
    tell_sent(Channel::main, message);
}

void Board::tell_sent(Channel channel, std::string_view message) {
    while (options_.observer != nullptr && !message.empty()) {
        const std::size_t end = std::min(message.find('\n'), message.size());
        const std::string_view line = message.substr(0, end);
        options_.observer->on_sent(time_, channel, line.substr(0, line.find_last_not_of("\r\n") + 1));
        message.remove_prefix(std::min(end + 1, message.size()));
    }
}

}  // namespace fauxboard::board
