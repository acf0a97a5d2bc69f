#pragma once

// Internal to emulator/link.

#include <memory>
#include <string>

#include "emulator/link/link.h"

namespace fauxboard::link {

/// Somebody else's pseudo-terminal, by its slave's path or a symlink to it. A pseudo-terminal has no speed:
/// `baud` only shows in its settings.
std::unique_ptr<Link> make_foreign_pty_link(EventLoop& loop, std::string device, unsigned baud);

/// Whether `device` is, or points to, the slave of a pseudo-terminal (which need not exist any more).
bool is_pty_path(const std::string& device);

}  // namespace fauxboard::link
