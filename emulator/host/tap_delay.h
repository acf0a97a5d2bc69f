#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/machine/sim_time.h"

namespace fauxboard::host {

/// How long it took to pass bytes on: smallest, middle and largest time, in fixed memory however many there
/// were.
class TapDelay {
  public:
    void add(machine::SimTime delay);

    std::uint64_t count() const { return count_; }
    /// All are 0 where nothing was added.
    machine::SimTime min() const { return min_; }
    machine::SimTime max() const { return max_; }
    /// Exact below 64 us, at most 1/32 too small above.
    machine::SimTime median() const;

  private:
    // 64 buckets of 1 us, then 32 to each doubling; the last takes all beyond some 50 days.
    static constexpr std::size_t buckets = 64 + 32 * 37;

    static std::size_t bucket(std::uint64_t us);
    static std::uint64_t lower_end(std::size_t bucket);

    std::array<std::uint64_t, buckets> counts_{};
    std::uint64_t count_ = 0;
    machine::SimTime min_{0};
    machine::SimTime max_{0};
};

}  // namespace fauxboard::host
