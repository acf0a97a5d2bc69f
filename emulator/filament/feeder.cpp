#include "emulator/filament/feeder.h"
#include "emulator/filament/event_rows.h"
#include "emulator/filament/names.h"

namespace fauxboard::filament {
namespace {

constexpr double piece_mm = 10;

}  // namespace

void Feeder::power_on() {
    mode_ = Mode::idle;
    next_ = never;
    stopping_ = false;
}

void Feeder::start(Mode mode, SimTime now) {
    mode_ = mode;
    stopping_ = false;
    piece_start_ = now;
    next_ = now + from_seconds(config_.piece_s);
}

void Feeder::feed_once(SimTime now) {
    start(Mode::load, now);
    stopping_ = true;
}

void Feeder::stop(SimTime now, EventQueue& events) {
    if (mode_ == Mode::idle || now - piece_start_ < from_seconds(config_.piece_commit_s)) {
        power_on();
        events.raise(event("filament.stopped"));
        return;
    }
    stopping_ = true;
}

void Feeder::advance(SimTime now, EventQueue& events) {
    while (mode_ != Mode::idle && next_ <= now) {
        events.raise(event("filament.piece"));
        fed_ += mode_ == Mode::load ? piece_mm : mode_ == Mode::unload ? -piece_mm : 0;
        if (stopping_) {
            power_on();
            events.raise(event("filament.stopped"));
            return;
        }
        piece_start_ = next_;
        next_ += from_seconds(config_.piece_s);
    }
}

}  // namespace fauxboard::filament
