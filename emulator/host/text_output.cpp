#include "emulator/host/text_output.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>

namespace fauxboard::host {

bool TextOutput::ready() const {
    pollfd entry{.fd = fd_, .events = POLLOUT, .revents = 0};
    const int patience = when_full_ == WhenFull::wait ? -1 : 0;
    return ::poll(&entry, 1, patience) > 0 && (entry.revents & POLLOUT) != 0;
}

bool TextOutput::write_all(std::string_view text) {
    while (!text.empty()) {
        // A pipe that says "writable" takes PIPE_BUF bytes without blocking, and no more for certain.
        const std::size_t size = text.size() < PIPE_BUF ? text.size() : PIPE_BUF;
        if (!ready()) {
            return false;
        }
        const ssize_t count = ::write(fd_, text.data(), size);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return false;
        }
        torn_ = true;
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    torn_ = false;
    return true;
}

bool TextOutput::write(std::string_view text) {
    if ((torn_ && !write_all("\n")) || !write_all(text)) {
        ++left_out_;
        return false;
    }
    return true;
}

bool TextOutput::colours() const {
    const char* terminal = std::getenv("TERM");
    return ::isatty(fd_) != 0 && std::getenv("NO_COLOR") == nullptr && terminal != nullptr &&
           std::string_view(terminal) != "dumb";
}

}  // namespace fauxboard::host
