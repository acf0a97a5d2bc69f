#include "emulator/panel/http_server.h"

#include <fmt/format.h>
#include <microhttpd.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "emulator/link/link.h"
#include "emulator/link/listening_socket.h"

namespace fauxboard::panel {
namespace {

using Clock = link::Timer::Clock;

constexpr std::size_t stream_block = 16UL * 1024;
/// Of the time, the page's requests get one part and the boards this many, should it come to that.
constexpr int parts_for_others = 9;
constexpr int socket_failed = 4;  ///< exit code, as for a socket that cannot be opened

struct Header {
    const char* name;
    const char* value;
};
/// Nothing from elsewhere, nothing to elsewhere, no markup that is not ours, and the address kept to itself.
constexpr std::array headers{
    Header{"Content-Security-Policy",
           "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src "
           "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    Header{"X-Content-Type-Options", "nosniff"},
    Header{"X-Frame-Options", "DENY"},
    Header{"Referrer-Policy", "no-referrer"},
    Header{"Cross-Origin-Resource-Policy", "same-origin"},
    Header{"Cross-Origin-Opener-Policy", "same-origin"},
    Header{"Cache-Control", "no-store"},
};

void dress(MHD_Response* response, std::string_view type) {
    for (const Header& header : headers) {
        MHD_add_response_header(response, header.name, header.value);
    }
    MHD_add_response_header(response, "Content-Type", std::string(type).c_str());
}

Reply refusal(Refusal why) {
    switch (why) {
        case Refusal::host:
            return {403,
                    Reply{}.type,
                    "This name does not belong to the panel; use the address that run told.\n",
                    {}};
        case Refusal::origin:
            return {403, Reply{}.type, "The panel answers to its own page only.\n", {}};
        case Refusal::token:
            return {404,
                    Reply{}.type,
                    "Nothing is here. The whole address, with its token, is what run told.\n",
                    {}};
        case Refusal::method:
            return {405, Reply{}.type, "GET and POST only.\n", {}};
        case Refusal::none:
            break;
    }
    return {};
}

std::optional<std::string_view> header(MHD_Connection* connection, const char* name) {
    const char* value = nullptr;
    std::size_t size = 0;
    if (MHD_lookup_connection_value_n(connection, MHD_HEADER_KIND, name, std::string_view(name).size(),
                                      &value, &size) != MHD_YES) {
        return std::nullopt;
    }
    return std::string_view(value == nullptr ? "" : value, size);
}

}  // namespace

/// One request while it lasts.
class HttpServer::Connection {
  public:
    Connection(HttpServer& server, MHD_Connection* connection, std::string_view method, std::string_view path)
        : server_(server), connection_(connection), path_(path), post_(method == "POST") {}
    ~Connection() { std::erase(server_.streaming_, this); }

    /// Bytes for the client: as many as fit, or none now, or the end.
    ssize_t read(char* room, std::size_t size) {
        if (at_ == writing_.size()) {
            std::optional<std::string> more = stream_->take();
            if (!more) {
                return MHD_CONTENT_READER_END_OF_STREAM;
            }
            writing_ = more->empty() && std::exchange(silent_, false) ? ":\n\n" : *std::move(more);
            at_ = 0;
        }
        if (writing_.empty()) {
            MHD_suspend_connection(connection_);
            suspended_ = true;
            return 0;
        }
        const std::size_t part = std::min(size, writing_.size() - at_);
        std::copy_n(writing_.data() + at_, part, room);
        at_ += part;
        return static_cast<ssize_t>(part);
    }
    void resume(bool if_silent) {
        if (suspended_ && (if_silent || stream_->wants_turn())) {
            suspended_ = false;
            silent_ = if_silent;
            MHD_resume_connection(connection_);
        }
    }
    void end_stream() {
        stream_ = std::make_unique<Ended>();
        resume(true);
    }

    class Ended final : public Stream {
      public:
        std::optional<std::string> take() override { return std::nullopt; }
        bool wants_turn() const override { return true; }
    };

    HttpServer& server_;
    MHD_Connection* connection_;
    std::string path_;
    bool post_;
    std::string body_;
    bool too_long_ = false;
    std::unique_ptr<Stream> stream_;
    std::string writing_;
    std::size_t at_ = 0;
    bool suspended_ = false;
    bool silent_ = false;  ///< has nothing to say, but must show that it lives
};

struct HttpServer::Callbacks {
    static MHD_Result answer(void* self, MHD_Connection* connection, const char* path, const char* method,
                             const char* /*version*/, const char* data, std::size_t* size, void** mine) {
        return static_cast<HttpServer*>(self)->answer(connection, path, method, data, size, mine) != 0
                   ? MHD_YES
                   : MHD_NO;
    }
    static void completed(void* /*self*/, MHD_Connection* /*connection*/, void** mine,
                          MHD_RequestTerminationCode /*why*/) {
        delete static_cast<Connection*>(std::exchange(*mine, nullptr));
    }
    static ssize_t read(void* request, std::uint64_t /*at*/, char* room, std::size_t size) {
        return static_cast<Connection*>(request)->read(room, size);
    }
    /// The library cannot go on, and calls abort() where nobody does anything else: the system refuses what
    /// it never should. There is no way back from here.
    [[noreturn]] static void give_up(void*, const char*, unsigned, const char* reason) {
        fmt::print(stderr, "The page cannot be served any longer, and with it ends the run: {}\n",
                   reason == nullptr ? "" : reason);
        std::_Exit(socket_failed);
    }
    static void log(void* /*self*/, const char* /*format*/, va_list /*arguments*/) {}
    /// A path stays as it came: what would have to be decoded is no path of ours.
    static std::size_t keep_escapes(void* /*self*/, MHD_Connection* /*connection*/, char* text) {
        return std::string_view(text).size();
    }
};

HttpServer::HttpServer(link::EventLoop& loop, const std::string& where, HttpHandler& handler)
    : handler_(handler),
      watch_(loop, [this] { run(); }),
      due_(loop, [this] { run(); }),
      pause_(loop,
             [this] {
                 watch_.hold(false);
                 run();
             }),
      feed_(loop, [this] { feed_streams(); }),
      alive_(loop, [this] {
          for (Connection* each : streaming_) {
              each->resume(true);
          }
          alive_.after(sign_of_life);
          run();
      }) {
    const std::size_t slash = where.find('/');
    std::string token = slash == std::string::npos ? make_token() : where.substr(slash + 1);
    if (!is_token(token)) {
        throw link::LinkError(fmt::format(
            "\"{}\" cannot be the secret part of an address; give {} to {} letters and digits, or "
            "none, and one is made.",
            token, shortest_token, longest_token));
    }
    link::ListeningSocket listening = link::listen_tcp(where.substr(0, slash));
    where_ = listening.text;
    gate_.emplace(std::move(token), listening.host, listening.port);
    const std::array options{
        MHD_OptionItem{MHD_OPTION_EXTERNAL_LOGGER, reinterpret_cast<intptr_t>(&Callbacks::log), nullptr},
        MHD_OptionItem{MHD_OPTION_LISTEN_SOCKET, listening.fd.get(), nullptr},
        MHD_OptionItem{MHD_OPTION_CONNECTION_LIMIT, most_connections, nullptr},
        MHD_OptionItem{MHD_OPTION_CONNECTION_MEMORY_LIMIT, most_head, nullptr},
        MHD_OptionItem{MHD_OPTION_CONNECTION_TIMEOUT, patience_s, nullptr},
        MHD_OptionItem{MHD_OPTION_STRICT_FOR_CLIENT, 1, nullptr},
        MHD_OptionItem{MHD_OPTION_UNESCAPE_CALLBACK, reinterpret_cast<intptr_t>(&Callbacks::keep_escapes),
                       nullptr},
        MHD_OptionItem{MHD_OPTION_NOTIFY_COMPLETED, reinterpret_cast<intptr_t>(&Callbacks::completed), this},
        MHD_OptionItem{MHD_OPTION_END, 0, nullptr}};
    MHD_set_panic_func(&Callbacks::give_up, nullptr);
    daemon_ =
        MHD_start_daemon(MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG, 0, nullptr, nullptr,
                         &Callbacks::answer, this, MHD_OPTION_ARRAY, options.data(), MHD_OPTION_END);
    if (daemon_ == nullptr) {
        throw link::LinkError(fmt::format("The panel cannot be served on {}.", where_));
    }
    (void)listening.fd.release();  // the library closes it
    watch_.start(MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_EPOLL_FD)->epoll_fd);
}

HttpServer::~HttpServer() {
    feed_streams();  // the last words
    MHD_run(daemon_);
    watch_.stop();
    for (Connection* each : streaming_) {
        each->end_stream();
    }
    // Twice: what was resumed is looked at only then.
    MHD_run(daemon_);
    MHD_run(daemon_);
    MHD_stop_daemon(daemon_);
}

std::string HttpServer::address() const {
    return fmt::format("http://{}/{}/", where_, gate_->token());
}

// Turns.
// -----------------------------------------------------------------------------------------------

void HttpServer::run() {
    const auto start = Clock::now();
    MHD_run(daemon_);
    pollfd more{watch_.fd(), POLLIN, 0};
    const bool busy = ::poll(&more, 1, 0) > 0;
    if (!busy) {
        watch_.drained();
    }
    MHD_UNSIGNED_LONG_LONG wait_ms = 0;
    const bool has_limit = MHD_get_timeout(daemon_, &wait_ms) == MHD_YES;
    due_.cancel();
    if (busy || (has_limit && wait_ms == 0)) {
        rest(Clock::now() - start);
    } else if (has_limit) {
        due_.after(std::chrono::milliseconds(wait_ms));
    }
}

/// Somebody asks faster than we answer: the boards on this loop come first.
void HttpServer::rest(Clock::duration worked) {
    watch_.hold(true);
    pause_.after(worked * parts_for_others);
}

void HttpServer::nudge() {
    if (!streaming_.empty() && !std::exchange(feeding_, true)) {
        feed_.after(stream_pause);
    }
}

void HttpServer::feed_streams() {
    feeding_ = false;
    for (Connection* each : streaming_) {
        each->resume(false);
    }
    run();
}

// Requests.
// -----------------------------------------------------------------------------------------------

int HttpServer::answer(MHD_Connection* connection, const char* path, const char* method, const char* data,
                       std::size_t* size, void** mine) {
    if (*mine == nullptr) {
        auto request = std::make_unique<Connection>(*this, connection, method, path);
        const Head head{method, request->path_, header(connection, "Host"), header(connection, "Origin"),
                        header(connection, "Sec-Fetch-Site")};
        const Refusal why = gate_->judge(head);
        *mine = request.release();
        if (why != Refusal::none) {
            const Reply reply = refusal(why);
            MHD_Response* response = MHD_create_response_from_buffer(
                reply.body.size(), const_cast<char*>(reply.body.data()), MHD_RESPMEM_MUST_COPY);
            dress(response, reply.type);
            MHD_add_response_header(response, "Connection", "close");
            const int queued = MHD_queue_response(connection, reply.status, response);
            MHD_destroy_response(response);
            return queued;
        }
        return 1;
    }
    auto& request = *static_cast<Connection*>(*mine);
    if (*size != 0) {
        if (request.body_.size() + *size > most_body) {
            request.too_long_ = true;
            if (request.body_.size() > most_body) {
                return 0;  // goes on and on
            }
        }
        request.body_.append(data, *size);
        *size = 0;
        return 1;
    }
    return respond(connection, request);
}

int HttpServer::respond(MHD_Connection* connection, Connection& request) {
    const std::optional<Route> route = parse_route(gate_->rest(request.path_));
    Reply reply{404, Reply{}.type, "Nothing is here.\n", {}};
    MHD_Response* response = nullptr;
    if (request.too_long_) {
        reply = {413, Reply{}.type, fmt::format("At most {} bytes.\n", most_body), {}};
    } else if (route && request.post_) {
        reply = handler_.post(*route, request.body_);
    } else if (route) {
        if ((request.stream_ = handler_.stream(*route))) {
            reply = {200, "text/event-stream; charset=utf-8", {}, {}};
            streaming_.push_back(&request);
            if (streaming_.size() == 1) {
                alive_.after(sign_of_life);
            }
            response = MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, stream_block, &Callbacks::read,
                                                         &request, nullptr);
        } else {
            reply = handler_.get(*route);
        }
    }
    if (response == nullptr) {
        const std::string_view bytes = reply.fixed.empty() ? std::string_view(reply.body) : reply.fixed;
        response = MHD_create_response_from_buffer(
            bytes.size(), const_cast<char*>(bytes.data()),
            reply.fixed.empty() ? MHD_RESPMEM_MUST_COPY : MHD_RESPMEM_PERSISTENT);
    }
    if (response == nullptr) {
        return 0;
    }
    dress(response, reply.type);
    const int queued = MHD_queue_response(connection, reply.status, response);
    MHD_destroy_response(response);
    return queued;
}

}  // namespace fauxboard::panel
