#include "emulator/host/control_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <utility>

#include "emulator/control/session.h"
#include "emulator/link/link.h"
#include "emulator/link/socket_io.h"

namespace fauxboard::host {
namespace {

using behaviour::Level;
using control::Session;
using link::UniqueFd;

}  // namespace

/// A session on a socket. Never waits: what the client does not read stays here, within the session's bounds.
class ControlServer::Client : public std::enable_shared_from_this<Client> {
  public:
    Client(ControlServer& server, UniqueFd socket)
        : server_(server),
          socket_(std::move(socket)),
          watch_(
              server.loop_, [this] { read(); }, [this] { pump(); }) {
        session_.emplace(server.hub_, [this] { pump_soon(); });
    }

    /// Throws link::LinkError when the event loop has no room for it.
    void start() { watch_.start(socket_.get()); }
    /// Looks at one request of what came. False when nothing of it is left.
    bool serve() {
        if (session_) {
            const std::size_t size = std::min(unread_.find('\n'), unread_.size() - 1) + 1;
            session_->receive(std::string_view(unread_).substr(0, size));
            unread_.erase(0, size);
            pump();
        }
        return session_.has_value() && !unread_.empty();
    }
    /// As far as it goes without waiting; then the socket is closed.
    void end() {
        if (session_) {
            session_->on_end();
            flush();
        }
        close();
    }

  private:
    /// The session wakes us from inside the board's calls, where nothing may be done.
    void pump_soon() {
        server_.loop_.post([self = shared_from_this()] { self->pump(); });
    }

    void pump() {
        const auto self = shared_from_this();  // leave() may drop the last one
        if (!session_) {
            return;
        }
        session_->proceed();
        if (session_->dropped()) {
            server_.say_(Level::info,
                         "a client of the control channel does not read what it asked for; dropped");
        } else if (!flush() || !session_->over() || !written()) {
            if (session_) {
                watch_.hold(ended_ || !unread_.empty() || !session_->wants_input());
            }
            return;
        }
        leave();
    }

    bool written() const { return at_ == writing_.size() && !session_->has_output(); }

    /// False when the client is gone.
    bool flush() {
        while (session_) {
            if (at_ == writing_.size()) {
                at_ = 0;
                writing_ = session_->take_output();
                if (writing_.empty()) {
                    return true;
                }
            }
            const ssize_t written =
                link::write_socket(socket_.get(), writing_.data() + at_, writing_.size() - at_);
            if (written >= 0) {
                at_ += static_cast<std::size_t>(written);
            } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
                watch_.await_writable();
                return true;
            } else if (errno != EINTR) {
                leave();
                return false;
            }
        }
        return false;
    }

    void read() {
        const auto self = shared_from_this();  // leave() may drop the last one
        const ssize_t size = link::read_socket(socket_.get(), buffer_.data(), buffer_.size());
        if (size > 0) {
            unread_.assign(buffer_.data(), static_cast<std::size_t>(size));
            watch_.hold(true);
            return server_.queue(self);
        } else if (size == 0) {
            ended_ = true;
            session_->finish();
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            return watch_.drained();
        } else if (errno != EINTR) {
            return leave();
        }
        pump();
    }

    void close() {
        session_.reset();
        watch_.stop();
        socket_.reset();
    }

    void leave() {
        close();
        server_.leave(*this);
    }

    ControlServer& server_;  ///< valid as long as there is a session
    UniqueFd socket_;
    link::Watch watch_;
    std::optional<Session> session_;
    std::array<char, 4096> buffer_{};
    std::string unread_;  ///< what came and is not looked at; nothing is read meanwhile
    std::string writing_;
    std::size_t at_ = 0;  ///< so much of it is written
    bool ended_ = false;  ///< the client has said all it will
};

// The server.
// -----------------------------------------------------------------------------------------------

ControlServer::ControlServer(link::EventLoop& loop, control::Hub& hub, Say say)
    : loop_(loop),
      hub_(hub),
      say_(std::move(say)),
      listener_(
          loop, [this](UniqueFd socket) { take(std::move(socket)); },
          [this](std::string_view text) { say_(Level::warning, text); }) {}

ControlServer::~ControlServer() {
    close();
}

void ControlServer::open(const std::string& path) {
    listener_.open(path);
}

void ControlServer::close() {
    listener_.close();
    for (const std::shared_ptr<Client>& client : std::exchange(clients_, {})) {
        client->end();
    }
}

void ControlServer::take(UniqueFd socket) {
    if (clients_.size() >= most_clients) {
        return turn_away(socket);
    }
    const auto client = std::make_shared<Client>(*this, std::move(socket));
    try {
        client->start();
        clients_.push_back(client);
        tell_size("came to");
    } catch (const link::LinkError& error) {
        say_(Level::warning, error.what());
    }
}

void ControlServer::turn_away(const UniqueFd& socket) const {
    const control::ControlError error(
        control::ErrorCode::too_many_clients,
        fmt::format("{} clients are connected, and more cannot be; try again when one has left.",
                    most_clients));
    const std::string line = control::to_line({{"ok", false}, {"error", control::error_json(error)}});
    (void)link::write_socket(socket.get(), line.data(), line.size());
}

/// Put off to the loop's next turn; dropped if this is gone by then.
template <class Task>
void ControlServer::post(Task task) {
    loop_.post([life = std::weak_ptr(life_), task = std::move(task)] {
        if (!life.expired()) task();
    });
}

void ControlServer::queue(const std::shared_ptr<Client>& client) {
    const bool first = queue_.empty();
    queue_.push_back(client);
    if (first) {
        post([this] { serve_next(); });
    }
}

void ControlServer::serve_next() {
    const std::shared_ptr<Client> client = queue_.front().lock();
    queue_.pop_front();
    if (client && client->serve()) {
        queue_.push_back(client);
    }
    if (!queue_.empty()) {
        post([this] { serve_next(); });
    }
}

void ControlServer::leave(const Client& client) {
    std::erase_if(clients_, [&](const std::shared_ptr<Client>& each) { return each.get() == &client; });
    tell_size("left");
}

void ControlServer::tell_size(std::string_view what) const {
    say_(Level::debug, fmt::format("a client {} the control channel; clients: {}", what, clients_.size()));
}

}  // namespace fauxboard::host
