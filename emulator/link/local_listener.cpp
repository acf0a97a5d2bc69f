#include "emulator/link/local_listener.h"

#include <fmt/format.h>

#include <utility>

#include "emulator/link/link.h"

namespace fauxboard::link {

LocalListener::LocalListener(EventLoop& loop, std::function<void(UniqueFd)> on_client,
                             std::function<void(std::string_view)> on_trouble)
    : on_trouble_(std::move(on_trouble)), acceptor_(loop, std::move(on_client), [this](std::string_view why) {
          on_trouble_(fmt::format("{} could not take a client ({}); trying again", name_, why));
      }) {}

void LocalListener::open(const std::string& path) {
    close();
    UniqueFd fd = path_.listen(path);
    name_ = path;
    acceptor_.start(std::move(fd));
}

void LocalListener::close() noexcept {
    path_.remove();  // while the socket is open, which see
    acceptor_.stop();
}

}  // namespace fauxboard::link
