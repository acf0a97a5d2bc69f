#pragma once

#include "emulator/machine/kind.h"

namespace fauxboard::dlp {

/// This kind's row of the table of kinds.
extern const machine::Kind own_kind;

/// What can go wrong with this board and its machine.
std::span<const machine::FaultInfo> own_faults();

}  // namespace fauxboard::dlp
