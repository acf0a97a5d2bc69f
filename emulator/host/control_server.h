#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/behaviour/notice.h"
#include "emulator/control/hub.h"
#include "emulator/link/local_listener.h"

namespace fauxboard::host {

/// The control channel of one live board: a Unix socket with a line of JSON for each request and answer,
/// apart from the tested line. What is said on it is the business of emulator/control; here are the socket
/// and its clients.
class ControlServer final {
  public:
    static constexpr std::size_t most_clients = 128;

    using Say = std::function<void(behaviour::Level level, std::string_view sentence)>;
    /// `hub` and `loop` outlive this. `say`: what a person wants to know of the channel itself.
    ControlServer(link::EventLoop& loop, control::Hub& hub, Say say);
    ~ControlServer();
    ControlServer(const ControlServer&) = delete;
    ControlServer& operator=(const ControlServer&) = delete;

    /// Throws link::LinkError, see link::LocalPath::listen.
    void open(const std::string& path);
    /// Tells the clients that this is the end, as far as they read, and removes the socket. Idempotent.
    void close();

  private:
    class Client;

    void take(link::UniqueFd socket);
    void turn_away(const link::UniqueFd& socket) const;
    void leave(const Client& client);
    void tell_size(std::string_view what) const;
    template <class Task>
    void post(Task task);
    void queue(const std::shared_ptr<Client>& client);
    void serve_next();

    link::EventLoop& loop_;
    control::Hub& hub_;
    Say say_;
    std::vector<std::shared_ptr<Client>> clients_;
    /// Who has said something that was not looked at yet. One request is carried out on a turn of the loop,
    /// each client's in turn: a client that floods us slows down itself, neither the others nor the line.
    std::deque<std::weak_ptr<Client>> queue_;
    link::LocalListener listener_;
    /// What is posted to the event loop finds this gone when this object is.
    std::shared_ptr<int> life_ = std::make_shared<int>();
};

}  // namespace fauxboard::host
