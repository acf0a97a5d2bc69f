#pragma once

#include <cstdint>

#include "emulator/filament/names.h"
#include "emulator/filament/thermal.h"

namespace fauxboard::filament {

/// M109 and M190: the board's main loop stands still until a heater is there, and reports now and then.
///
/// The report interval is the firmware's own arithmetic: a u8 counts steps of 0.2 s and a report goes out
/// when it is a multiple of 10. It wraps at 256, so one interval in 25 is 1.2 s instead of 2 s: the recorded
/// "hiccup" of 51.2 s.
class HeatingWait {
  public:
    void power_on() { active_ = false; }
    void start(HeaterId heater, SimTime now, EventQueue& events);
    void cancel(EventQueue& events);
    void advance(SimTime now, const Thermal& thermal, EventQueue& events);
    bool active() const { return active_; }
    HeaterId heater() const { return heater_; }
    SimTime next_event() const { return active_ ? next_ : never; }

  private:
    static constexpr SimTime step{200'000};
    bool active_ = false;
    HeaterId heater_ = HeaterId::nozzle;
    std::uint8_t counter_ = 0;
    SimTime next_ = never;
};

}  // namespace fauxboard::filament
