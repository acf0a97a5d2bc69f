#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "emulator/filament/thermal_crosstalk.h"

namespace fauxboard::filament {

/// One place of the bed touched again and again (M48): what the touches found, and how far they lie apart,
/// mm.
class ProbeSeries {
  public:
    explicit ProbeSeries(std::uint64_t seed) : seed_(seed) {}

    void begin(int wanted) { *this = ProbeSeries(seed_, wanted, touches_); }
    /// A touch, which finds the height but for noise of this standard deviation.
    void add(double height, double spread) {
        last_ = height + spread * measurement_noise(seed_, noise_channel, touches_++);
        ++count_;
        min_ = count_ == 1 ? last_ : std::min(min_, last_);
        max_ = count_ == 1 ? last_ : std::max(max_, last_);
        const double off = last_ - mean_;
        mean_ += off / count_;
        squares_ += off * (last_ - mean_);
    }
    int wanted() const { return wanted_; }
    int count() const { return count_; }
    double last() const { return last_; }
    double mean() const { return mean_; }
    double min() const { return min_; }
    double max() const { return max_; }
    /// Of the touches themselves, as Marlin has it.
    double deviation() const { return count_ == 0 ? 0 : std::sqrt(squares_ / count_); }

  private:
    ProbeSeries(std::uint64_t seed, int wanted, std::uint64_t touches)
        : seed_(seed), touches_(touches), wanted_(wanted) {}
    static constexpr unsigned noise_channel = 3;  // heaters have those below

    std::uint64_t seed_;
    std::uint64_t touches_ = 0;  ///< of all series
    int wanted_ = 0;
    int count_ = 0;
    double last_ = 0, mean_ = 0, min_ = 0, max_ = 0, squares_ = 0;
};

}  // namespace fauxboard::filament
