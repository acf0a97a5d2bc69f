// The board's side of a TCP line.

#include <fmt/format.h>
#include <poll.h>

#include <cerrno>
#include <utility>

#include "emulator/link/acceptor.h"
#include "emulator/link/inet_socket.h"
#include "emulator/link/listening_socket.h"
#include "emulator/link/socket_io.h"
#include "emulator/link/stream_link.h"

namespace fauxboard::link {

namespace {

class TcpListenLink final : public StreamLink {
  public:
    TcpListenLink(EventLoop& loop, std::string host_port, bool backlog)
        : StreamLink(loop),
          backlog_(backlog),
          host_port_(std::move(host_port)),
          acceptor_(
              loop, [this](UniqueFd fd) { on_client(std::move(fd)); },
              [this](std::string_view why) {
                  note(fmt::format("{} could not take a connection ({}); trying again", path_, why));
              }) {}
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
    bool keeps_backlog() const override { return backlog_; }

    void on_client(UniqueFd fd);
    void serve(Client client);
    bool client_is_leaving() const;

    bool backlog_;
    std::string host_port_;
    std::string path_;
    Acceptor acceptor_;
    Client client_;
    Client next_;  ///< came while the former client's last bytes were still to be read
};

void TcpListenLink::open_device() {
    ListeningSocket socket = listen_tcp(host_port_);
    path_ = std::move(socket.text);
    acceptor_.start(std::move(socket.fd));
    go_waiting(fmt::format("listening on {}; nobody has connected yet", path_));
}

void TcpListenLink::close_device() {
    acceptor_.stop();
    client_ = {};
    next_ = {};
}

// ---- clients ----

void TcpListenLink::on_client(UniqueFd fd) {
    const SocketAddress peer = SocketAddress::of_peer(fd.get());
    if (!peer.known()) return;  // gone again
    prepare_line(fd.get());
    Client client{std::move(fd), peer.text()};
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

std::unique_ptr<Link> make_tcp_listen_link(EventLoop& loop, std::string host_port, bool backlog) {
    return std::make_unique<TcpListenLink>(loop, std::move(host_port), backlog);
}

}  // namespace fauxboard::link
