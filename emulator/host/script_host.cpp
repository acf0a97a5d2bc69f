#include "emulator/host/script_host.h"

#include <utility>

#include "emulator/link/host_error.h"
#include "emulator/link/output_file.h"

namespace fauxboard::host {

ScriptHost::ScriptHost(Parts parts, std::shared_ptr<const script::Scenario> scenario, Speed speed)
    : parts_(std::move(parts)),
      player_(std::move(scenario), speed.max ? 0 : 1 / speed.factor),
      alarm_(parts_.clock.make_alarm([this] { turn(); })) {}

std::string ScriptHost::keep_picture(const std::string& file, std::string_view png) {
    try {
        link::write_output(file, file, png);
    } catch (const link::HostError& error) {
        return error.what();
    }
    return {};
}

void ScriptHost::start() {
    real_start_ = real_time();
    running_ = true;
    alarm_->at(SimTime{0});
}

void ScriptHost::turn() {
    if (!running_) {
        return;
    }
    in_turn_ = true;
    due_ = player_.advance(parts_.clock.now(), real_time() - real_start_, *this);
    in_turn_ = false;
    if (player_.done()) {
        running_ = false;
        parts_.on_done();
        return;
    }
    alarm_->at(player_.wants_turn() ? parts_.clock.now() : due_);
}

/// Something has passed; the player looks at it in this very moment of virtual time, but not from in here.
void ScriptHost::wake() {
    if (running_ && !in_turn_) {
        alarm_->at(parts_.clock.now());
    }
}

void ScriptHost::interrupt(std::string_view why) {
    if (running_) {
        running_ = false;
        alarm_->at(machine::never);
        player_.interrupt(parts_.clock.now(), why);
    }
}

void ScriptHost::on_received(SimTime now, board::Channel channel, std::string_view line,
                             board::Verdict verdict) {
    player_.on_received(now, channel, line, verdict);
    wake();
}

void ScriptHost::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    player_.on_sent(now, channel, line);
    wake();
}

void ScriptHost::on_event(SimTime now, machine::EventId event) {
    player_.on_event(now, event);
    wake();
}

}  // namespace fauxboard::host
