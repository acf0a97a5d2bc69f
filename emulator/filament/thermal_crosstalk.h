#pragma once

#include <cstdint>

#include "emulator/filament/thermal_config.h"

namespace fauxboard::filament {

/// What an input without sensor reads while its neighbour is at `source_c`: the table of `config`, 0 when it
/// is empty.
double cross_talk_c(const SensorlessInputConfig& config, double source_c);

/// Noise of about normal distribution with mean 0 and standard deviation 1, within +-3.5: a pure function of
/// its arguments, so that the value of a measurement does not depend on how it was reached.
double measurement_noise(std::uint64_t seed, unsigned channel, std::uint64_t index);

/// The same, going in straight lines from a value of its own to the next in `stretch` (>= 1) measurements.
double wandering_noise(std::uint64_t seed, unsigned channel, std::uint64_t index, std::uint64_t stretch);

}  // namespace fauxboard::filament
