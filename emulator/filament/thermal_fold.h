#pragma once

#include <cmath>

namespace fauxboard::filament {

// The Smartto firmware of the A30T prints temperatures with the fraction inside each degree mirrored: 27.3 is
// printed as 28.7, 28.0 as 28.0 (all four channels, all 1055 frames of the recording). So a rising
// temperature looks like 22.0 23.8 23.4 23.0 24.5. Likely a wrong sign where it interpolates in a table with
// one entry per degree.

/// The nearest temperature that a reading of `counts_per_c` (>= 1) ADC counts per degree can show.
inline double quantise(double true_c, int counts_per_c) {
    const double counts = static_cast<double>(counts_per_c);
    return std::floor(true_c * counts + 0.5) / counts;
}

/// What the board prints for the (quantised) temperature: 2 * ceil(T) - T. Between T and T + 2.
inline double fold_temperature(double true_c) {
    return 2.0 * std::ceil(true_c) - true_c;
}

/// The temperature behind a printed one. Exact for what fold_temperature() returned. A value that went
/// through one decimal on the line is ambiguous where it ends in .0 on a channel with more than 10 counts per
/// degree (the printed 23.0 may be 23.0 or just above 21.0); taken as 23.0.
inline double unfold_temperature(double printed_c) {
    const double degree = std::floor(printed_c);
    return degree == printed_c ? printed_c : 2.0 * degree - printed_c;
}

}  // namespace fauxboard::filament
