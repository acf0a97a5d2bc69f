// The screen's side of a TCP line.

#include <fmt/format.h>
#include <poll.h>

#include <cerrno>
#include <utility>

#include "emulator/link/inet_socket.h"
#include "emulator/link/reopening_link.h"
#include "emulator/link/socket_io.h"

namespace fauxboard::link {

namespace {

constexpr int connect_timeout_ms = 5000;

class TcpConnectLink final : public ReopeningLink {
  public:
    TcpConnectLink(EventLoop& loop, std::string host_port)
        : ReopeningLink(loop),
          host_port_(std::move(host_port)),
          // Readable is what a refused one is, too.
          connecting_(
              loop, [this] { on_decided(); }, [this] { on_decided(); }) {}
    ~TcpConnectLink() override { close(); }

    std::string describe() const override { return fmt::format("tcp {}", path()); }
    std::string kind() const override { return "tcp"; }
    std::string path() const override { return address_.known() ? address_.text() : host_port_; }

  private:
    void open_device() override;
    void release_device() override;
    void try_again() override;
    std::string lost_sentence(const std::string& why) const override {
        return fmt::format("the connection to {} was lost ({}); trying again", path(), why);
    }
    ssize_t read_some(int fd, char* data, std::size_t size) override { return read_socket(fd, data, size); }
    ssize_t write_some(int fd, const char* data, std::size_t size) override {
        return write_socket(fd, data, size);
    }

    void on_decided();
    void connected();
    void failed();

    std::string host_port_;
    SocketAddress address_;
    UniqueFd fd_;
    Watch connecting_;  ///< fd_, while the other side has not answered yet
};

/// Begins to connect `fd`; the error number, EINPROGRESS while it is not decided, 0 if it worked.
int begin_to_connect(int fd, const SocketAddress& address) {
    return ::connect(fd, address.get(), address.size()) == 0 ? 0 : errno;
}

/// How it ended: 0, or the error number. On loopback a port that nobody listens on may be dialled from that
/// very port, and TCP then connects it to itself.
int connect_result(int fd) {
    int result = 0;
    socklen_t size = sizeof result;
    if (::getsockopt(fd, SOL_SOCKET, SO_ERROR, &result, &size) != 0) return errno;
    if (result != 0) return result;
    const SocketAddress peer = SocketAddress::of_peer(fd);
    return !peer.known() || peer == SocketAddress::of(fd) ? ECONNREFUSED : 0;
}

/// Connects within the time limit; as connect_result().
int connect_in_time(int fd, const SocketAddress& address) {
    const int error = begin_to_connect(fd, address);
    if (error == EINPROGRESS) {
        pollfd poll_fd{fd, POLLOUT, 0};
        const int ready = ::poll(&poll_fd, 1, connect_timeout_ms);
        if (ready <= 0) return ready < 0 ? errno : ETIMEDOUT;
    } else if (error != 0) {
        return error;
    }
    return connect_result(fd);
}

void TcpConnectLink::open_device() {
    int error = 0;
    for (const SocketAddress& address : resolve(host_port_, SOCK_STREAM)) {
        address_ = address;
        fd_ = make_inet_socket(address, SOCK_STREAM);
        error = fd_ ? connect_in_time(fd_.get(), address) : errno;
        if (error == 0) return connected();
        release_device();
    }
    throw LinkError(fmt::format("Cannot connect to {}: {}. Is the other side listening there?", path(),
                                error_text(error)));
}

// Waits in the event loop: a host that does not answer must not stop everything else.
void TcpConnectLink::try_again() {
    fd_ = make_inet_socket(address_, SOCK_STREAM);
    const int error = fd_ ? begin_to_connect(fd_.get(), address_) : errno;
    if (error != 0 && error != EINPROGRESS) return failed();
    try {
        connecting_.start(fd_.get());
    } catch (const LinkError&) {
        return failed();
    }
    connecting_.await_writable();
}

void TcpConnectLink::on_decided() {
    connecting_.stop();
    if (connect_result(fd_.get()) != 0) return failed();
    try {
        connected();
    } catch (const LinkError&) {
        detach();
        failed();
    }
}

void TcpConnectLink::failed() {
    release_device();
    retry_later();
}

void TcpConnectLink::connected() {
    prepare_line(fd_.get());
    attach(fd_.get());
    go_up(was_up() ? fmt::format("connected to {} again", path()) : fmt::format("connected to {}", path()));
}

void TcpConnectLink::release_device() {
    connecting_.stop();
    fd_.reset();
}

}  // namespace

std::unique_ptr<Link> make_tcp_connect_link(EventLoop& loop, std::string host_port) {
    return std::make_unique<TcpConnectLink>(loop, std::move(host_port));
}

}  // namespace fauxboard::link
