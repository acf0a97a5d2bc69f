#pragma once

#include <span>

#include "emulator/machine/kind.h"

namespace fauxboard::filament {

/// This kind's row of the table of kinds.
extern const machine::Kind own_kind;

/// What can go wrong with it, beside what can go wrong with every machine.
std::span<const machine::FaultInfo> own_faults();

}  // namespace fauxboard::filament
