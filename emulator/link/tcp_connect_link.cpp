// The screen's side of a TCP line.

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "emulator/link/reopening_link.h"
#include "emulator/link/tcp_socket.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

namespace {

using asio::ip::tcp;

constexpr int connect_timeout_ms = 5000;

class TcpConnectLink final : public ReopeningLink {
  public:
    TcpConnectLink(asio::io_context& context, std::string host_port)
        : ReopeningLink(context), host_port_(std::move(host_port)), socket_(context) {}
    ~TcpConnectLink() override { close(); }

    std::string describe() const override { return fmt::format("tcp {}", path()); }
    std::string kind() const override { return "tcp"; }
    std::string path() const override { return endpoint_.port() == 0 ? host_port_ : to_text(endpoint_); }

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

    void connected();

    std::string host_port_;
    tcp::endpoint endpoint_;
    tcp::socket socket_;  ///< while connecting
    UniqueFd fd_;         ///< once connected
};

/// Connects within the time limit; the error number, 0 if it worked.
int connect_in_time(tcp::socket& socket, const tcp::endpoint& endpoint) {
    asio::error_code error;
    socket.open(endpoint.protocol(), error);
    if (!error) socket.native_non_blocking(true, error);
    if (error) return error.value();
    const int fd = socket.native_handle();
    if (::connect(fd, endpoint.data(), static_cast<socklen_t>(endpoint.size())) == 0) return 0;
    if (errno != EINPROGRESS) return errno;
    pollfd poll_fd{fd, POLLOUT, 0};
    const int ready = ::poll(&poll_fd, 1, connect_timeout_ms);
    if (ready < 0) return errno;
    if (ready == 0) return ETIMEDOUT;
    int result = 0;
    socklen_t size = sizeof result;
    return ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &result, &size) == 0 ? result : errno;
}

/// On loopback a port that nobody listens on may be dialled from that very port, and TCP then connects it to
/// itself.
bool connected_to_itself(const tcp::socket& socket) {
    asio::error_code local_error;
    asio::error_code remote_error;
    const tcp::endpoint local = socket.local_endpoint(local_error);
    return local == socket.remote_endpoint(remote_error) || local_error || remote_error;
}

void TcpConnectLink::open_device() {
    int error = 0;
    for (const tcp::endpoint& endpoint : resolve(context(), host_port_)) {
        endpoint_ = endpoint;
        error = connect_in_time(socket_, endpoint);
        if (error == 0 && connected_to_itself(socket_)) error = ECONNREFUSED;
        if (error == 0) return connected();
        release_device();
    }
    throw LinkError(fmt::format("Cannot connect to {}: {}. Is the other side listening there?", path(),
                                error_text(error)));
}

// A connecting socket of our own event loop: a host that does not answer must not stop everything else.
void TcpConnectLink::try_again() {
    socket_.async_connect(endpoint_, guarded([this](const asio::error_code& error) {
                              if (!error && !connected_to_itself(socket_)) {
                                  try {
                                      return connected();
                                  } catch (const LinkError&) {
                                      detach();
                                  }
                              }
                              release_device();
                              retry_later();
                          }));
}

void TcpConnectLink::connected() {
    send_at_once(socket_);
    asio::error_code error;
    fd_.reset(socket_.release(error));
    attach(fd_.get());
    go_up(was_up() ? fmt::format("connected to {} again", path()) : fmt::format("connected to {}", path()));
}

void TcpConnectLink::release_device() {
    asio::error_code ignored;
    socket_.close(ignored);
    fd_.reset();
}

}  // namespace

std::unique_ptr<Link> make_tcp_connect_link(asio::io_context& context, std::string host_port) {
    return std::make_unique<TcpConnectLink>(context, std::move(host_port));
}

}  // namespace fauxboard::link
