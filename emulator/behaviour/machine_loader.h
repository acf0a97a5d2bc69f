#pragma once

#include <string>

#include "emulator/behaviour/reader.h"
#include "emulator/machine/machine_config.h"

namespace fauxboard::behaviour {

/// Reads the profile's `machine` section over the defaults in `machine`; problems go to `findings`.
void load_machine(const Json& node, const std::string& pointer, Findings& findings,
                  machine::MachineConfig& machine);

/// Reads the profile's `identity` section.
void load_identity(const Json& node, const std::string& pointer, Findings& findings,
                   machine::Identity& identity);

}  // namespace fauxboard::behaviour
