// Filament on its way through the extruder, and the heater that has to be warm enough for it.

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/printer.h"

namespace fauxboard::filament {

void Printer::feed(Feeder::Mode mode) {
    if (too_cold_to_extrude()) {
        events.raise(event("filament.too_cold"));
        return;
    }
    motion.set_motors(true);
    motion.show_feed(config().filament.feed_mm_s);
    feeder.start(mode, now());
}

void Printer::feed_once() {
    if (too_cold_to_extrude()) {
        events.raise(event("filament.too_cold"));
        return;
    }
    motion.set_motors(true);
    motion.show_feed(config().filament.feed_mm_s);
    feeder.feed_once(now());
}

void Printer::set_filament(bool present) {
    if (filament.present == present) {
        return;
    }
    filament.present = present;
    events.raise(present ? event("filament.inserted") : event("filament.removed"));
    if (!present && filament.detector && job.status() == JobStatus::printing) {
        events.raise(event("filament.out"));
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
    const double patience = config().filament.detector_mm;
    if (patience > 0 && filament_path.stuck_mm > patience && filament.detector && filament.present &&
        job.status() == JobStatus::printing && !job.pausing()) {
        filament_path.stuck_mm = 0;
        events.raise(event("filament.out"));
    }
}

bool Printer::too_cold_to_extrude() const {
    return thermal.sensed_c(HeaterId::nozzle) < std::max(config().filament.min_extrude_c, chilled_c_);
}

void Printer::chill(double c) {
    chilled_c_ = c;
    if (feeder.mode() != Feeder::Mode::idle && too_cold_to_extrude()) {
        feeder.stop(now(), events);
        events.raise(event("filament.too_cold"));
    }
}

void Printer::raise_alarms() {
    while (const auto heater = thermal.take_alarm()) {
        tuning = false;
        events.raise(*heater == HeaterId::nozzle ? event("heater.nozzle_abnormal")
                                                 : event("heater.bed_abnormal"));
    }
}

void Printer::start_tuning(HeaterId heater, double c) {
    stop_tuning();
    tuning = true;
    tuned_ = heater;
    thermal.set_target(heater, c);
    events.raise(event("heating.pid_question"));
}

void Printer::stop_tuning() {
    if (std::exchange(tuning, false)) {
        thermal.set_target(tuned_, 0);
    }
}

}  // namespace fauxboard::filament
