#include "emulator/filament/host_commands.h"

#include <algorithm>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/heating_wait.h"
#include "emulator/filament/motion.h"
#include "emulator/filament/names.h"

namespace fauxboard::filament {
namespace {

constexpr int end_of_file = 29;    ///< M29
constexpr int write_to_file = 28;  ///< M28
constexpr int log_to_file = 928;   ///< M928

}  // namespace

void HostCommands::power_on() {
    HostSide::power_on();
    source_.arc.clear();
    source_.wake = SimTime{0};
    source_.moves = 0;
    waits_ = yields_ = false;
    wait_busy_ = never;
    files_ = {};
    busy_s_ = config_.busy_s;
    busy_ = never;
    parsed_.clear();
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

void HostCommands::set_busy_s(double seconds, SimTime now) {
    busy_s_ = seconds;
    busy_ = running() && seconds > 0 ? now + from_seconds(seconds) : never;
}

bool HostCommands::ready(std::size_t from, std::string_view command, SimTime now) {
    if (running()) {
        return false;
    }
    waits_ = false;
    if (writing(from) && !files_[from].runs_too) {
        return true;  // it moves nothing, so it need not wait for what moves
    }
    parse(command);
    const GcodeMachine& on = source_.on;
    switch (code_ == nullptr ? Needs::nothing : code_->needs) {
        case Needs::nothing:
            break;
        case Needs::room:
            waits_ = on.wait.active() || !on.motion.can_stream();
            break;
        case Needs::rest:
            waits_ = on.wait.active() || on.motion.busy();
            yields_ = false;
            break;
        case Needs::turn:
            waits_ = on.wait.active();
            break;
    }
    if (waits_ && wait_busy_ == never && busy_s_ > 0) {
        wait_busy_ = now + from_seconds(busy_s_);
    }
    return !waits_;
}

void HostCommands::begin(std::size_t from, std::string_view command, SimTime now) {
    parse(command);
    HostSide::begin(from, command, now);
    source_.now = now;
    source_.byte = Planner::no_byte;
    if (code_ != nullptr && code_->needs != Needs::nothing) {
        wait_busy_ = never;
    }
    yields_ = code_ != nullptr && code_->needs == Needs::room;
    source_.on.commands.begun = this;
    heater_before_ = source_.on.wait.active();
    user_before_ = source_.on.job.waits_for_user;
    busy_ = busy_s_ > 0 ? now + from_seconds(busy_s_) : never;
}

bool HostCommands::run_code(bool by_rule) {
    return filament::run_code(code_, by_rule, source_, line_);
}

void HostCommands::settle() {
    source_.on.commands.begun = nullptr;
    stream();
}

bool HostCommands::under_way(SimTime now) const {
    const GcodeMachine& on = source_.on;
    const bool heats = on.wait.active() && !heater_before_;
    const bool waits_for_user = on.job.waits_for_user && !user_before_;
    return source_.arc.active() || source_.wake > now || heats || waits_for_user ||
           (code_ != nullptr && code_->blocks && on.motion.busy());
}

void HostCommands::over() {
    busy_ = never;
    HostSide::over();
}

void HostCommands::follow_transfer() {
    File& file = files_[speaker];
    const bool open = transfer_.takes_from(Transfer::host_line(speaker));
    if (open != file.open) {
        file = {open, open && line_.letter == 'M' && line_.code == log_to_file, {}};
    }
}

bool HostCommands::write(std::string_view command, SimTime now) {
    if (!writing(speaker)) {
        return false;
    }
    if (line_.letter == 'M' && line_.code == end_of_file) {
        flush(now);
        return false;
    }
    File& file = files_[speaker];
    if (!file.runs_too) {
        code_ = nullptr;  // it is a text now, and over at once
    }
    file.unwritten.append(command).append("\r\n");  // as Marlin ends them
    const bool opens_another =
        file.runs_too && line_.letter == 'M' && (line_.code == write_to_file || line_.code == log_to_file);
    if (file.unwritten.size() >= block_bytes || opens_another) {
        flush(now);
    }
    if (opens_another) {  // which ends this one
        const Job& job = source_.on.job;
        transfer_.finish(now, Transfer::host_line(speaker), job.active() ? job.path() : std::string_view());
    }
    return !file.runs_too;
}

/// What is not on the disk yet goes there.
void HostCommands::flush(SimTime now) {
    std::string& unwritten = files_[speaker].unwritten;
    const Transfer::Peer peer = Transfer::host_line(speaker);
    if (transfer_.takes_from(peer) && !transfer_.piece(now, peer, true, transfer_.position(), unwritten)) {
        transfer_.close(now, peer);
        source_.on.events.raise(event("host.write_failed"));
    }
    unwritten.clear();
}

void HostCommands::stream() {
    Motion& motion = source_.on.motion;
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
    for (SimTime* const due : {&busy_, &wait_busy_}) {
        if (*due <= now) {
            *due = busy_s_ > 0 ? now + from_seconds(busy_s_) : never;
            source_.on.events.raise(event("host.busy"));
        }
    }
}

SimTime HostCommands::next_of_command(SimTime now) const {
    SimTime next = std::min(busy_, wait_busy_);
    if (source_.wake > now) {
        next = std::min(next, source_.wake);
    }
    if (source_.arc.active() && source_.on.motion.can_stream()) {
        next = std::min(next, now);
    }
    return next;
}

}  // namespace fauxboard::filament
