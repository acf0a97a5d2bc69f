#pragma once

#include <string_view>

#include "emulator/filament/state.h"
#include "tests/support/printers.h"

namespace fauxboard::testing {

/// How long the moves of a G-code text take, in seconds: an estimate of its own, against which the planner is
/// held. It reads the whole file, puts PrusaSlicer's junction rule (its GCodeProcessor, which is Marlin's) to
/// each pair of moves, passes over all of them backwards and then forwards, and adds up exact trapezoids. It
/// shares no code with the emulator and knows G0, G1, G90, G91, G92, M82 and M83 only: nothing of heating,
/// homing or waiting.
double reference_seconds(std::string_view gcode, const filament::Settings& settings);

}  // namespace fauxboard::testing
