#include "emulator/filament/thermal_pid.h"

#include <algorithm>

namespace fauxboard::filament {

double ThermalPid::update(double target_c, double printed_c) {
    const PidConfig& c = *config_;
    const double error = target_c - printed_c;
    const double slope = printed_c - previous_c_;
    previous_c_ = printed_c;
    if (target_c != target_c_) {
        target_c_ = target_c;
        in_range_ = false;
    }
    if (error > c.range_c) {
        return c.max_output;
    }
    if (error < -c.off_below_c) {
        in_range_ = false;
        return 0;
    }
    if (!in_range_) {
        in_range_ = true;
        error_sum_ = 0;
        slope_term_ = 0;
    }
    error_sum_ += error;
    if (c.ki > 0) error_sum_ = std::clamp(error_sum_, -c.max_output / c.ki, c.max_output / c.ki);
    slope_term_ = slope * c.kd * c.k1 + slope_term_ * (1 - c.k1);
    return std::clamp(c.kp * error + c.ki * error_sum_ - slope_term_, 0.0, c.max_output);
}

void ThermalPid::off(double printed_c) {
    previous_c_ = printed_c;
    in_range_ = false;
}

}  // namespace fauxboard::filament
