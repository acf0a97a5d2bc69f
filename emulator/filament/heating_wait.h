#pragma once

#include <cstdint>
#include <optional>

#include "emulator/filament/names.h"
#include "emulator/filament/thermal.h"

namespace fauxboard::filament {

/// How M109 and M190 wait.
struct HeatingWaitConfig {
    /// Between two reports; 0: as the Smartto firmware has it, whose own arithmetic is a u8 that counts steps
    /// of 0.2 s, with a report when it is a multiple of 10. It wraps at 256, so one interval in 25 is 1.2 s
    /// instead of 2 s: the recorded "hiccup" of 51.2 s.
    double report_s = 0;
    /// How long it must have been there (Marlin's TEMP_RESIDENCY_TIME), off by no more than hysteresis_c,
    /// else the time starts anew; a third more when it is there at the first look. 0: it is over when it is
    /// there.
    double residency_s = 0;
    double hysteresis_c = 3;
};

/// M109 and M190: the board's main loop stands still until a heater is there, and reports now and then.
class HeatingWait {
  public:
    explicit HeatingWait(const HeatingWaitConfig& config) : config_(config) {}

    void power_on() { active_ = false; }
    /// `cools`: it is to come down to its target as well (M109 R), as long as it does: Marlin gives up when
    /// it has lost too little in a minute.
    void start(HeaterId heater, SimTime now, EventQueue& events, bool cools = false);
    void cancel(EventQueue& events);
    void advance(SimTime now, const Thermal& thermal, EventQueue& events);
    bool active() const { return active_; }
    /// Whether a temperature must hold, also one that is there already.
    bool settles() const { return config_.residency_s > 0; }
    HeaterId heater() const { return heater_; }
    /// Whole seconds that it has still to stay there; -1: it is not there yet. As it was when the last look
    /// began: a report comes before what that look finds out.
    int residency_left_s() const { return left_s_; }
    SimTime next_event() const { return active_ ? next_ : never; }

  private:
    static constexpr SimTime step{200'000};

    bool done(SimTime now, const Thermal& thermal);
    bool gives_up(SimTime now, const Thermal& thermal);
    void report(SimTime now, EventQueue& events);

    const HeatingWaitConfig& config_;
    bool active_ = false;
    bool cools_ = false;
    bool first_look_ = false;
    HeaterId heater_ = HeaterId::nozzle;
    std::uint8_t counter_ = 0;
    int left_s_ = -1;
    std::optional<double> target_c_;  ///< when it was last looked
    SimTime report_due_ = never;
    SimTime settled_ = never;  ///< when it will have been there long enough
    SimTime cooled_ = never;   ///< when it is next looked whether it cools at all
    double cooled_c_ = 0;      ///< what it was then
    SimTime next_ = never;
};

}  // namespace fauxboard::filament
