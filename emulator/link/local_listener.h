#pragma once

// Internal to the program's own channels; the tested line is a Link.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "emulator/link/event_loop.h"
#include "emulator/link/local_path.h"
// After event_loop.h, which see.
#include <asio/local/stream_protocol.hpp>

namespace fauxboard::link {

/// Takes the clients of a Unix socket, as many as come.
class LocalListener {
  public:
    using Socket = asio::local::stream_protocol::socket;

    /// Told from the event loop only. `on_trouble` gets a sentence without a full stop.
    LocalListener(asio::io_context& context, std::function<void(Socket)> on_client,
                  std::function<void(std::string_view)> on_trouble);
    ~LocalListener() { close(); }
    LocalListener(const LocalListener&) = delete;
    LocalListener& operator=(const LocalListener&) = delete;

    /// Throws LinkError, see LocalPath::listen.
    void open(const std::string& path);
    /// Idempotent; removes the name.
    void close() noexcept;

  private:
    void accept();
    void accept_later(const std::string& why);

    std::string name_;
    LocalPath path_;
    asio::local::stream_protocol::acceptor acceptor_;
    asio::steady_timer pause_;
    std::function<void(Socket)> on_client_;
    std::function<void(std::string_view)> on_trouble_;
    /// Callbacks of a listener that is closed find this changed or gone.
    std::shared_ptr<int> life_;
};

}  // namespace fauxboard::link
