#include "emulator/filament/autotune.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fauxboard::filament {

Autotune autotune(const PlantConfig& plant, double target_c, bool gentle) {
    constexpr int most = 127;
    constexpr int margin = 20;  // that Marlin keeps from both ends
    const double heating = std::max(plant.heating_k_per_s, 1e-3);
    const double kept_warm = plant.loss_on_per_s * std::max(target_c - plant.ambient_c, 0.0) / heating;
    Autotune out;
    out.bias =
        std::clamp(static_cast<int>(std::lround(std::min(kept_warm, 1.0) * most)), margin, most - margin);
    out.d = out.bias > most / 2 ? most - 1 - out.bias : out.bias;
    const double late_s = std::max(plant.dead_time_s + plant.sensor_lag_s, 0.01);
    const double swing = heating * out.d / most * late_s;
    out.min_c = target_c - swing;
    out.max_c = target_c + swing;
    out.ku = 4.0 * out.d / (std::numbers::pi * swing);
    out.tu_s = 4 * late_s;
    out.kp = out.ku * (gentle ? 0.2 : 0.6);
    out.ki = 2 * out.kp / out.tu_s;
    out.kd = out.kp * out.tu_s / (gentle ? 3 : 8);
    return out;
}

}  // namespace fauxboard::filament
