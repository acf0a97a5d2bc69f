#pragma once

#include <span>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/reader.h"
#include "emulator/filament/config.h"

// The tables that this kind brings to profiles, and its part of them.
namespace fauxboard::filament {

std::span<const behaviour::Field> machine_fields();
std::span<const behaviour::Field> settings_fields();
std::span<const behaviour::Field> device_fields();
std::span<const behaviour::Field> fault_fields();
std::span<const behaviour::Field> host_fields();

std::span<const behaviour::ActionInfo> machine_actions();
std::span<const behaviour::ActionInfo> device_actions();

/// Reads the kind's own keys of a profile's `machine`.
void load_config(behaviour::ObjectReader& reader, behaviour::Findings& findings, Config& config);

}  // namespace fauxboard::filament
