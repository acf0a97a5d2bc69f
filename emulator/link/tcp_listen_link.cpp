// The board's side of a TCP line.

#include <fmt/format.h>
#include <poll.h>

#include <chrono>
#include <utility>

#include "emulator/link/stream_link.h"
#include "emulator/link/tcp_socket.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

namespace {

using asio::ip::tcp;

// Out of descriptors, mostly; trying again at once would spin.
constexpr std::chrono::milliseconds accept_pause{500};

class TcpListenLink final : public StreamLink {
  public:
    TcpListenLink(asio::io_context& context, std::string host_port)
        : StreamLink(context), host_port_(std::move(host_port)), acceptor_(context), pause_(context) {}
    ~TcpListenLink() override { close(); }

    std::string describe() const override { return fmt::format("tcp {} (listening)", path()); }
    std::string kind() const override { return "tcp"; }
    std::string path() const override { return path_.empty() ? host_port_ : path_; }

  private:
    struct Client {
        UniqueFd fd;
        std::string name;
    };

    void open_device() override;
    void close_device() override;
    void on_end(const std::string& why) override;
    ssize_t read_some(int fd, char* data, std::size_t size) override { return read_socket(fd, data, size); }
    ssize_t write_some(int fd, const char* data, std::size_t size) override {
        return write_socket(fd, data, size);
    }
    bool keeps_backlog() const override { return true; }

    void accept();
    void accept_later(const std::string& why);
    void on_client(tcp::socket socket);
    void serve(Client client);
    bool client_is_leaving() const;

    std::string host_port_;
    std::string path_;
    tcp::acceptor acceptor_;
    asio::steady_timer pause_;
    Client client_;
    Client next_;  ///< came while the former client's last bytes were still to be read
};

void TcpListenLink::open_device() {
    const tcp::endpoint endpoint = resolve(context(), host_port_).front();
    asio::error_code error;
    acceptor_.open(endpoint.protocol(), error);
    // Else a restart would fail for a minute after the last connection.
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(tcp::acceptor::max_listen_connections, error);
    if (error) {
        throw LinkError(fmt::format("Cannot listen on {}: {}. Choose another port, or 0 for a free one.",
                                    to_text(endpoint), error.message()));
    }
    path_ = to_text(acceptor_.local_endpoint(error));
    accept();
    go_waiting(fmt::format("listening on {}; nobody has connected yet", path_));
}

void TcpListenLink::close_device() {
    asio::error_code ignored;
    acceptor_.close(ignored);
    pause_.cancel();
    client_ = {};
    next_ = {};
}

// ---- clients ----

void TcpListenLink::accept() {
    acceptor_.async_accept(guarded([this](const asio::error_code& error, tcp::socket socket) {
        if (error) return accept_later(error.message());
        accept();
        on_client(std::move(socket));
    }));
}

void TcpListenLink::accept_later(const std::string& why) {
    note(fmt::format("{} could not take a connection ({}); trying again", path_, why));
    pause_.expires_after(accept_pause);
    pause_.async_wait(guarded([this](const asio::error_code& error) {
        if (!error) accept();
    }));
}

void TcpListenLink::on_client(tcp::socket socket) {
    asio::error_code error;
    const tcp::endpoint peer = socket.remote_endpoint(error);
    if (error) return;  // gone again
    send_at_once(socket);
    const int fd = socket.release(error);
    if (error) return;
    Client client{UniqueFd(fd), to_text(peer)};
    if (!client_.fd) return serve(std::move(client));
    // One that reconnects may be seen here before its former connection's end has been read.
    if (!next_.fd && client_is_leaving()) {
        next_ = std::move(client);
        return;
    }
    note(fmt::format("{} was turned away: {} is connected", client.name, client_.name));
}

bool TcpListenLink::client_is_leaving() const {
    pollfd poll_fd{client_.fd.get(), POLLRDHUP, 0};
    return ::poll(&poll_fd, 1, 0) > 0;
}

void TcpListenLink::serve(Client client) {
    try {
        attach(client.fd.get());
    } catch (const LinkError& error) {
        return note(error.what());
    }
    client_ = std::move(client);
    go_up(fmt::format("{} connected to {}", client_.name, path_));
}

void TcpListenLink::on_end(const std::string& why) {
    detach();
    go_waiting(fmt::format("{} left {} ({}); what is sent now is lost", client_.name, path_, why));
    client_ = {};
    if (next_.fd) serve(std::exchange(next_, {}));
}

}  // namespace

std::unique_ptr<Link> make_tcp_listen_link(asio::io_context& context, std::string host_port) {
    return std::make_unique<TcpListenLink>(context, std::move(host_port));
}

}  // namespace fauxboard::link
