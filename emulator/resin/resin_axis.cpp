#include "emulator/resin/resin_axis.h"
#include "emulator/resin/event_rows.h"
#include "emulator/resin/names.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::resin {
namespace {

using Setting = ResinSetting;

/// Slower is not to be had: settings may say 0.
constexpr double least_mm_s = 0.01;
constexpr double least_mm_s2 = 0.1;

/// A way of so many mm, from rest to rest: accelerates, goes on, brakes.
struct Ramp {
    Ramp(double mm, double mm_s, double mm_s2)
        : acceleration(std::max(mm_s2, least_mm_s2)),
          speed(std::min(std::max(mm_s, least_mm_s), std::sqrt(mm * acceleration))),
          ramp_s(speed / acceleration),
          total_s(mm <= 0 ? 0 : mm / speed + ramp_s),
          way(mm) {}

    /// How far it has come after `s` seconds.
    double at(double s) const {
        if (s <= 0 || way <= 0) {
            return 0;
        }
        if (s >= total_s) {
            return way;
        }
        if (s < ramp_s) {
            return acceleration * s * s / 2;
        }
        const double left = total_s - s;
        return left < ramp_s ? way - acceleration * left * left / 2 : speed * (s - ramp_s / 2);
    }

    double acceleration;
    double speed;
    double ramp_s;
    double total_s;
    double way;
};

}  // namespace

void ResinAxis::power_on() {
    count_ = 0;
    way_ = 0;
    zero_ = height_;
    homed_ = motors_ = relative = false;
}

double ResinAxis::height(SimTime now) const {
    if (!busy() || way_ == 0) {
        return height_;
    }
    const Ramp ramp(std::abs(way_), speed_, settings_[Setting::acceleration]);
    return height_ + std::copysign(ramp.at(to_seconds(now - start_)), way_);
}

/// As high as the platform may go: the longest way the settings allow, from where zero is known, within what
/// is there.
double ResinAxis::top() const {
    const double most = homed_ ? zero_ + settings_[Setting::max_height] : config_.travel_mm;
    return std::clamp(most, 0.0, config_.travel_mm);
}

double ResinAxis::target(const Step& step) const {
    // The end stop gives way a little: zero may lie below it.
    const double bottom = homed_ ? std::min(0.0, zero_) : 0.0;
    const double wanted = step.kind == Step::Kind::to   ? zero_ + step.mm
                          : step.kind == Step::Kind::by ? height_ + step.mm
                                                        : (step.mm > 0 ? config_.travel_mm : 0);
    if (step.kind == Step::Kind::end_stop) {
        return wanted;
    }
    // A platform that stands beyond a limit may leave it and not go on.
    return std::clamp(wanted, std::min(bottom, height_), std::max(top(), height_));
}

bool ResinAxis::push(const Step& step) {
    if (count_ == most_steps) {
        return false;
    }
    steps_[(head_ + count_++) % most_steps] = step;
    return true;
}

/// Starts the first step of the queue.
void ResinAxis::begin(SimTime now) {
    const Step& step = steps_[head_];
    way_ = 0;
    start_ = end_ = now;
    if (step.kind == Step::Kind::zero || step.kind == Step::Kind::homed) {
        return;
    }
    motors_ = true;
    way_ = target(step) - height_;
    speed_ = std::min(step.mm_s, std::max(settings_[Setting::max_speed], least_mm_s));
    end_ = now + from_seconds(Ramp(std::abs(way_), speed_, settings_[Setting::acceleration]).total_s);
}

bool ResinAxis::move(double mm, bool by, double mm_min, SimTime now) {
    const double mm_s = mm_min > 0 ? mm_min / 60 : settings_[Setting::start_speed];
    const bool rests = !busy();
    if (!push({by ? Step::Kind::by : Step::Kind::to, mm, mm_s})) {
        return false;
    }
    if (rests) {
        begin(now);
    }
    return true;
}

bool ResinAxis::homing() const {
    for (std::size_t i = 0; i < count_; ++i) {
        if (steps_[(head_ + i) % most_steps].kind == Step::Kind::homed) {
            return true;
        }
    }
    return false;
}

bool ResinAxis::home(SimTime now) {
    constexpr std::size_t steps = 6;
    if (count_ + steps > most_steps) {
        return false;
    }
    const bool rests = !busy();
    const double side = settings_[Setting::limit_side] != 0 ? 1 : -1;
    const double fast = settings_[Setting::home_speed];
    const double slow = settings_[Setting::home_again_speed];
    push({Step::Kind::end_stop, side, fast});
    push({Step::Kind::by, -side * config_.homing_bounce_mm, slow});
    push({Step::Kind::end_stop, side, slow});
    push({Step::Kind::zero, side, 0});
    if (settings_[Setting::after_homing] == 0 && settings_[Setting::after_z_homing] == 0) {
        push({Step::Kind::to, 0, slow});
    }
    push({Step::Kind::homed, 0, 0});
    if (rests) {
        begin(now);
    }
    return true;
}

bool ResinAxis::stir(int cycles, SimTime now) {
    const auto steps = static_cast<std::size_t>(std::max(cycles, 0)) * 2;
    if (count_ + steps > most_steps) {
        return false;
    }
    const bool rests = !busy();
    const double mm = settings_[Setting::lift];
    for (std::size_t i = 0; i < steps; ++i) {
        push({Step::Kind::by, i % 2 == 0 ? mm : -mm, settings_[Setting::lift_fast_speed]});
    }
    if (rests && steps != 0) {
        begin(now);
    }
    return true;
}

void ResinAxis::abort(SimTime now) {
    height_ = height(now);
    count_ = 0;
    way_ = 0;
}

void ResinAxis::motors_off(SimTime now) {
    abort(now);
    motors_ = false;
    homed_ = false;
}

void ResinAxis::advance(SimTime now, EventQueue& events) {
    while (busy() && end_ <= now) {
        const Step& step = steps_[head_];
        height_ += way_;
        way_ = 0;
        if (step.kind == Step::Kind::zero) {
            const double offset = settings_[Setting::offset_used] != 0 ? settings_[Setting::offset] : 0;
            zero_ = step.mm > 0 ? height_ - settings_[Setting::max_height] : height_ + offset;
            homed_ = true;
        } else if (step.kind == Step::Kind::homed) {
            events.raise(event("motion.homed"));
        }
        head_ = (head_ + 1) % most_steps;
        --count_;
        if (busy()) {
            begin(end_);
        }
    }
}

}  // namespace fauxboard::resin
