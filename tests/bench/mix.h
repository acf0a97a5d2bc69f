#pragma once

#include <string>
#include <vector>

namespace fauxboard::bench {

/// The requests a real A30T screen sent in one session of six minutes, in the proportions in which it sent
/// them, each a whole line of the wire. Ordered so that each does its work: the nozzle is hot when filament
/// is loaded, and the axes are homed when the babystep is set, if they were before.
std::vector<std::string> recorded_mix();

}  // namespace fauxboard::bench
