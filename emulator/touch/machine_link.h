#pragma once

// The screen's hands on the machine: its values as the screen knows them, and what the screen does to it.

#include <vector>

#include "emulator/behaviour/actions.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::touch {

/// Brings the values that are the machine's up to date.
void read_machine(const screen::ValueTable& table, const machine::Machine& machine,
                  std::vector<screen::Shown>& values);

/// The same of one value.
void read_machine(const screen::ValueInfo& info, const machine::Machine& machine, screen::Shown& value);

/// Carries out one deed, its arguments as `scope` has them.
void carry_out(const screen::Deed& deed, const screen::Scope& scope, behaviour::ActionContext& context);

}  // namespace fauxboard::touch
