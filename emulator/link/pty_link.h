#pragma once

// Internal to emulator/link and its tests.

#include <memory>
#include <string>

#include "emulator/link/link.h"

namespace fauxboard::link {

/// As make_pty_link(loop, link_name, use). Without `watch_peers` it works as on a system that has no inotify
/// watch left: always up, since there is no telling whether anybody is there.
std::unique_ptr<Link> make_pty_link(EventLoop& loop, std::string link_name, bool watch_peers,
                                    PtyUse use = {});

}  // namespace fauxboard::link
