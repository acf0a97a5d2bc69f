#include "emulator/filament/arc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fauxboard::filament {

bool ArcSegments::begin(const Request& request) {
    clear();
    request_ = request;
    double i = request.i;
    double j = request.j;
    const double dx = request.to[0] - request.from[0];
    const double dy = request.to[1] - request.from[1];
    if (request.radius != 0) {
        const double chord = std::hypot(dx, dy);
        if (!(chord > 0)) {
            return false;
        }
        // The centre lies beside the middle of the chord, on the side that the direction and R's sign say; of
        // a radius that is too short, in the middle.
        const double beside =
            std::sqrt(std::max(request.radius * request.radius - chord * chord / 4, 0.0)) / chord;
        const double side = request.clockwise != (request.radius < 0) ? 1 : -1;
        i = dx / 2 + side * beside * dy;
        j = dy / 2 - side * beside * dx;
    }
    radius_ = std::hypot(i, j);
    if (!(radius_ > 0 && radius_ <= widest_mm)) {
        return false;
    }
    centre_x_ = request.from[0] + i;
    centre_y_ = request.from[1] + j;
    start_angle_ = std::atan2(-j, -i);
    const double end_angle = std::atan2(request.to[1] - centre_y_, request.to[0] - centre_x_);
    constexpr double turn = 2 * std::numbers::pi;
    // The shorter way first, which is none at all when the arc ends where it began: a full circle then.
    sweep_ = std::remainder(end_angle - start_angle_, turn);
    if (request.clockwise) {
        sweep_ -= sweep_ >= -1e-9 ? turn : 0;
    } else {
        sweep_ += sweep_ <= 1e-9 ? turn : 0;
    }
    const double way = std::hypot(std::abs(sweep_) * radius_, request.to[2] - request.from[2]);
    count_ = static_cast<std::uint32_t>(std::clamp(std::floor(way / segment_mm), 1.0, most_segments));
    return true;
}

AxisValues ArcSegments::take() {
    const std::uint32_t index = next_++;
    if (index >= count_) {
        return request_.to;
    }
    const double part = static_cast<double>(index) / count_;
    const double angle = start_angle_ + sweep_ * part;
    AxisValues at;
    at[0] = centre_x_ + radius_ * std::cos(angle);
    at[1] = centre_y_ + radius_ * std::sin(angle);
    for (std::size_t axis = 2; axis < axis_count; ++axis) {
        at[axis] = request_.from[axis] + (request_.to[axis] - request_.from[axis]) * part;
    }
    return at;
}

}  // namespace fauxboard::filament
