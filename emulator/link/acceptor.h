#pragma once

// Internal to emulator/link.

#include <functional>
#include <string_view>

#include "emulator/link/event_loop.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

/// Takes the clients of a listening socket, as many as come. Its functions are called from the event loop
/// only, and may stop this.
class Acceptor {
  public:
    /// `on_client` gets a connection that does not block; `on_trouble` the system's text ("Too many open
    /// files") each time that none could be taken, which is tried again every 500 ms.
    Acceptor(EventLoop& loop, std::function<void(UniqueFd)> on_client,
             std::function<void(std::string_view)> on_trouble);

    /// `listening` does not block. Throws LinkError when the event loop refuses it.
    void start(UniqueFd listening);
    /// Idempotent.
    void stop() noexcept;

  private:
    void accept();

    std::function<void(UniqueFd)> on_client_;
    std::function<void(std::string_view)> on_trouble_;
    UniqueFd fd_;
    Watch watch_;
    Timer pause_;
};

}  // namespace fauxboard::link
