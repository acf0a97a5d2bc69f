#pragma once

#include <algorithm>
#include <cmath>

namespace fauxboard::dlp {

/// A way of so many mm, from rest to rest: accelerates, goes on, brakes. Closed in time.
class Ramp {
  public:
    Ramp() = default;
    Ramp(double mm, double mm_s, double mm_s2)
        : way_(std::max(mm, 0.0)),
          acceleration_(std::max(mm_s2, least_mm_s2)),
          speed_(std::min(std::max(mm_s, least_mm_s), std::sqrt(way_ * acceleration_))),
          total_s_(way_ <= 0 ? 0 : way_ / speed_ + speed_ / acceleration_) {}

    double way() const { return way_; }
    double total_s() const { return total_s_; }
    double top_speed() const { return speed_; }

    /// How far it has come after `s` seconds.
    double at(double s) const {
        if (s <= 0 || way_ <= 0) {
            return 0;
        }
        const double left = total_s_ - s;
        if (left <= 0) {
            return way_;
        }
        const double ramp_s = speed_ / acceleration_;
        if (s < ramp_s) {
            return acceleration_ * s * s / 2;
        }
        return left < ramp_s ? way_ - acceleration_ * left * left / 2 : speed_ * (s - ramp_s / 2);
    }

    /// After how many seconds it has come so far; the end when that is beyond the way.
    double when(double mm) const {
        if (mm <= 0) {
            return 0;
        }
        if (mm >= way_) {
            return total_s_;
        }
        const double ramp_s = speed_ / acceleration_;
        const double ramp_mm = speed_ * ramp_s / 2;
        if (mm < ramp_mm) {
            return std::sqrt(2 * mm / acceleration_);
        }
        const double left = way_ - mm;
        return left < ramp_mm ? total_s_ - std::sqrt(2 * left / acceleration_) : mm / speed_ + ramp_s / 2;
    }

  private:
    // Slower is not to be had: files and settings may say 0.
    static constexpr double least_mm_s = 0.01;
    static constexpr double least_mm_s2 = 0.1;

    double way_ = 0;
    double acceleration_ = least_mm_s2;
    double speed_ = 0;
    double total_s_ = 0;
};

}  // namespace fauxboard::dlp
