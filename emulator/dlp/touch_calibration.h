#pragma once

#include <array>
#include <optional>

namespace fauxboard::dlp {

/// A place on the glass of the board's own screen, in its pixels.
struct GlassPoint {
    double x = 0;
    double y = 0;
};

/// What a sensor's reading stands for: x' = c0 x + c1 y + c2, y' = c3 x + c4 y + c5.
using TouchCalibration = std::array<float, 6>;
constexpr TouchCalibration no_calibration{1, 0, 0, 0, 1, 0};

/// Where the targets of the calibration are drawn, in the order in which they are tapped (0.08).
constexpr std::array<GlassPoint, 3> calibration_targets{{{432, 160}, {240, 288}, {48, 32}}};

/// What makes the targets out of what the sensor read at them; nothing when the readings lie in one line, or
/// nearly. `rotated`: the picture is turned by 180 degrees.
std::optional<TouchCalibration> calibrate(const std::array<GlassPoint, 3>& read, bool rotated);

}  // namespace fauxboard::dlp
