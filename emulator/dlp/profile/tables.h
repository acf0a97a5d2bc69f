#pragma once

#include <span>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/lists.h"
#include "emulator/behaviour/reader.h"
#include "emulator/dlp/config.h"

// The tables that this kind brings to profiles, and its part of them.
namespace fauxboard::dlp {

std::span<const behaviour::Field> fields();
std::span<const behaviour::ActionInfo> actions();
std::span<const behaviour::List> lists();
std::span<const behaviour::Picture> pictures();

/// Reads the kind's own keys of a profile's `machine`.
void load_config(behaviour::ObjectReader& reader, behaviour::Findings& findings, Config& config);

}  // namespace fauxboard::dlp
