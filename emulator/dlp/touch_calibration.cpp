#include "emulator/dlp/touch_calibration.h"

#include <cmath>

namespace fauxboard::dlp {
namespace {

constexpr double glass_width = 480;
constexpr double glass_height = 320;
/// Twice the area of the triangle that was tapped, px2; that of the targets has 49 152.
constexpr double least_area = 1000;

GlassPoint on_glass(const GlassPoint& drawn, bool rotated) {
    return rotated ? GlassPoint{glass_width - 1 - drawn.x, glass_height - 1 - drawn.y} : drawn;
}

}  // namespace

std::optional<TouchCalibration> calibrate(const std::array<GlassPoint, 3>& read, bool rotated) {
    const auto& [a, b, c] = read;
    const double area = (a.x - c.x) * (b.y - c.y) - (b.x - c.x) * (a.y - c.y);
    if (!(std::abs(area) >= least_area)) {
        return std::nullopt;
    }
    TouchCalibration out{};
    for (const bool of_y : {false, true}) {
        const auto target = [&](std::size_t n) {
            const GlassPoint at = on_glass(calibration_targets[n], rotated);
            return of_y ? at.y : at.x;
        };
        const double along_x =
            ((target(0) - target(2)) * (b.y - c.y) - (target(1) - target(2)) * (a.y - c.y)) / area;
        const double along_y =
            ((target(1) - target(2)) * (a.x - c.x) - (target(0) - target(2)) * (b.x - c.x)) / area;
        const std::size_t first = of_y ? 3 : 0;
        out[first] = static_cast<float>(along_x);
        out[first + 1] = static_cast<float>(along_y);
        out[first + 2] = static_cast<float>(target(2) - along_x * c.x - along_y * c.y);
    }
    return out;
}

}  // namespace fauxboard::dlp
