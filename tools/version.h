#pragma once

#include <string>

namespace fauxboard::tools {

/// What `--version` says: the version, the commit it was built from, and where profiles come from.
std::string version_text();

}  // namespace fauxboard::tools
