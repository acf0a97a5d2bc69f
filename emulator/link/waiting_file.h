#pragma once

#include <string>

namespace fauxboard::link {

/// Whether a file that calls itself a plain one has nothing to be read now, and no end either: some of the
/// system's own, such as /proc/kmsg, keep their reader waiting. Reads nothing of it.
bool must_be_waited_for(const std::string& file);

}  // namespace fauxboard::link
