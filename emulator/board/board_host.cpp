// The lines that are spoken as a host speaks: numbers and checksums, a queue each, one command after the
// other.

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "emulator/board/board.h"
#include "emulator/board/sizes.h"
#include "emulator/machine/event_rows.h"
#include "protocol/command.h"

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
        case HostLineFault::repeated:
        case HostLineFault::no_number:
        case HostLineFault::none:
            break;
    }
    return event("host.no_number");
}

constexpr std::array host_like{Channel::main, Channel::host};

}  // namespace

/// Whether the main line is one of those.
bool Board::takes_commands(Channel channel) const {
    return channel == Channel::host ||
           (channel == Channel::main && profile_->line.framing == behaviour::Framing::commands);
}

protocol::HostLineRules Board::host_rules() const {
    const machine::HostConfig& config = machine_->config().host;
    return {config.line_chars, config.drops_repeated, config.judges_unnumbered, config.first_star_ends};
}

/// What the firmware looks for in a line as it comes in, ahead of all that waits: one of the profile's codes
/// that are carried out at once. The digits may go on ("M1120"). Empty for any other line.
std::string Board::urgent_command(std::string_view line, const protocol::HostLine& framed,
                                  HostLineFault fault) const {
    const bool emergency_parser = machine_->config().host.emergency_parser;
    if (!emergency_parser && (framed.numbered || fault != HostLineFault::none)) {
        return {};
    }
    const std::size_t letter = line.find_first_not_of("N-0123456789 ");
    if (letter == std::string_view::npos || line[letter] != 'M') {
        return {};
    }
    std::string_view rest = line.substr(letter + 1);
    rest = emergency_parser ? rest.substr(std::min(rest.find_first_not_of(' '), rest.size())) : rest;
    for (const std::string& code : profile_->urgent) {
        if (rest.starts_with(code)) {
            rest.remove_prefix(code.size());
            return "M" + code + (rest.starts_with(' ') ? std::string(rest.substr(0, rest.find('*'))) : "");
        }
    }
    return {};
}

void Board::take_command_line(Channel channel, std::string_view bytes) {
    Port& from = port(channel);
    if (from.deaf_at == time_) {
        // It lay behind a bad line in the buffer that the firmware then throws away. It was on the wire all
        // the same, and a recording holds it.
        ++counters_.requests_lost;
        return tell_received(channel, bytes, Verdict::queue_full);
    }
    std::array<char, protocol::max_line_bytes> room;
    const protocol::HostLineRules rules = host_rules();
    const std::string_view line = protocol::read_host_line(bytes, room, rules.most_chars);
    const protocol::HostLine framed = protocol::unframe_host_line(line, rules);
    const std::size_t number = index(channel);
    machine::HostSide::Line& counted = machine_->host_side().lines[number];
    const bool writing = machine_->host_side().writing(number);
    const HostLineFault fault = judge(framed, counted.last, writing);
    const bool blank = line.find_first_not_of(' ') == std::string_view::npos;
    // A line that is nothing but a checksum is no command, and told as one that nobody knows.
    const std::string_view command =
        framed.body.empty() && !writing ? line.substr(std::min(line.find('*'), line.size())) : framed.body;
    // The emergency parser is off while a file is written; what is looked for in whole lines is found.
    const bool looks = !machine_->hung() && !(writing && machine_->config().host.emergency_parser);
    const std::string urgent = looks ? urgent_command(line, framed, fault) : std::string();
    Verdict verdict = fault == HostLineFault::none ? Verdict::accepted : Verdict::bad_frame;
    if (machine_->hung()) {
        ++counters_.requests_lost;
        verdict = Verdict::queue_full;
    } else if (verdict == Verdict::accepted && !blank &&
               !from.commands.push({framed.number, framed.numbered, !urgent.empty()}, command)) {
        // Its number does not count as taken, so a host that numbers its lines is asked for it again.
        ++counters_.requests_lost;
        verdict = Verdict::queue_full;
    }
    counted.waiting = from.commands.size();
    tell_received(channel, bytes, verdict);
    if (machine_->hung() || blank) {
        return;
    }
    machine_->advance(time_);
    if (!urgent.empty()) {
        execute(channel, urgent);
        settle(channel);
    }
    if (machine_->hung()) {
        return;  // that was M112: nothing is said after it
    }
    if (verdict == Verdict::accepted) {
        counted.last = framed.numbered ? framed.number : counted.last;
        run_host();
    } else if (fault != HostLineFault::repeated) {
        complain(channel, verdict == Verdict::queue_full ? event("host.overflow") : event_of(fault));
    }
}

/// What a board that checks numbers has against a line; one of an upload must have one, where that is so.
HostLineFault Board::judge(const protocol::HostLine& line, std::int64_t last, bool writing) const {
    const HostLineFault fault = protocol::judge_host_line(line, last, host_rules());
    const bool bare = writing && !line.numbered && !line.body.empty() && !line.body.starts_with("M29");
    return fault == HostLineFault::none && bare && machine_->config().host.numbers_uploads
               ? HostLineFault::no_checksum
               : fault;
}

/// Says what is wrong, by the profile's words for the event, to the line that is to send it again.
void Board::complain(Channel channel, EventId what) {
    machine::HostSide& host = machine_->host_side();
    const std::size_t speaker = std::exchange(host.speaker, index(channel));
    if (what != event("host.overflow")) {
        ++counters_.bad_frames;
        ++host.line().resends;
        port(channel).deaf_at = time_;
    }
    machine_->events.raise(what);
    settle(channel);
    host.speaker = speaker;
}

/// Ends the command that is over, begins the next that may begin, and so on.
void Board::run_host() {
    machine::HostSide& host = machine_->host_side();
    held_back_ = false;
    while (!machine_->hung()) {
        if (!host.running()) {
            if (!begin_command()) {
                return;
            }
            continue;
        }
        const auto channel = static_cast<Channel>(host.speaker);
        held_back_ = port(channel).output.size() >= output_limit;
        if (held_back_ || host.under_way(machine_->now())) {
            return;
        }
        say_after();
        host.over();
        settle(channel);
    }
}

/// What the command that is over is followed by, before its acknowledgement.
void Board::say_after() {
    protocol::Command command;
    if (const behaviour::Rule* const rule = std::exchange(after_, nullptr);
        rule != nullptr && protocol::parse_host_command(machine_->host_side().command(), command)) {
        asker_ = asker_on(static_cast<Channel>(machine_->host_side().speaker));
        for (const behaviour::Send& entry : rule->after) {
            send(entry, scope(&command));
        }
    }
}

/// The lines take turns. False when none has a command that may begin.
bool Board::begin_command() {
    machine::HostSide& host = machine_->host_side();
    for (std::size_t i = 1; i <= host_like.size(); ++i) {
        const std::size_t number = (host.speaker + i) % host_like.size();
        Port& from = ports_[number];
        held_back_ = held_back_ || (!from.commands.empty() && from.output.size() >= output_limit);
        if (from.commands.empty() || from.output.size() >= output_limit ||
            !host.ready(number, from.commands.command(), time_)) {
            continue;
        }
        const CommandQueue::Head head = from.commands.head();
        std::array<char, protocol::max_line_bytes> room;
        const std::string_view waiting = from.commands.command();
        const std::string_view command(room.data(), waiting.copy(room.data(), room.size()));
        from.commands.pop();  // before it is executed: a reset empties the queue
        host.lines[number].waiting = from.commands.size();
        host.lines[number].number = head.number;
        host.lines[number].numbered = head.numbered;
        host.begin(number, command, time_);
        carry_out(host_like[number], command, head.acted);
        settle(host_like[number]);
        return true;
    }
    return false;
}

void Board::carry_out(Channel channel, std::string_view command, bool acted) {
    machine::HostSide& host = machine_->host_side();
    if (host.write(command, time_) || acted) {
        host.settle();
        return;
    }
    machine_->transfer.asker = machine::Transfer::host_line(host.speaker);
    if (execute(channel, command, true)) {
        host.acknowledge();
    }
    machine_->transfer.asker = machine::Transfer::serial_line;
    host.settle();
    host.follow_transfer();
}

}  // namespace fauxboard::board
