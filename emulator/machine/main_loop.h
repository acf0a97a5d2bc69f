#pragma once

#include <utility>

#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

/// What the board's main loop, and with it its schedule, loses by work that keeps it from going round.
class MainLoop {
  public:
    /// It stands still for a while (a write to the EEPROM, say).
    void stall(SimTime time) { stall_ += time; }
    /// It leaves out whole rounds of its schedule.
    void lose_rounds(int rounds) { rounds_ += rounds; }
    /// What was lost since the last call.
    SimTime take_stall() { return std::exchange(stall_, SimTime{0}); }
    int take_lost_rounds() { return std::exchange(rounds_, 0); }

  private:
    SimTime stall_{0};
    int rounds_ = 0;
};

}  // namespace fauxboard::machine
