#include "emulator/filament/recovery.h"

#include <utility>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/heating_wait.h"
#include "emulator/filament/job_runner.h"
#include "emulator/filament/motion.h"
#include "emulator/filament/names.h"
#include "emulator/filament/procedures.h"
#include "emulator/filament/state.h"

namespace fauxboard::filament {
namespace {

constexpr double travel_feed_mm_s = 100;
constexpr double z_feed_mm_s = 20;
constexpr unsigned x_and_y = 3;

}  // namespace

void Recovery::load(machine::JobPlaceStore* store) {
    store_ = store;
    if (store_ != nullptr) {
        const auto bytes = store_->load();
        place_ = bytes ? place_from(*bytes) : std::nullopt;
    }
}

const JobPlace* Recovery::saved() const {
    return place_ && !on_.job.active() ? &*place_ : nullptr;
}

void Recovery::drop() {
    if (place_) {
        place_.reset();
        if (store_ != nullptr) {
            store_->drop();
        }
    }
}

void Recovery::keep(SimTime now) {
    const Job& job = on_.job;
    if (!job.active() || step_ != Step::none) {
        return;
    }
    const std::uint64_t byte = runner_.executed_byte();
    if (place_ && place_->byte == byte && place_->path == job.path() && place_->volume == job.volume()) {
        return;
    }
    JobPlace& place = place_ ? *place_ : place_.emplace();
    place.volume = job.volume();
    place.path = job.path();
    place.bytes = job.file_bytes();
    place.byte = byte;
    place.layer = job.layer;
    place.layers = job.layers;
    place.elapsed = job.elapsed(now);
    const Motion& motion = on_.motion;
    place.at = motion.executed();
    place.nozzle_c = on_.thermal.target_c(HeaterId::nozzle);
    place.bed_c = on_.thermal.target_c(HeaterId::bed);
    place.part_fan_percent = on_.fans.part_percent;
    place.speed_percent = motion.speed_percent();
    place.flow_percent = motion.flow_percent();
    place.modal = on_.modal;
    place.relative = motion.relative();
    place.relative_e = motion.relative_e_alone();
    store();
}

void Recovery::store() {
    if (store_ != nullptr) {
        put_place(*place_, kept_);
        store_->keep(kept_);
    }
}

void Recovery::seek() {
    if (place_ && on_.job.active() && place_->byte != on_.job.place()) {
        place_->byte = on_.job.place();
        store();
    }
}

bool Recovery::file_there() const {
    const Volume* volume = place_ ? storage_.volume(place_->volume) : nullptr;
    std::uint64_t bytes = 0;
    return volume != nullptr && volume->look(place_->path, bytes) == Volume::Kind::file &&
           bytes == place_->bytes;
}

void Recovery::stand_paused() {
    if (saved() == nullptr) {
        return;
    }
    on_.job.select(place_->volume, place_->path, place_->bytes);
    on_.job.stand_paused(place_->byte, place_->elapsed);
    on_.job.layer = place_->layer;
    on_.job.layers = place_->layers;
}

bool Recovery::begin() {
    const bool paused = config_.resume_homes_first && on_.job.status() == JobStatus::paused;
    if (!place_ || (on_.job.active() && !paused)) {
        return false;
    }
    if (!file_there()) {
        on_.events.raise(event("file.missing"));
        return false;
    }
    on_.job.select(place_->volume, place_->path, place_->bytes);
    on_.job.recover(place_->byte, place_->elapsed);
    on_.job.layer = place_->layer;
    on_.job.layers = place_->layers;
    step_ = after(Step::none);
    return true;
}

/// The order of the steps: heat, home, go there and print; or home, heat, go there and print.
Recovery::Step Recovery::after(Step step) const {
    const bool homes_first = config_.resume_homes_first;
    switch (step) {
        case Step::none:
            return homes_first ? Step::home : Step::bed;
        case Step::bed:
            return Step::nozzle;
        case Step::nozzle:
            return homes_first ? Step::travel : Step::home;
        case Step::home:
            return homes_first ? Step::bed : Step::travel;
        case Step::travel:
            return Step::print;
        case Step::print:
            break;
    }
    return Step::none;
}

SimTime Recovery::next_step(SimTime now) const {
    const bool waits = on_.wait.active() || on_.motion.busy();
    return waits ? never : now;
}

void Recovery::heat(HeaterId heater, double c, SimTime now) {
    on_.thermal.set_target(heater, c);
    if (on_.thermal.heating(heater) && !on_.thermal.reached(heater)) {
        on_.wait.start(heater, now, on_.events);
    }
}

void Recovery::travel(SimTime now) {
    on_.motion.set_position({std::nullopt, std::nullopt, place_->at[2], place_->at[3]});
    Procedure way(2);
    way[0].kind = way[1].kind = ProcedureStep::Kind::to;
    way[0].values = {place_->at[0], place_->at[1], std::nullopt, std::nullopt};
    way[0].feed_mm_s = travel_feed_mm_s;
    way[1].values = {std::nullopt, std::nullopt, place_->at[2], std::nullopt};
    way[1].feed_mm_s = z_feed_mm_s;
    on_.motion.run(way, now, on_.events);
}

void Recovery::print(SimTime now) {
    const JobPlace place = *place_;
    on_.job.go_on(now);
    runner_.start(now);
    on_.events.raise(event("job.started"));
    on_.job.layer = place.layer;
    on_.job.layers = place.layers;
    on_.modal = place.modal;
    on_.fans.part_percent = place.part_fan_percent;
    on_.motion.set_speed_percent(place.speed_percent);
    on_.motion.set_flow_percent(place.flow_percent);
    on_.motion.set_relative(place.relative);
    on_.motion.set_relative_e(place.relative_e);
}

void Recovery::advance(SimTime now) {
    while (step_ != Step::none && !on_.wait.active() && !on_.motion.busy()) {
        switch (std::exchange(step_, after(step_))) {
            case Step::none:
                break;
            case Step::bed:
                heat(HeaterId::bed, place_->bed_c, now);
                break;
            case Step::nozzle:
                heat(HeaterId::nozzle, place_->nozzle_c, now);
                break;
            case Step::home:
                on_.moves.home(x_and_y, now);
                break;
            case Step::travel:
                travel(now);
                break;
            case Step::print:
                print(now);
                break;
        }
    }
}

}  // namespace fauxboard::filament
