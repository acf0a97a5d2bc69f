#pragma once

// The manual and the shells' completions, made from what the commands declare of themselves: a new option is
// in both.

#include <CLI/App.hpp>
#include <string>

namespace fauxboard::tools {

enum class Shell { bash, zsh, fish };

/// The manual page of `command` (section 1) in roff: its synopsis, options and subcommands. `app` is the
/// program it belongs to; for the program itself, both are the same.
std::string man_page(const CLI::App& app, const CLI::App& command);

/// What the shell reads to complete commands, options, and the names of profiles, screens and scenarios.
std::string completion(const CLI::App& app, Shell shell);

}  // namespace fauxboard::tools
