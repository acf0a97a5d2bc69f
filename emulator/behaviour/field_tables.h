#pragma once

#include <span>
#include <vector>

#include "emulator/behaviour/fields.h"

// The tables of fields that every machine has.
namespace fauxboard::behaviour::rows {

std::span<const Field> device_fields();
std::span<const Field> host_fields();
std::span<const Field> transfer_fields();
std::span<const Field> fault_fields();

}  // namespace fauxboard::behaviour::rows
