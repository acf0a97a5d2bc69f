#include "emulator/link/acceptor.h"

#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <utility>

#include "emulator/link/error_text.h"

namespace fauxboard::link {
namespace {

// Out of descriptors, mostly; trying again at once would spin.
constexpr std::chrono::milliseconds accept_pause{500};

/// The client was gone before we came.
bool is_past(int error) {
    return error == ECONNABORTED || error == EINTR || error == EPROTO;
}

}  // namespace

Acceptor::Acceptor(EventLoop& loop, std::function<void(UniqueFd)> on_client,
                   std::function<void(std::string_view)> on_trouble)
    : on_client_(std::move(on_client)),
      on_trouble_(std::move(on_trouble)),
      watch_(loop, [this] { accept(); }),
      pause_(loop, [this] { watch_.hold(false); }) {}

void Acceptor::start(UniqueFd listening) {
    stop();
    watch_.start(listening.get());
    fd_ = std::move(listening);
}

void Acceptor::stop() noexcept {
    pause_.cancel();
    watch_.stop();
    fd_.reset();
}

void Acceptor::accept() {
    UniqueFd client(::accept4(fd_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (client) return on_client_(std::move(client));
    if (errno == EAGAIN || errno == EWOULDBLOCK) return watch_.drained();
    if (is_past(errno)) return;
    const int error = errno;
    watch_.hold(true);
    pause_.after(accept_pause);
    on_trouble_(error_text(error));
}

}  // namespace fauxboard::link
