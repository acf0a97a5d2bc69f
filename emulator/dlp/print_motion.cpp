// Homing, moves by hand, and where the platform goes in a print.

#include <algorithm>

#include "emulator/dlp/print.h"

namespace fauxboard::dlp {
namespace {

constexpr double away_mm = 20;       ///< from a switch that is closed already
constexpr double back_mm = 3;        ///< from the switch, before it is looked for slowly
constexpr double beyond_mm = 2;      ///< the longest way that homing looks for a switch is max_pos and this
constexpr double careful_mm = 30;    ///< below it the platform goes slowly
constexpr double careful_mm_s = 5;   ///< no slower than this
constexpr double raise_to_mm = 100;  ///< after Z=0 was set (0.08)
constexpr double below_top_mm = 5;   ///< where a print leaves the platform (0.01)

double wide(float value) {
    return static_cast<double>(value);
}

}  // namespace

void Print::go(double mm, double mm_s, double mm_s2, SimTime now, bool switches) {
    parts_.platform.move({mm, mm_s, mm_s2}, switches, now);
}

/// A third of the speed of free moves, but not below 5 mm/s.
double Print::slow_travel() const {
    return std::max(wide(parts_.settings.motor.travel_feedrate) / 3, careful_mm_s);
}

bool Print::home_closed(SimTime now) const {
    return home_side() < 0 ? parts_.platform.lower_closed(now) : parts_.platform.upper_closed(now);
}

void Print::begin_homing(SimTime now) {
    const MotorSettings& motor = parts_.settings.motor;
    homed_ = false;
    parts_.platform.call_it(0, now);
    enter(PrintState::homing_preup);
    if (home_closed(now)) {
        go(-home_side() * away_mm, wide(motor.homing_feedrate_fast), wide(motor.travel_acceleration), now);
    }
}

void Print::homing_step(SimTime now) {
    const MotorSettings& motor = parts_.settings.motor;
    const double fast = wide(motor.homing_feedrate_fast);
    const double acceleration = wide(motor.travel_acceleration);
    const double home = wide(motor.home_pos_mm);
    const double side = home_side();
    const bool closed = home_closed(now);
    switch (state_) {
        case PrintState::homing_preup:
            if (parts_.platform.lower_closed(now) || parts_.platform.upper_closed(now)) {
                return fail_homing(now);
            }
            enter(PrintState::homing_fast);
            return go(side * (wide(motor.max_pos_mm) + (parts_.quirks.short_homing_search ? 0 : beyond_mm)),
                      fast, acceleration, now, true);
        case PrintState::homing_fast:
            if (!closed) {
                return fail_homing(now);
            }
            parts_.platform.call_it(home, now);
            if (for_print_) {
                parts_.panel.wake(now);
            }
            enter(PrintState::homing_up);
            return go(home - side * back_mm, fast, acceleration, now);
        case PrintState::homing_up:
            if (closed) {
                return fail_homing(now);
            }
            enter(PrintState::homing_slow);
            return go(side + (parts_.quirks.slow_homing_to_one ? 0 : home), wide(motor.homing_feedrate_slow),
                      acceleration, now, true);
        default:
            if (!closed) {
                return fail_homing(now);
            }
            parts_.platform.call_it(home, now);
            homed_ = true;
            return at_home(now);
    }
}

void Print::fail_homing(SimTime now) {
    const bool for_print = for_print_;
    for_print_ = false;
    enter(PrintState::idle);
    if (for_print) {
        parts_.panel.sleep(now);
        parts_.panel.command(2, false, false, now);
        file_.reset();
        paused_ = false;
        wall_end_ = now;
    }
    parts_.listener.raise(for_print ? Event::print_homing_failed : Event::platform_homing_failed);
}

void Print::at_home(SimTime now) {
    if (for_print_) {
        for_print_ = false;
        begin_printing(now);
        return;
    }
    enter(PrintState::idle);
    parts_.listener.raise(Event::platform_homed);
}

bool Print::home(SimTime now) {
    if (state_ != PrintState::idle) {
        return false;
    }
    if (for_print_) {  // the slip: a print stopped while it homed is still wanted
        return start(path_, now);
    }
    begin_homing(now);
    advance(now);
    return true;
}

bool Print::jog(double mm, SimTime now) {
    if (state_ != PrintState::idle && state_ != PrintState::free_moving) {
        return false;
    }
    const MotorSettings& motor = parts_.settings.motor;
    const double from = parts_.platform.target();
    double to = from + mm;
    if (homed_) {
        // A platform beyond a limit may come back, and not go on.
        to = std::clamp(to, std::min(wide(motor.min_pos_mm), from), std::max(wide(motor.max_pos_mm), from));
    }
    if (to == from) {
        return true;
    }
    const bool careful = !homed_ || from < careful_mm;
    enter(PrintState::free_moving);
    go(to, careful ? slow_travel() : wide(motor.travel_feedrate), wide(motor.travel_acceleration), now);
    return true;
}

bool Print::raise_after_zero(SimTime now) {
    if (state_ != PrintState::idle || !homed_) {
        return false;
    }
    const MotorSettings& motor = parts_.settings.motor;
    const double top = wide(motor.max_pos_mm);
    const double from = parts_.platform.position(now);
    enter(PrintState::free_moving);
    for (const auto& [to, mm_s] :
         {std::pair{careful_mm, slow_travel()}, std::pair{raise_to_mm, wide(motor.travel_feedrate)}}) {
        if (std::min(to, top) > std::max(from, parts_.platform.target())) {
            go(std::min(to, top), mm_s, wide(motor.travel_acceleration), now);
        }
    }
    return true;
}

bool Print::stop_moving(SimTime now) {
    if (file_ || (state_ != PrintState::free_moving && !homing())) {
        return false;
    }
    parts_.platform.stop(now);
    enter(PrintState::idle);
    parts_.listener.raise(Event::platform_stopped);
    return true;
}

/// Off the film, to above the layer.
void Print::go_up(SimTime now) {
    const MotorSettings& motor = parts_.settings.motor;
    const double to = zero() + plan_.z_mm + plan_.lift_mm;
    if (parts_.firmware == Firmware::v008) {
        go(to - plan_.lift_mm / 3, plan_.lift_mm_s, wide(motor.acceleration), now);
        go(to, plan_.lift_mm_s, wide(motor.travel_acceleration), now);
        return;
    }
    go(to, plan_.lift_mm_s, wide(motor.acceleration), now);
}

void Print::go_down(SimTime now) {
    const MotorSettings& motor = parts_.settings.motor;
    const double to = zero() + plan_.z_mm;
    if (parts_.firmware == Firmware::v008) {
        constexpr double part = 1.5;
        go(to + plan_.lift_mm / part, plan_.drop_mm_s, wide(motor.travel_acceleration), now);
    }
    go(to, plan_.drop_mm_s, wide(motor.acceleration), now);
}

/// Beyond the lift of the layer, as far as the pause wants and the axis has.
void Print::go_to_pause(SimTime now) {
    const double from = parts_.platform.target();
    const double to =
        std::min(from + wide(parts_.settings.general.pause_lift_mm), wide(parts_.settings.motor.max_pos_mm));
    if (to > from) {
        go(to, slow_travel(), wide(parts_.settings.motor.travel_acceleration), now);
    }
}

void Print::go_back_from_pause(SimTime now) {
    const double to = zero() + plan_.z_mm + plan_.lift_mm;
    go(to, slow_travel(), wide(parts_.settings.motor.travel_acceleration), now);
    go_down(now);
}

/// After the last layer: off the film, carefully out of the vat, and up. Never down.
void Print::go_to_end(SimTime now) {
    const MotorSettings& motor = parts_.settings.motor;
    const double top = wide(motor.max_pos_mm);
    const double end = parts_.firmware == Firmware::v008 ? parts_.platform.target() + plan_.lift_mm +
                                                               wide(parts_.settings.general.end_lift_mm)
                                                         : top - below_top_mm;
    const auto up = [&](double to, double mm_s, double mm_s2) {
        if (std::min(to, top) > parts_.platform.target()) {
            go(std::min(to, top), mm_s, mm_s2, now);
        }
    };
    if (parts_.quirks.end_goes_down) {
        go(zero() + plan_.lift_mm, plan_.lift_mm_s, wide(motor.acceleration), now);
    } else {
        up(parts_.platform.target() + plan_.lift_mm, plan_.lift_mm_s, wide(motor.acceleration));
    }
    up(careful_mm, slow_travel(), wide(motor.travel_acceleration));
    up(end, wide(motor.travel_feedrate), wide(motor.travel_acceleration));
}

}  // namespace fauxboard::dlp
