#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/link/event_loop.h"
#include "emulator/panel/gate.h"

struct MHD_Connection;
struct MHD_Daemon;
struct MHD_Response;

namespace fauxboard::panel {

/// What a request is answered with at once.
struct Reply {
    unsigned status = 200;
    std::string_view type = "text/plain; charset=utf-8";
    std::string body;        ///< of the reply's own
    std::string_view fixed;  ///< instead of `body`: bytes that outlive the server
};

/// A reply without end: its bytes are asked for as fast as the client reads them.
class Stream {
  public:
    virtual ~Stream() = default;
    /// What there is to say now; empty when nothing is. Nothing when it is over.
    virtual std::optional<std::string> take() = 0;
    /// Whether take() would bring something, or is over.
    virtual bool wants_turn() const = 0;
};

/// Who answers. Called from the event loop only; must not throw.
class HttpHandler {
  public:
    virtual ~HttpHandler() = default;
    virtual Reply get(const Route& route) = 0;
    /// `body` is whole and at most HttpServer::most_body bytes.
    virtual Reply post(const Route& route, std::string_view body) = 0;
    /// A stream, if that is what the path stands for; else null and get() is asked.
    virtual std::unique_ptr<Stream> stream(const Route& route) = 0;
};

/// HTTP on the run's own event loop, by libmicrohttpd, which is driven from outside: no thread, no second
/// loop. Only what the gate lets in reaches the handler.
///
/// Bounded: connections, the head of a request, its body, the time a client may take, the share of the loop's
/// time that all of them get. A client that reads nothing is dropped.
class HttpServer {
  public:
    static constexpr unsigned most_connections = 96;
    static constexpr std::size_t most_head = 16UL * 1024;  ///< bytes, with what a reply needs
    static constexpr std::size_t most_body = 16UL * 1024;
    static constexpr unsigned patience_s = 30;  ///< without a byte from the client, or to it
    static constexpr std::chrono::milliseconds stream_pause{40};  ///< between two pieces of a stream
    static constexpr std::chrono::seconds sign_of_life{10};       ///< of a stream that has nothing to say

    /// Listens at once on `where` ("HOST:PORT", ":PORT", "PORT"; loopback where no host is given, 0 for a
    /// free port), and behind a slash perhaps the token, for an address that is to last beyond the run; a new
    /// one if not. `handler` outlives this. Throws link::LinkError when it cannot.
    HttpServer(link::EventLoop& loop, const std::string& where, HttpHandler& handler);
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    /// "http://127.0.0.1:4321/TOKEN/".
    std::string address() const;
    /// A stream's wants_turn() may have become true. Costs next to nothing; from any place on the loop's
    /// thread.
    void nudge();

  private:
    class Connection;
    struct Callbacks;

    void run();
    void rest(std::chrono::steady_clock::duration worked);
    void feed_streams();
    int answer(MHD_Connection* connection, const char* path, const char* method, const char* data,
               std::size_t* size, void** mine);
    int begin(MHD_Connection* connection, Connection& request);
    int respond(MHD_Connection* connection, Connection& request);

    HttpHandler& handler_;
    std::string where_;
    std::optional<Gate> gate_;
    MHD_Daemon* daemon_ = nullptr;
    link::Watch watch_;
    link::Timer due_;    ///< of the library
    link::Timer pause_;  ///< after work: the loop is not ours alone
    link::Timer feed_;
    link::Timer alive_;
    std::vector<Connection*> streaming_;
    bool feeding_ = false;  ///< feed_ is set
};

}  // namespace fauxboard::panel
