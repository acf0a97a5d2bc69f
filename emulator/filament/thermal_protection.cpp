#include "emulator/filament/thermal_protection.h"
#include "emulator/filament/names.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::filament {
namespace {

/// What was too hot is no longer when it reads so much less. More than what folded readings jump by.
constexpr double settled_k = 5;

}  // namespace

bool ThermalProtection::check(SimTime now, double target_c, double reading_c) {
    if (target_c != target_c_) {
        target_c_ = target_c;
        reached_ = false;
        due_ = never;
        away_since_ = now;
        alarm_ = target_c != 0 ? ThermalAlarm::none : alarm_;
    }
    ThermalAlarm found = ThermalAlarm::none;
    const bool hot = reading_c > config_->max_c;
    if (hot) {
        found = target_c != 0 || !told_hot_ ? ThermalAlarm::too_hot : ThermalAlarm::none;
    } else if (target_c != 0) {
        found = reading_c < config_->min_c ? ThermalAlarm::too_cold : watch(now, target_c, reading_c);
    }
    told_hot_ = hot || (told_hot_ && reading_c > config_->max_c - settled_k);
    if (found != ThermalAlarm::none) {
        alarm_ = found;
    }
    return found != ThermalAlarm::none;
}

ThermalAlarm ThermalProtection::watch(SimTime now, double target_c, double reading_c) {
    if (config_->any_change) {
        return still(now, target_c, reading_c);
    }
    reached_ = reached_ || reading_c >= target_c;
    if (reached_) {
        if (reading_c >= target_c - config_->runaway_c) {
            away_since_ = now;
        }
        return now - away_since_ > from_seconds(config_->runaway_s) ? ThermalAlarm::runaway
                                                                    : ThermalAlarm::none;
    }
    // So near to the target it may take its time, as in Marlin.
    if (reading_c >= target_c - (config_->watch_rise_c + config_->runaway_c + 1)) {
        due_ = never;
        return ThermalAlarm::none;
    }
    if (due_ == never || (now >= due_ && reading_c >= due_c_)) {
        due_ = now + from_seconds(config_->watch_s);
        due_c_ = reading_c + config_->watch_rise_c;
        return ThermalAlarm::none;
    }
    return now >= due_ ? ThermalAlarm::no_rise : ThermalAlarm::none;
}

ThermalAlarm ThermalProtection::still(SimTime now, double target_c, double reading_c) {
    if (reading_c >= target_c - config_->runaway_c) {
        due_ = never;
        return ThermalAlarm::none;
    }
    if (due_ == never || std::fabs(reading_c - due_c_) >= config_->watch_rise_c) {
        due_ = now + from_seconds(config_->watch_s);
        due_c_ = reading_c;
    }
    return now >= due_ ? ThermalAlarm::no_rise : ThermalAlarm::none;
}

SimTime ThermalProtection::earliest(SimTime next) const {
    const SimTime runaway = from_seconds(config_->runaway_s);
    if (reached_) {
        return away_since_ + runaway;
    }
    return std::min(next + runaway, due_ == never ? next + from_seconds(config_->watch_s) : due_);
}

}  // namespace fauxboard::filament
