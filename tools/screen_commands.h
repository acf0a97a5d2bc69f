#pragma once

#include "tools/commands.h"
#include "tools/screen_options.h"

namespace fauxboard::tools {

/// The subcommands of `fauxboard screen`. Each returns its exit code and throws what ScreenSession throws.
ExitCode press(const ScreenOptions& options);
ExitCode tour(const ScreenOptions& options);
ExitCode show(const ScreenOptions& options);
ExitCode interactive(const ScreenOptions& options);

/// The same with the screen that is part of a board, at the board's control channel.
ExitCode press_own(const ScreenOptions& options);
ExitCode tour_own(const ScreenOptions& options);
ExitCode show_own(const ScreenOptions& options);
/// Writes a picture; `code` when that went well.
ExitCode keep_picture(const std::string& file, const std::string& png, ExitCode code);
ExitCode interactive_own(const ScreenOptions& options);

}  // namespace fauxboard::tools
