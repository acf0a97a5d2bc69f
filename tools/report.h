#pragma once

#include <string_view>

#include "tools/commands.h"

namespace fauxboard::tools {

/// Says on stderr what went wrong in a subcommand (empty: in none of them), and hands the exit code back:
/// `return complain("run", ExitCode::no_port, error.what());`
ExitCode complain(std::string_view command, ExitCode code, std::string_view sentence);

/// Writes a whole text to stderr as it is.
void print_error(std::string_view text);

/// Writes a whole text to stdout, waiting where it must; a closed stdout is none of our business.
void print(std::string_view text);

}  // namespace fauxboard::tools
