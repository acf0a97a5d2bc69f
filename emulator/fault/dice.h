#pragma once

#include <cstdint>

namespace fauxboard::fault {

/// Random numbers of one line under one fault. They depend on the fault's seed, the direction and the number
/// of the line only: not on what happened to other lines, nor on times, nor on the library of the day.
class Dice {
  public:
    Dice(std::uint64_t seed, std::uint64_t stream, std::uint64_t line)
        : state_(mix(mix(mix(seed) + stream) + line)) {}

    std::uint64_t next() { return mix(state_++); }

    /// 0 .. n-1; 0 for n = 0. The tiny unevenness of the remainder does not matter here.
    std::uint64_t below(std::uint64_t n) { return n == 0 ? 0 : next() % n; }

    /// 0 <= x < 1.
    double fraction() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  private:
    /// splitmix64.
    static constexpr std::uint64_t mix(std::uint64_t x) {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    std::uint64_t state_;
};

}  // namespace fauxboard::fault
