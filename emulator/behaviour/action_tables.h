#pragma once

#include <span>

#include "emulator/behaviour/actions.h"

// The tables of actions that every machine knows.
namespace fauxboard::behaviour::rows {

std::span<const ActionInfo> device_actions();
std::span<const ActionInfo> host_actions();
std::span<const ActionInfo> transfer_actions();
std::span<const ActionInfo> fault_actions();

}  // namespace fauxboard::behaviour::rows
