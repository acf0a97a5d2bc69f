#include "emulator/host/control_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "emulator/control/session.h"

namespace fauxboard::host {
namespace {

using control::Session;
using Socket = link::LocalListener::Socket;

/// Virtual time that may be skipped before the event loop gets its turn.
constexpr SimTime skip_at_once = std::chrono::minutes(1);

}  // namespace

/// A session on a socket. Never waits: what the client does not read stays here, within the session's bounds.
class ControlServer::Client : public std::enable_shared_from_this<Client> {
  public:
    Client(ControlServer& server, Socket socket) : server_(server), socket_(std::move(socket)) {
        asio::error_code ignored;  // then writes could wait; they are small, and the next one tells
        socket_.non_blocking(true, ignored);
        session_.emplace(server.hub_, [this] { pump_soon(); });
    }

    void start() { read(); }
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
        asio::post(socket_.get_executor(), [self = shared_from_this()] { self->pump(); });
    }

    void pump() {
        if (!session_) {
            return;
        }
        session_->proceed();
        if (session_->dropped()) {
            server_.parts_.say("a client of the control channel does not read what it asked for; dropped");
        } else if (!flush() || !session_->over() || !written()) {
            if (session_) {
                read();
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
            asio::error_code error;
            at_ += socket_.write_some(asio::buffer(writing_) + at_, error);
            if (error == asio::error::would_block) {
                wait_writable();
                return true;
            }
            if (error) {
                leave();
                return false;
            }
        }
        return false;
    }

    void wait_writable() {
        if (std::exchange(waiting_, true)) {
            return;
        }
        socket_.async_wait(Socket::wait_write, [self = shared_from_this()](const asio::error_code& error) {
            self->waiting_ = false;
            if (!error) {
                self->pump();
            }
        });
    }

    void read() {
        if (!session_->wants_input() || std::exchange(reading_, true)) {
            return;
        }
        socket_.async_read_some(asio::buffer(buffer_),
                                [self = shared_from_this()](const asio::error_code& error, std::size_t size) {
                                    self->reading_ = false;
                                    self->on_read(error, size);
                                });
    }

    void on_read(const asio::error_code& error, std::size_t size) {
        if (!session_) {
            return;
        }
        if (error == asio::error::eof) {
            session_->finish();
        } else if (error) {
            return leave();
        } else {
            session_->receive({buffer_.data(), size});
        }
        pump();
    }

    void close() {
        session_.reset();
        asio::error_code ignored;
        socket_.close(ignored);
    }

    void leave() {
        close();
        server_.leave(*this);
    }

    ControlServer& server_;  ///< valid as long as there is a session
    Socket socket_;
    std::optional<Session> session_;
    std::array<char, 4096> buffer_{};
    std::string writing_;
    std::size_t at_ = 0;  ///< so much of it is written
    bool reading_ = false;
    bool waiting_ = false;
};

// The server.
// -----------------------------------------------------------------------------------------------

ControlServer::ControlServer(Parts parts)
    : parts_(std::move(parts)),
      hub_(*this),
      listener_(
          parts_.context, [this](Socket socket) { take(std::move(socket)); },
          [this](std::string_view text) { parts_.say(text); }) {
    parts_.live.follow([this](SimTime now) { return hub_.on_moved(now); });
}

ControlServer::~ControlServer() {
    close();
    parts_.live.follow({});
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

void ControlServer::take(Socket socket) {
    if (clients_.size() >= most_clients) {
        return turn_away(std::move(socket));
    }
    clients_.push_back(std::make_shared<Client>(*this, std::move(socket)));
    clients_.back()->start();
}

void ControlServer::turn_away(Socket socket) const {
    const control::ControlError error(
        control::ErrorCode::too_many_clients,
        fmt::format("{} clients are connected, and more cannot be; try again when one has left.",
                    most_clients));
    asio::error_code ignored;
    socket.non_blocking(true, ignored);
    socket.write_some(asio::buffer(control::to_line({{"ok", false}, {"error", control::error_json(error)}})),
                      ignored);
}

void ControlServer::leave(const Client& client) {
    std::erase_if(clients_, [&](const std::shared_ptr<Client>& each) { return each.get() == &client; });
}

void ControlServer::on_link(SimTime now, link::LinkState state, std::string_view why) {
    hub_.on_link(now, link::state_name(state), why);
}

/// Skips a stretch and posts itself for the next one: a jump of days must not make the channel deaf.
void ControlServer::skip_on() {
    const SimTime left = skip_to_ - parts_.clock.now();
    if (left > SimTime{0}) {
        parts_.clock.skip(std::min(left, skip_at_once));
        asio::post(parts_.context, [this, life = std::weak_ptr(life_)] {
            if (!life.expired()) skip_on();
        });
    }
}

SimTime ControlServer::skip(SimTime by) {
    const SimTime now = parts_.clock.now();
    const bool under_way = skip_to_ > now;
    skip_to_ = std::max(skip_to_, now) + by;
    if (!under_way) {
        asio::post(parts_.context, [this, life = std::weak_ptr(life_)] {
            if (!life.expired()) skip_on();
        });
    }
    return skip_to_;
}

void ControlServer::quit() {
    asio::post(parts_.context, parts_.quit);
}

control::Json ControlServer::status() const {
    const link::LinkStats& stats = parts_.link.stats();
    return {{"link",
             {{"kind", parts_.link.kind()},
              {"path", parts_.link.path()},
              {"state", link::state_name(parts_.link.state())},
              {"bytes_in", stats.bytes_in},
              {"bytes_out", stats.bytes_out},
              {"bytes_lost", stats.bytes_lost}}}};
}

}  // namespace fauxboard::host
