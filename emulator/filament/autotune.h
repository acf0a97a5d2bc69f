#pragma once

#include "emulator/filament/thermal_config.h"

namespace fauxboard::filament {

/// What Marlin's autotune (M303) finds out about a heater, with its power counted from 0 to 127.
struct Autotune {
    int bias = 0, d = 0;          ///< the power it switches around, and how far
    double min_c = 0, max_c = 0;  ///< between which the temperature swings then
    double ku = 0, tu_s = 0;      ///< ultimate gain and period
    double kp = 0, ki = 0, kd = 0;
};

/// Of a heater that is held around `target_c` by switching: it rises and falls evenly, and turns as much
/// later as heat takes to reach the sensor. `gentle`: the rule without overshoot, which a bed gets, instead
/// of the classic one.
Autotune autotune(const PlantConfig& plant, double target_c, bool gentle);

}  // namespace fauxboard::filament
