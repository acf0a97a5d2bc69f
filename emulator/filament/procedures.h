#pragma once

#include <string_view>

#include "emulator/filament/motion.h"
#include "emulator/filament/names.h"
#include "emulator/filament/state.h"
#include "emulator/machine/main_loop.h"

namespace fauxboard::filament {

/// The motion procedures of the profile, by name, homing among them.
class Procedures {
  public:
    Procedures(const MotionConfig& config, const Leveling& leveling, Motion& motion, EventQueue& events,
               machine::MainLoop& loop)
        : config_(config), leveling_(leveling), motion_(motion), events_(events), loop_(loop) {}

    /// False when there is none of that name or the motion queue is full.
    bool run(std::string_view procedure, SimTime now);
    /// Homes the axes of the mask (bit 0 X, 1 Y, 2 Z; 0 means all). False when the motion queue is full.
    bool home(unsigned mask, SimTime now);
    /// Carries out what ends at or before `now`.
    void advance(SimTime now);

  private:
    /// What a step takes from the main loop is the main loop's to know.
    void tell_loop() { loop_.lose_rounds(motion_.take_lost_rounds()); }

    const MotionConfig& config_;
    const Leveling& leveling_;
    Motion& motion_;
    EventQueue& events_;
    machine::MainLoop& loop_;
};

}  // namespace fauxboard::filament
