#pragma once

// Internal to the program's own channels; the tested line is a Link.

#include <functional>
#include <string>
#include <string_view>

#include "emulator/link/acceptor.h"
#include "emulator/link/local_path.h"

namespace fauxboard::link {

/// Takes the clients of a Unix socket, as many as come.
class LocalListener {
  public:
    /// Told from the event loop only. `on_client` gets a socket that does not block, `on_trouble` a sentence
    /// without a full stop.
    LocalListener(EventLoop& loop, std::function<void(UniqueFd)> on_client,
                  std::function<void(std::string_view)> on_trouble);
    ~LocalListener() { close(); }
    LocalListener(const LocalListener&) = delete;
    LocalListener& operator=(const LocalListener&) = delete;

    /// Throws LinkError, see LocalPath::listen.
    void open(const std::string& path);
    /// Idempotent; removes the name.
    void close() noexcept;

  private:
    std::string name_;
    LocalPath path_;
    std::function<void(std::string_view)> on_trouble_;
    Acceptor acceptor_;
};

}  // namespace fauxboard::link
