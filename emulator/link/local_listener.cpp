#include "emulator/link/local_listener.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <utility>

#include "emulator/link/link.h"

namespace fauxboard::link {
namespace {

// Out of descriptors, mostly; trying again at once would spin.
constexpr std::chrono::milliseconds accept_pause{500};

}  // namespace

LocalListener::LocalListener(asio::io_context& context, std::function<void(Socket)> on_client,
                             std::function<void(std::string_view)> on_trouble)
    : acceptor_(context),
      pause_(context),
      on_client_(std::move(on_client)),
      on_trouble_(std::move(on_trouble)) {}

void LocalListener::open(const std::string& path) {
    close();
    UniqueFd fd = path_.listen(path);
    asio::error_code error;
    acceptor_.assign({}, fd.get(), error);
    if (error) {
        path_.remove();
        throw LinkError(fmt::format("The socket {} cannot be listened on: {}.", path, error.message()));
    }
    fd.release();
    name_ = path;
    life_ = std::make_shared<int>();
    accept();
}

void LocalListener::close() noexcept {
    life_.reset();
    path_.remove();
    asio::error_code ignored;
    acceptor_.close(ignored);
    pause_.cancel();
}

void LocalListener::accept() {
    acceptor_.async_accept([this, life = std::weak_ptr(life_)](const asio::error_code& error, Socket socket) {
        if (life.expired()) return;
        if (error) return accept_later(error.message());
        accept();
        on_client_(std::move(socket));
    });
}

void LocalListener::accept_later(const std::string& why) {
    on_trouble_(fmt::format("{} could not take a client ({}); trying again", name_, why));
    pause_.expires_after(accept_pause);
    pause_.async_wait([this, life = std::weak_ptr(life_)](const asio::error_code& error) {
        if (!error && !life.expired()) accept();
    });
}

}  // namespace fauxboard::link
