#pragma once

// How rows of the table of ops are written. Private to control/ops*.cpp.

#include <span>

#include "emulator/control/ops.h"

namespace fauxboard::control::rows {

using Answer = std::optional<Json>;

std::span<const Op> value_ops();
std::span<const Op> machine_ops();
std::span<const Op> fault_ops();
std::span<const Op> view_ops();
std::span<const Op> session_ops();
std::span<const Op> display_ops();

}  // namespace fauxboard::control::rows
