#pragma once

#include <cstdint>

#include "emulator/fault/dice.h"
#include "emulator/fault/spec.h"

namespace fauxboard::fault {

/// Decides line by line whether a fault acts, and counts.
class Judge {
  public:
    /// `added` is when the fault comes into being; `direction` that of the line it works on.
    Judge(const FaultSpec& spec, Direction direction, SimTime added);

    /// The moment it begins to count lines.
    SimTime begin() const { return begin_; }
    /// Lines that pass at `time` concern it.
    bool in_force(SimTime time) const { return time >= begin_ && !over(time); }
    /// It will not act any more.
    bool over(SimTime time) const { return time >= end_ || acted_ >= limit_; }

    /// One line comes by while it is in force. True: act; that is counted already.
    bool line();
    /// It acted without a line.
    void act() { ++acted_; }
    /// The random numbers of the last line().
    Dice& dice() { return dice_; }

    std::uint64_t seen() const { return seen_; }
    std::uint64_t acted() const { return acted_; }

  private:
    double probability_;
    std::uint64_t every_;
    std::uint64_t after_;
    std::uint64_t limit_;
    SimTime begin_;
    SimTime end_;
    std::uint64_t seed_;
    std::uint64_t stream_;
    Dice dice_;
    std::uint64_t seen_ = 0;
    std::uint64_t acted_ = 0;
};

}  // namespace fauxboard::fault
