// The USB side: lines with numbers and checksums, a queue, one command after the other.

#include <array>

#include "emulator/board/board.h"
#include "emulator/board/sizes.h"
#include "emulator/machine/event_rows.h"
#include "protocol/command.h"
#include "protocol/host_line.h"

namespace fauxboard::board {
namespace {

using machine::event;
using machine::EventId;
using protocol::HostLineFault;

EventId event_of(HostLineFault fault) {
    switch (fault) {
        case HostLineFault::wrong_number:
            return event("host.wrong_number");
        case HostLineFault::wrong_checksum:
            return event("host.wrong_checksum");
        case HostLineFault::no_checksum:
            return event("host.no_checksum");
        case HostLineFault::no_number:
        case HostLineFault::none:
            break;
    }
    return event("host.no_number");
}

/// Whether a code's first rule is to be carried out ahead of what waits.
bool is_urgent(const behaviour::Profile& profile, std::string_view body) {
    protocol::Command command;
    if (!protocol::parse_command(body, command)) {
        return false;
    }
    const std::vector<behaviour::Rule>* rules = profile.rules_for(Channel::host, command);
    return rules != nullptr && !rules->empty() && rules->front().at_once;
}

}  // namespace

void Board::take_host_line(std::string_view line) {
    const protocol::HostLine framed = protocol::unframe_host_line(line);
    machine::HostSide& host = machine_->host_side();
    const HostLineFault fault = protocol::judge_host_line(framed, host.last_line);
    const bool blank = framed.body.empty() && !framed.numbered;
    const bool urgent = fault == HostLineFault::none && !blank && is_urgent(*profile_, framed.body);
    Verdict verdict = Verdict::accepted;
    if (fault != HostLineFault::none && !machine_->hung()) {
        ++counters_.bad_frames;
        verdict = Verdict::bad_frame;
    } else if (machine_->hung() || (!blank && !urgent && !host_inbox_.push(framed.body))) {
        // Its number does not count as taken, so a host that numbers its lines is asked for it again.
        ++counters_.requests_lost;
        verdict = Verdict::queue_full;
    }
    tell_received(Channel::host, line, verdict);
    if (verdict == Verdict::queue_full || blank) {
        return;
    }
    machine_->advance(time_);
    if (fault != HostLineFault::none) {
        ++host.resends;
        machine_->events.raise(event_of(fault));
        settle();
        return;
    }
    if (framed.numbered) {
        host.last_line = framed.number;
    }
    if (const auto number = protocol::number_set(framed)) {
        host.last_line = *number;
    }
    if (urgent) {
        execute(Channel::host, framed.body);
        machine_->events.raise(event("host.done"));
        settle();
    }
    run_host();
}

/// Ends the command that is over, begins the next that may begin, and so on.
void Board::run_host() {
    machine::HostSide& host = machine_->host_side();
    while (!machine_->hung() && port(Channel::host).output.size() < output_limit) {
        if (host.running()) {
            if (host.under_way(machine_->now())) {
                return;
            }
            host.over();
            settle();
            continue;
        }
        if (host_inbox_.empty() || !host.ready(host_inbox_.front())) {
            return;
        }
        std::array<char, protocol::max_line_bytes> line;
        const std::string_view front = host_inbox_.front();
        const std::string_view command(line.data(), front.copy(line.data(), line.size()));
        host_inbox_.pop();  // before it is executed: a reset empties the queue
        host.begin(command, time_);
        if (!host.write(command, time_)) {
            machine_->transfer.asker = machine::Transfer::usb_side;
            execute(Channel::host, command);
            machine_->transfer.asker = machine::Transfer::serial_line;
            host.follow_transfer();
        }
        settle();
    }
}

}  // namespace fauxboard::board
