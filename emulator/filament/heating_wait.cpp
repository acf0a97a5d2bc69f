#include "emulator/filament/heating_wait.h"

namespace fauxboard::machine {

void HeatingWait::start(HeaterId heater, SimTime now, EventQueue& events) {
    active_ = true;
    heater_ = heater;
    counter_ = 0;
    next_ = now + step;
    events.raise(EventId::heating_wait_started);
}

void HeatingWait::cancel(EventQueue& events) {
    if (active_) {
        active_ = false;
        events.raise(EventId::heating_wait_done);
    }
}

void HeatingWait::advance(SimTime now, const Thermal& thermal, EventQueue& events) {
    if (!active_ || next_ > now) {
        return;
    }
    next_ += step;
    ++counter_;
    if (counter_ % 10 == 0) {
        events.raise(EventId::heating_wait_report);
    }
    if (!thermal.heating(heater_) || thermal.reached(heater_)) {
        cancel(events);
    }
}

}  // namespace fauxboard::machine
