#include "emulator/link/direct_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <utility>

#include "emulator/link/error_text.h"
#include "emulator/link/inet_socket.h"
#include "emulator/link/link.h"
#include "emulator/link/link_name.h"
#include "emulator/link/listening_socket.h"
#include "emulator/link/socket_io.h"
#include "emulator/link/stream_link.h"

namespace fauxboard::link {
namespace {

bool would_block(int error) {
    return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

/// Waits for these events; false when they do not come.
bool wait_for(int fd, short events, std::chrono::milliseconds limit) {
    pollfd entry{fd, events, 0};
    return ::poll(&entry, 1, static_cast<int>(limit.count())) > 0 && (entry.revents & events) != 0;
}

class DirectPty final : public DirectStream {
  public:
    explicit DirectPty(const std::string& link_name) {
        master_.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
        std::array<char, 128> path{};
        if (!master_ || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0 ||
            ::ptsname_r(master_.get(), path.data(), path.size()) != 0 || !make_raw()) {
            throw LinkError(fmt::format("No pseudo-terminal: {}.", error_text(errno)));
        }
        path_ = path.data();
        // Once opened and closed, a master tells by itself whether anybody is there.
        UniqueFd(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
        if (!link_name.empty()) link_.create(link_name, path_);
    }
    bool up() override {
        const bool here = !hung_up(master_.get());
        if (!here && std::exchange(was_up_, false)) {
            forget();
            make_raw();  // and what nobody has read is dropped
        }
        was_up_ = here;
        return here;
    }
    std::string kind() const override { return "pty"; }
    std::string path() const override { return path_; }

  private:
    bool make_raw() const {
        termios settings{};
        if (::tcgetattr(master_.get(), &settings) != 0) return false;
        ::cfmakeraw(&settings);
        return ::tcsetattr(master_.get(), TCSAFLUSH, &settings) == 0;
    }
    int fd() const override { return master_.get(); }
    void lost() override {}
    long write_some(const char* data, std::size_t size) override {
        return ::write(master_.get(), data, size);
    }
    long read_some(char* data, std::size_t size) override { return ::read(master_.get(), data, size); }

    UniqueFd master_;
    LinkName link_;
    std::string path_;
    bool was_up_ = false;
};

class DirectTcp final : public DirectStream {
  public:
    explicit DirectTcp(const std::string& host_port) : socket_(listen_tcp(host_port)) {}

    bool up() override {
        if (!client_) {
            client_.reset(::accept4(socket_.fd.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
            if (client_) prepare_line(client_.get());
        }
        return static_cast<bool>(client_);
    }
    std::string kind() const override { return "tcp"; }
    std::string path() const override { return socket_.text; }

  private:
    int fd() const override { return client_.get(); }
    void lost() override {
        client_.reset();
        forget();
    }
    long write_some(const char* data, std::size_t size) override {
        return write_socket(client_.get(), data, size);
    }
    long read_some(char* data, std::size_t size) override { return read_socket(client_.get(), data, size); }

    ListeningSocket socket_;
    UniqueFd client_;
};

}  // namespace

/// How much of it went.
std::size_t DirectStream::send(std::string_view bytes, std::chrono::milliseconds limit) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const long count = write_some(bytes.data() + done, bytes.size() - done);
        if (count > 0) {
            done += static_cast<std::size_t>(count);
            stalled_ = false;
        } else if (count == 0 || !would_block(errno)) {
            lost();
            return done;
        } else if (!wait_for(fd(), POLLOUT, stalled_ ? std::chrono::milliseconds{0} : limit)) {
            stalled_ = true;
            return done;
        }
    }
    return done;
}

bool DirectStream::write(std::string_view bytes, std::chrono::milliseconds limit) {
    if (!up()) {
        return false;
    }
    rest_.erase(0, send(rest_, limit));
    if (!rest_.empty() || !up()) {
        return false;
    }
    const std::size_t done = send(bytes, limit);
    if (done != 0 && up()) {
        rest_ = bytes.substr(done);
    }
    return done == bytes.size();
}

std::size_t DirectStream::read(std::span<char> out, std::chrono::milliseconds limit) {
    if (!up()) {
        return 0;
    }
    long count = read_some(out.data(), out.size());
    if (count < 0 && would_block(errno) && limit.count() > 0 && wait_for(fd(), POLLIN, limit)) {
        count = read_some(out.data(), out.size());
    }
    if (count == 0 || (count < 0 && !would_block(errno))) {
        lost();
        return 0;
    }
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

std::unique_ptr<DirectStream> make_direct_pty(const std::string& link_name) {
    return std::make_unique<DirectPty>(link_name);
}

std::unique_ptr<DirectStream> make_direct_tcp(const std::string& host_port) {
    return std::make_unique<DirectTcp>(host_port);
}

}  // namespace fauxboard::link
