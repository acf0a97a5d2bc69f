#include "emulator/host/text_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <utility>

#include "emulator/host/plain_text.h"

namespace fauxboard::host {
namespace {

bool is_full(int error) {
    return error == EAGAIN || error == EWOULDBLOCK;
}

/// While this lives, the description that others share does not block: where it cannot be opened again.
class NotBlocking {
  public:
    explicit NotBlocking(int fd) : fd_(fd), before_(::fcntl(fd, F_GETFL)) {
        if (before_ != -1) {
            (void)::fcntl(fd_, F_SETFL, before_ | O_NONBLOCK);
        }
    }
    ~NotBlocking() {
        if (before_ != -1) {
            const int error = errno;
            (void)::fcntl(fd_, F_SETFL, before_);
            errno = error;
        }
    }
    NotBlocking(const NotBlocking&) = delete;
    NotBlocking& operator=(const NotBlocking&) = delete;

  private:
    int fd_;
    int before_;
};

}  // namespace

// poll() is no help against blocking: a terminal that says "writable" takes some bytes, not as many as come.
// Neither is O_NONBLOCK on what we were given, since the shell and others share it.
TextOutput::TextOutput(int fd, WhenFull when_full) : fd_(fd), when_full_(when_full) {
    struct stat info {};
    if (when_full == WhenFull::wait || ::fstat(fd, &info) != 0) {
        return;
    }
    is_socket_ = S_ISSOCK(info.st_mode);
    is_stream_ = S_ISFIFO(info.st_mode) || ::isatty(fd) != 0;
    if (is_stream_) {
        own_.reset(::open(fmt::format("/proc/self/fd/{}", fd).c_str(),
                          O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    }
}

long TextOutput::write_some(std::string_view text) const {
    if (when_full_ == WhenFull::wait) {
        return ::write(fd_, text.data(), text.size());
    }
    if (is_socket_) {
        return ::send(fd_, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    }
    if (own_) {
        return ::write(own_.get(), text.data(), text.size());
    }
    if (is_stream_) {
        const NotBlocking not_blocking(fd_);
        return ::write(fd_, text.data(), text.size());
    }
    return ::write(fd_, text.data(), text.size());
}

bool TextOutput::wait_for_room() {
    pollfd entry{.fd = fd_, .events = POLLOUT, .revents = 0};
    const int count = ::poll(&entry, 1, -1);
    return count > 0 || (count < 0 && errno == EINTR);
}

/// How many bytes of it went.
std::size_t TextOutput::put(std::string_view text) {
    std::size_t done = 0;
    while (done < text.size()) {
        const long count = write_some(text.substr(done));
        if (count > 0) {
            done += static_cast<std::size_t>(count);
        } else if (count < 0 && errno == EINTR) {
            continue;
        } else if (count < 0 && is_full(errno)) {
            if (when_full_ != WhenFull::wait || !wait_for_room()) {
                return done;
            }
        } else {
            error_ = count < 0 ? errno : EIO;
            return done;
        }
    }
    return done;
}

bool TextOutput::flush() {
    rest_.erase(0, put(rest_));
    if (error_ != 0) {
        rest_.clear();  // whoever took its beginning is gone
    }
    return rest_.empty();
}

bool TextOutput::write_plain(std::string_view text) {
    const std::size_t done = flush() ? put(text) : 0;
    if (done == text.size()) {
        error_ = 0;
        return true;
    }
    if (done != 0 && error_ == 0) {
        rest_ = text.substr(done);
        return true;
    }
    ++left_out_;
    return false;
}

bool TextOutput::write(std::string_view text) {
    error_ = 0;
    return write_plain(plain_text(text));
}

bool TextOutput::write(const StyledLine& line) {
    error_ = 0;
    return write_plain(line.bytes());
}

void TextOutput::keep(std::string_view text) {
    error_ = 0;
    rest_ += plain_text(text);
    flush();
}

bool TextOutput::colours() const {
    const char* terminal = std::getenv("TERM");
    return ::isatty(fd_) != 0 && std::getenv("NO_COLOR") == nullptr && terminal != nullptr &&
           std::string_view(terminal) != "dumb";
}

std::size_t TextOutput::columns() const {
    winsize size{};
    return ::ioctl(fd_, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace fauxboard::host
