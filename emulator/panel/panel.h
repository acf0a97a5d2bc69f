#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/control/session.h"
#include "emulator/host/live_target.h"
#include "emulator/panel/http_server.h"

namespace fauxboard::panel {

/// The page in the browser: one board or a shelf of them. What is shown comes from, and what a person does
/// goes to, the same sessions as the control channel's; here are paths, streams, and the bounds on both.
///
///     GET  /                the page; its files by their names
///     GET  /boards          [{"name", "profile", "title"}, ...]
///     GET  /live/N          a session with board N: {"session": ID}, then all it says, as server-sent events
///     POST /live/N/ID       lines of requests for that session; 204, and the answers come on its stream
///     GET  /shelf           what has changed on any board, once a second
class Panel final : private HttpHandler {
  public:
    static constexpr std::size_t most_sessions = 32;
    static constexpr std::size_t most_shelves = 8;

    struct Shown {
        std::string name;  ///< what its owner calls it
        host::LiveTarget& target;
        std::function<void(const std::string&)> tell = {};  ///< told of pages that come and go, when given
    };
    /// `loop` and the targets outlive this. Throws link::LinkError when it cannot listen; see HttpServer.
    Panel(link::EventLoop& loop, const std::string& where, std::vector<Shown> boards);
    ~Panel() override;

    /// "http://127.0.0.1:4321/TOKEN/".
    std::string address() const { return server_->address(); }

  private:
    class Session;
    class Shelf;

    Reply get(const Route& route) override;
    Reply post(const Route& route, std::string_view body) override;
    std::unique_ptr<Stream> stream(const Route& route) override;
    std::string list() const;

    link::EventLoop& loop_;
    std::vector<Shown> boards_;
    std::vector<Session*> sessions_;
    std::size_t shelves_ = 0;
    std::uint64_t last_session_ = 0;
    std::unique_ptr<HttpServer> server_;
};

}  // namespace fauxboard::panel
