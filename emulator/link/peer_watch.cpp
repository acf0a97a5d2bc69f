#include "emulator/link/peer_watch.h"

#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstring>

namespace fauxboard::link {

bool PeerWatch::start(const std::string& path) {
    count_ = 0;
    fd_.reset(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
    if (fd_ && ::inotify_add_watch(fd_.get(), path.c_str(), IN_OPEN | IN_CLOSE) < 0) fd_.reset();
    return static_cast<bool>(fd_);
}

PeerWatch::Seen PeerWatch::take() {
    std::array<char, 4096> buffer;
    const ssize_t size = ::read(fd_.get(), buffer.data(), buffer.size());
    Seen seen;
    seen.anything = size > 0;
    inotify_event event{};
    for (std::size_t at = 0; size > 0 && at + sizeof event <= static_cast<std::size_t>(size);
         at += sizeof event + event.len) {
        std::memcpy(&event, buffer.data() + at, sizeof event);
        if ((event.mask & (IN_OPEN | IN_Q_OVERFLOW)) != 0) {
            seen.opened = true;
            if (count_ == 0) seen.reopened = true;
            ++count_;
        }
        if ((event.mask & IN_CLOSE) != 0 && count_ > 0) --count_;
    }
    return seen;
}

}  // namespace fauxboard::link
