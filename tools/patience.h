#pragma once

// A moment for a board that is just starting: `fauxboard run --pty=screen &`, then somebody at its other end.

#include <poll.h>

#include <algorithm>
#include <string>

namespace fauxboard::tools {

/// Calls `done` until it gives true, at most for two seconds, or `at_most_ms` if that is less.
template <class Done>
void wait_a_moment(Done done, int at_most_ms = -1) {
    constexpr int most_ms = 2000;
    constexpr int pause_ms = 50;
    const int patience_ms = at_most_ms < 0 ? most_ms : std::min(at_most_ms, most_ms);
    for (int waited_ms = 0; waited_ms < patience_ms && !done(); waited_ms += pause_ms) {
        ::poll(nullptr, 0, pause_ms);
    }
}

/// Until there is something of this name: the link to a pseudo-terminal, a serial adapter.
void wait_for_port(const std::string& port);

}  // namespace fauxboard::tools
