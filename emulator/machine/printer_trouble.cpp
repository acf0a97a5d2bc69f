// What a machine does when something is wrong with it: alarms, standing still, waiting for people.

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/machine/printer.h"

namespace fauxboard::machine {
namespace {

/// After so long without a word the USB side counts as left alone.
constexpr SimTime host_patience{10'000'000};

}  // namespace

void Printer::raise_alarms() {
    while (const auto heater = thermal.take_alarm()) {
        tuning = false;
        events.raise(*heater == HeaterId::nozzle ? EventId::heater_nozzle_abnormal
                                                 : EventId::heater_bed_abnormal);
    }
}

/// What was extruded since the last look: some of it moved filament, if any.
void Printer::follow_filament() {
    const double extruded = motion.extruded_mm() + feeder.fed_mm();
    const double piece = extruded - std::exchange(filament_path.counted_mm, extruded);
    if (piece == 0) {
        return;
    }
    const double share = too_cold_to_extrude() ? 0 : 1 - filament_path.lost;
    filament_path.moved_mm += piece * share;
    filament_path.stuck_mm = share > 0 ? 0 : filament_path.stuck_mm + std::fabs(piece);
    const double patience = config_->filament.detector_mm;
    if (patience > 0 && filament_path.stuck_mm > patience && filament.detector && filament.present &&
        job.status() == JobStatus::printing && !job.pausing()) {
        filament_path.stuck_mm = 0;
        events.raise(EventId::filament_out);
    }
}

bool Printer::too_cold_to_extrude() const {
    return thermal.sensed_c(HeaterId::nozzle) < std::max(config_->filament.min_extrude_c, chilled_c_);
}

void Printer::chill(double c) {
    chilled_c_ = c;
    if (feeder.mode() != Feeder::Mode::idle && too_cold_to_extrude()) {
        feeder.stop(now_, events);
        events.raise(EventId::filament_too_cold);
    }
}

void Printer::user_continues() {
    if (job.waits_for_user && !resume_job()) {
        job.waits_for_user = false;
    }
}

void Printer::start_tuning(HeaterId heater, double c) {
    stop_tuning();
    tuning = true;
    tuned_ = heater;
    thermal.set_target(heater, c);
    events.raise(EventId::heating_pid_question);
}

void Printer::stop_tuning() {
    if (std::exchange(tuning, false)) {
        thermal.set_target(tuned_, 0);
    }
}

void Printer::hang(bool powered) {
    hung_ = true;
    motion.abort();
    feeder.power_on();
    if (resin) {
        resin->axis.abort(now_);
    }
    thermal.freeze(powered);
}

bool Printer::take_reset() {
    return std::exchange(reset_, false);
}

void Printer::hear_host(SimTime now) {
    host_heard_ = now;
}

bool Printer::host_active() const {
    return host_heard_ && now_ - *host_heard_ <= host_patience;
}

}  // namespace fauxboard::machine
