#include "emulator/filament/heating_wait.h"
#include "emulator/filament/event_rows.h"
#include "emulator/filament/names.h"

namespace fauxboard::filament {

void HeatingWait::start(HeaterId heater, SimTime now, EventQueue& events) {
    active_ = true;
    heater_ = heater;
    counter_ = 0;
    next_ = now + step;
    events.raise(event("heating.wait_started"));
}

void HeatingWait::cancel(EventQueue& events) {
    if (active_) {
        active_ = false;
        events.raise(event("heating.wait_done"));
    }
}

void HeatingWait::advance(SimTime now, const Thermal& thermal, EventQueue& events) {
    if (!active_ || next_ > now) {
        return;
    }
    next_ += step;
    ++counter_;
    if (counter_ % 10 == 0) {
        events.raise(event("heating.wait_report"));
    }
    if (!thermal.heating(heater_) || thermal.reached(heater_)) {
        cancel(events);
    }
}

}  // namespace fauxboard::filament
