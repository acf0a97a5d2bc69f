#pragma once

#include "emulator/behaviour/document.h"

namespace fauxboard::behaviour {

/// Every field, as the reference has it: path, type, unit, bounds, what it means.
Json describe_fields();

/// Every action, as the reference has it: name, phrase, what it does, arguments.
Json describe_actions();

}  // namespace fauxboard::behaviour
