#pragma once

#include <istream>
#include <string>

#include "tools/commands.h"

namespace fauxboard::tools {

/// Whether what begins here are records of `run --spi`. Takes nothing.
bool is_spi(std::istream& in);
/// What each of them means, a line each. `name` is that of the input.
ExitCode decode_spi(std::istream& in, const std::string& name, bool json);

}  // namespace fauxboard::tools
