#pragma once

// `run --script`: what is settled before anything is opened, and what is said at the end.

#include <memory>

#include "emulator/board/board.h"
#include "emulator/script/player.h"
#include "tools/commands.h"
#include "tools/run_options.h"

namespace fauxboard::host {
class TextOutput;
}

namespace fauxboard::tools {

/// Loads and checks the scenario; sets profile and screen of the options to those that it is played with.
/// Throws behaviour::ProfileError. Null when the options name none.
std::shared_ptr<const script::Scenario> plan_script(RunOptions& options);

/// Tells what came of it: a sentence on `err`, the report and JUnit's file, with --json a line on `out`.
ExitCode tell_outcome(const RunOptions& options, const script::Player& player, const board::Board& board,
                      const script::Json& faults, host::TextOutput& out, host::TextOutput& err);

}  // namespace fauxboard::tools
