#pragma once

#include "emulator/dlp/board_config.h"
#include "emulator/machine/machine_config.h"

namespace fauxboard::dlp {

/// What a profile can say about a machine with this board.
struct Config : machine::MachineConfig {
    BoardConfig board;
};

}  // namespace fauxboard::dlp
