#include "emulator/filament/heating_wait.h"

#include <cmath>
#include <utility>

#include "emulator/filament/event_rows.h"

namespace fauxboard::filament {
namespace {

/// Marlin's MIN_COOLING_SLOPE_TIME and MIN_COOLING_SLOPE_DEG (of the bed: .._BED).
constexpr SimTime cooling_time{60'000'000};
constexpr double nozzle_cooling_c = 1.5;
constexpr double bed_cooling_c = 1;

}  // namespace

void HeatingWait::start(HeaterId heater, SimTime now, EventQueue& events, bool cools) {
    active_ = first_look_ = true;
    cools_ = cools;
    heater_ = heater;
    target_c_.reset();
    counter_ = 0;
    left_s_ = -1;
    settled_ = cooled_ = never;
    report_due_ = now;
    next_ = config_.report_s > 0 ? now : now + step;
    events.raise(event("heating.wait_started"));
}

void HeatingWait::cancel(EventQueue& events) {
    if (active_) {
        active_ = false;
        events.raise(event("heating.wait_done"));
    }
}

void HeatingWait::report(SimTime now, EventQueue& events) {
    ++counter_;
    if (config_.report_s > 0) {
        if (report_due_ <= now) {
            report_due_ = now + from_seconds(config_.report_s);
            events.raise(event("heating.wait_report"));
        }
    } else if (counter_ % 10 == 0) {
        events.raise(event("heating.wait_report"));
    }
}

bool HeatingWait::gives_up(SimTime now, const Thermal& thermal) {
    if (!cools_ || !thermal.above(heater_) || (cooled_ != never && cooled_ > now)) {
        return false;
    }
    const double c = thermal.sensed_c(heater_);
    const bool too_slow =
        cooled_ != never && cooled_c_ - c < (heater_ == HeaterId::bed ? bed_cooling_c : nozzle_cooling_c);
    cooled_ = now + cooling_time;
    cooled_c_ = c;
    return too_slow;
}

bool HeatingWait::done(SimTime now, const Thermal& thermal) {
    const bool there =
        (!thermal.heating(heater_) || thermal.reached(heater_)) && (!cools_ || !thermal.above(heater_));
    if (config_.residency_s <= 0) {
        return there;
    }
    if (!thermal.heating(heater_) && !cools_) {
        return true;  // switched off meanwhile
    }
    const double off_c = std::fabs(thermal.sensed_c(heater_) - thermal.target_c(heater_));
    if (settled_ == never ? there : off_c > config_.hysteresis_c) {
        const double more = first_look_ ? 4.0 / 3 : 1;
        settled_ = now + from_seconds(config_.residency_s * more);
    }
    first_look_ = false;
    return settled_ <= now;
}

void HeatingWait::advance(SimTime now, const Thermal& thermal, EventQueue& events) {
    if (!active_ || next_ > now) {
        return;
    }
    next_ += step;
    left_s_ = settled_ == never ? -1 : static_cast<int>((settled_ - now) / SimTime{1'000'000});
    report(now, events);
    const double target_c = thermal.target_c(heater_);
    const bool changed = std::exchange(target_c_, target_c).value_or(target_c) != target_c;
    // As in Marlin: of a target that was changed meanwhile only heating is waited for.
    const bool lowered = changed && !cools_ && thermal.above(heater_);
    if (lowered || done(now, thermal) || gives_up(now, thermal)) {
        cancel(events);
    }
}

}  // namespace fauxboard::filament
