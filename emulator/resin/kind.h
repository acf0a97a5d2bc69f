#pragma once

#include "emulator/machine/kind.h"

namespace fauxboard::resin {

/// This kind's row of the table of kinds.
extern const machine::Kind own_kind;

}  // namespace fauxboard::resin
