#include "emulator/filament/recovery.h"

#include "emulator/machine/printer.h"

namespace fauxboard::machine {
namespace {

constexpr double travel_feed_mm_s = 100;
constexpr double z_feed_mm_s = 20;

}  // namespace

void Recovery::load(JobPlaceStore* store) {
    store_ = store;
    if (store_ != nullptr) {
        place_ = store_->load();
    }
}

const JobPlace* Recovery::saved() const {
    return place_ && !printer_.job.active() ? &*place_ : nullptr;
}

void Recovery::drop() {
    if (place_) {
        place_.reset();
        if (store_ != nullptr) {
            store_->drop();
        }
    }
}

void Recovery::keep() {
    const Job& job = printer_.job;
    if (!job.active() || step_ != Step::none) {
        return;
    }
    const std::uint64_t byte = printer_.runner.executed_byte();
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
    place.elapsed = job.elapsed(printer_.now());
    const Motion& motion = printer_.motion;
    place.at = motion.executed();
    place.nozzle_c = printer_.thermal.target_c(HeaterId::nozzle);
    place.bed_c = printer_.thermal.target_c(HeaterId::bed);
    place.part_fan_percent = printer_.fans.part_percent;
    place.speed_percent = motion.speed_percent();
    place.flow_percent = motion.flow_percent();
    place.modal = printer_.modal;
    place.relative = motion.relative();
    place.relative_e = motion.relative_e_alone();
    if (store_ != nullptr) {
        store_->keep(place);
    }
}

bool Recovery::begin() {
    if (saved() == nullptr) {
        return false;
    }
    const Volume* volume = printer_.storage.volume(place_->volume);
    std::uint64_t bytes = 0;
    if (volume == nullptr || volume->look(place_->path, bytes) != Volume::Kind::file ||
        bytes != place_->bytes) {
        printer_.events.raise(EventId::file_missing);
        return false;
    }
    printer_.job.select(place_->volume, place_->path, place_->bytes);
    printer_.job.recover(place_->byte, place_->elapsed);
    printer_.job.layer = place_->layer;
    printer_.job.layers = place_->layers;
    step_ = Step::bed;
    return true;
}

SimTime Recovery::next_step() const {
    const bool waits = printer_.wait.active() || printer_.motion.busy();
    return waits ? never : printer_.now();
}

void Recovery::heat(HeaterId heater, double c) {
    printer_.thermal.set_target(heater, c);
    if (printer_.thermal.heating(heater) && !printer_.thermal.reached(heater)) {
        printer_.wait.start(heater, printer_.now(), printer_.events);
    }
}

void Recovery::travel() {
    printer_.motion.set_position({std::nullopt, std::nullopt, place_->at[2], place_->at[3]});
    Procedure way(2);
    way[0].kind = way[1].kind = ProcedureStep::Kind::to;
    way[0].values = {place_->at[0], place_->at[1], std::nullopt, std::nullopt};
    way[0].feed_mm_s = travel_feed_mm_s;
    way[1].values = {std::nullopt, std::nullopt, place_->at[2], std::nullopt};
    way[1].feed_mm_s = z_feed_mm_s;
    printer_.motion.run(way, printer_.now(), printer_.events);
}

void Recovery::print() {
    const JobPlace place = *place_;
    printer_.continue_recovered_job();
    printer_.job.layer = place.layer;
    printer_.job.layers = place.layers;
    printer_.modal = place.modal;
    printer_.fans.part_percent = place.part_fan_percent;
    printer_.motion.set_speed_percent(place.speed_percent);
    printer_.motion.set_flow_percent(place.flow_percent);
    printer_.motion.set_relative(place.relative);
    printer_.motion.set_relative_e(place.relative_e);
}

void Recovery::advance(SimTime) {
    while (step_ != Step::none && !printer_.wait.active() && !printer_.motion.busy()) {
        switch (step_) {
            case Step::none:
                break;
            case Step::bed:
                step_ = Step::nozzle;
                heat(HeaterId::bed, place_->bed_c);
                break;
            case Step::nozzle:
                step_ = Step::home;
                heat(HeaterId::nozzle, place_->nozzle_c);
                break;
            case Step::home:
                step_ = Step::travel;
                printer_.home(static_cast<unsigned>(Printer::HomeAxes::x) |
                              static_cast<unsigned>(Printer::HomeAxes::y));
                break;
            case Step::travel:
                step_ = Step::print;
                travel();
                break;
            case Step::print:
                step_ = Step::none;
                print();
                break;
        }
    }
}

}  // namespace fauxboard::machine
