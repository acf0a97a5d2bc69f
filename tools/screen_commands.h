#pragma once

#include "tools/commands.h"
#include "tools/screen_options.h"

namespace fauxboard::tools {

/// The subcommands of `fauxboard screen`. Each returns its exit code and throws what ScreenSession throws.
ExitCode press(const ScreenOptions& options);
ExitCode tour(const ScreenOptions& options);
ExitCode show(const ScreenOptions& options);
ExitCode interactive(const ScreenOptions& options);

}  // namespace fauxboard::tools
