#pragma once

#include <string>

#include "emulator/behaviour/reader.h"
#include "emulator/machine/machine_config.h"

namespace fauxboard::behaviour {

/// The keys of a profile's `machine` that every kind has.
void load_common(ObjectReader& reader, Findings& findings, machine::MachineConfig& machine);
void load_card(const Json& node, const std::string& pointer, Findings& findings, machine::CardConfig& out);
void load_identity(const Json& node, const std::string& pointer, Findings& findings,
                   machine::Identity& identity);

}  // namespace fauxboard::behaviour
