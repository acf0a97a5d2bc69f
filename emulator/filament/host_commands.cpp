#include "emulator/filament/host_commands.h"

#include <algorithm>

#include "emulator/machine/printer.h"

namespace fauxboard::machine {
namespace {

constexpr std::size_t shown_bytes = 96;
constexpr int end_of_file = 29;  ///< M29

}  // namespace

void HostCommands::power_on() {
    source_.arc.clear();
    source_.wake = SimTime{0};
    source_.moves = 0;
    running_ = acknowledged_ = writing_ = false;
    unwritten_.clear();
    busy_ = never;
    last_line = 0;
    resends = commands = 0;
    parsed_.clear();
    command_.clear();
    code_ = nullptr;
}

void HostCommands::parse(std::string_view command) {
    if (command == parsed_ && code_ != nullptr) {
        return;
    }
    parsed_.assign(command);
    parse_gcode(parsed_, line_);
    code_ = line_.letter == 0 ? nullptr : find_code(line_.letter, line_.code);
}

bool HostCommands::ready(std::string_view command) {
    const Printer& p = source_.printer;
    if (running_ || p.wait.active()) {
        return false;
    }
    if (writing_) {
        return true;  // it moves nothing, so it need not wait for what moves
    }
    parse(command);
    return code_ == nullptr || (code_->at_rest ? !p.motion.busy() : p.motion.can_stream());
}

void HostCommands::begin(std::string_view command, SimTime now) {
    parse(command);
    command_.assign(command.substr(0, shown_bytes));
    source_.now = now;
    source_.byte = source_.printer.job.place();
    running_ = true;
    acknowledged_ = false;
    ++commands;
    const double busy_s = source_.printer.config().host.busy_s;
    busy_ = busy_s > 0 ? now + from_seconds(busy_s) : never;
}

bool HostCommands::run_code() {
    if (code_ == nullptr) {
        return false;
    }
    code_->run(source_, line_);
    stream();
    return true;
}

bool HostCommands::under_way() const {
    const Printer& p = source_.printer;
    const bool waits_for_user = p.job.waits_for_user && !p.job.active();
    return source_.arc.active() || source_.wake > p.now() || p.wait.active() || waits_for_user ||
           (code_ != nullptr && code_->blocks && p.motion.busy());
}

void HostCommands::over() {
    running_ = false;
    busy_ = never;
    if (!acknowledged_) {
        source_.printer.events.raise(EventId::host_done);
    }
}

void HostCommands::follow_transfer() {
    const bool open = source_.printer.transfer.takes_from(Transfer::usb_side);
    if (open != writing_) {
        writing_ = open;
        unwritten_.clear();
    }
}

bool HostCommands::write(std::string_view command, SimTime now) {
    if (!writing_) {
        return false;
    }
    if (line_.letter == 'M' && line_.code == end_of_file) {
        flush(now);
        return false;
    }
    code_ = nullptr;                            // it is a text now, and over at once
    unwritten_.append(command).append("\r\n");  // as Marlin ends them
    if (unwritten_.size() >= block_bytes) {
        flush(now);
    }
    return true;
}

/// What is not on the disk yet goes there.
void HostCommands::flush(SimTime now) {
    Transfer& transfer = source_.printer.transfer;
    if (transfer.takes_from(Transfer::usb_side) &&
        !transfer.piece(now, Transfer::usb_side, true, transfer.position(), unwritten_)) {
        transfer.close(now, Transfer::usb_side);
        source_.printer.events.raise(EventId::host_write_failed);
    }
    unwritten_.clear();
}

void HostCommands::stream() {
    Motion& motion = source_.printer.motion;
    while (source_.arc.active() && motion.can_stream()) {
        stream_arc(source_);
    }
    motion.start_stream(source_.now);
}

void HostCommands::advance(SimTime now) {
    if (source_.arc.active()) {
        source_.now = now;
        stream();
    }
    if (busy_ <= now) {
        busy_ = now + from_seconds(source_.printer.config().host.busy_s);
        source_.printer.events.raise(EventId::host_busy);
    }
}

SimTime HostCommands::next_of_command() const {
    const SimTime now = source_.printer.now();
    SimTime next = busy_;
    if (source_.wake > now) {
        next = std::min(next, source_.wake);
    }
    if (source_.arc.active() && source_.printer.motion.can_stream()) {
        next = std::min(next, now);
    }
    return next;
}

}  // namespace fauxboard::machine
