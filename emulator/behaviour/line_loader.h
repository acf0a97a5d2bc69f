#pragma once

#include <string>

#include "emulator/behaviour/profile.h"
#include "emulator/behaviour/reader.h"

namespace fauxboard::behaviour {

/// A profile's `line`: how lines reach the board. `framed` holds what the protocol says of its frames and
/// comes back as the profile says.
void load_line(const Json& node, const std::string& pointer, Findings& findings, LineConfig& line,
               bool& framed);
/// A profile's `transmit`: when lines leave it, and in which pieces.
void load_transmit(const Json& node, const std::string& pointer, Findings& findings, Profile& profile);

}  // namespace fauxboard::behaviour
