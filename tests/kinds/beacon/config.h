#pragma once

#include "emulator/machine/machine_config.h"

namespace fauxboard::beacon {

/// A beacon that blinks: a kind of machine that is made up, to see what a kind takes.
struct Config : machine::MachineConfig {
    double period_s = 1;  ///< from one blink to the next
};

}  // namespace fauxboard::beacon
