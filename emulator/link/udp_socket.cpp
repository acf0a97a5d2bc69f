#include "emulator/link/udp_socket.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "emulator/link/event_loop.h"
#include "emulator/link/link.h"
#include "emulator/link/tcp_address.h"
// After event_loop.h, which see.
#include <asio/buffer.hpp>
#include <asio/ip/udp.hpp>

namespace fauxboard::link {
namespace {

using asio::ip::udp;

/// Of one turn of the event loop, so that a flood does not starve the rest.
constexpr int datagrams_per_turn = 32;

udp::endpoint resolve_udp(asio::io_context& context, const std::string& host_port) {
    const HostPort address = parse_host_port(host_port);
    asio::error_code error;
    const auto results = udp::resolver(context).resolve(address.host, std::to_string(address.port),
                                                        udp::resolver::numeric_service, error);
    if (error || results.empty()) {
        throw LinkError(fmt::format("The host \"{}\" is not known: {}.", address.host, error.message()));
    }
    return results.begin()->endpoint();
}

std::string to_text(const udp::endpoint& endpoint) {
    return format_host_port(endpoint.address().to_string(), endpoint.port());
}

/// The last senders, the most recent at the end.
class Peers {
  public:
    UdpPeer remember(const udp::endpoint& endpoint) {
        const auto found = std::find_if(known_.begin(), known_.end(),
                                        [&](const Known& known) { return known.endpoint == endpoint; });
        if (found != known_.end()) {
            std::rotate(found, found + 1, known_.end());
            return known_.back().peer;
        }
        if (known_.size() == UdpSocket::peers_limit) {
            known_.erase(known_.begin());
        }
        known_.push_back({++last_, endpoint});
        return last_;
    }
    const udp::endpoint* find(UdpPeer peer) const {
        const auto found = std::find_if(known_.begin(), known_.end(),
                                        [&](const Known& known) { return known.peer == peer; });
        return found == known_.end() ? nullptr : &found->endpoint;
    }

  private:
    struct Known {
        UdpPeer peer;
        udp::endpoint endpoint;
    };
    std::vector<Known> known_;
    UdpPeer last_ = 0;
};

class AsioUdpSocket final : public UdpSocket {
  public:
    AsioUdpSocket(asio::io_context& context, std::string host_port)
        : context_(context), host_port_(std::move(host_port)), socket_(context) {}
    ~AsioUdpSocket() override { AsioUdpSocket::close(); }

    void open(UdpListener& listener) override {
        close();
        const udp::endpoint endpoint = resolve_udp(context_, host_port_);
        asio::error_code error;
        socket_.open(endpoint.protocol(), error);
        if (!error) socket_.bind(endpoint, error);
        if (!error) socket_.non_blocking(true, error);
        if (error) {
            asio::error_code ignored;
            socket_.close(ignored);
            throw LinkError(
                fmt::format("UDP {} cannot be listened on ({}). Choose another port, or see who has it.",
                            to_text(endpoint), error.message()));
        }
        asio::error_code ignored;
        path_ = to_text(socket_.local_endpoint(ignored));
        listener_ = &listener;
        session_ = std::make_shared<char>();
        wait_readable();
    }

    void close() override {
        session_.reset();
        listener_ = nullptr;
        asio::error_code ignored;
        socket_.close(ignored);
        stats_.datagrams_lost += waiting_.size();
        waiting_.clear();
        pending_ = 0;
        writable_awaited_ = false;
    }

    void send(UdpPeer to, std::string_view bytes) override {
        if (!session_ || bytes.size() > max_datagram) {
            ++stats_.datagrams_lost;
        } else if (!waiting_.empty() || !send_now(to, bytes)) {
            keep(to, bytes);
        }
    }

    std::size_t pending() const override { return pending_; }
    const UdpStats& stats() const override { return stats_; }
    std::string path() const override { return path_.empty() ? host_port_ : path_; }
    std::string name(UdpPeer peer) const override {
        const udp::endpoint* const endpoint = peers_.find(peer);
        return endpoint == nullptr ? std::string() : to_text(*endpoint);
    }

  private:
    /// False when the system takes nothing just now; all else is done, sent or lost.
    bool send_now(UdpPeer to, std::string_view bytes) {
        const udp::endpoint* const endpoint = peers_.find(to);
        asio::error_code error = asio::error::host_not_found;
        if (endpoint != nullptr) {
            socket_.send_to(asio::buffer(bytes.data(), bytes.size()), *endpoint, 0, error);
        }
        if (error == asio::error::would_block || error == asio::error::try_again) {
            return false;
        }
        ++(error ? stats_.datagrams_lost : stats_.datagrams_out);
        return true;
    }

    void keep(UdpPeer to, std::string_view bytes) {
        if (bytes.size() > pending_limit - pending_) {
            ++stats_.datagrams_lost;
            return;
        }
        waiting_.emplace_back(to, std::string(bytes));
        pending_ += bytes.size();
        wait_writable();
    }

    template <class Handler>
    auto guarded(Handler handler) {
        return [session = std::weak_ptr<char>(session_), handler](const asio::error_code& error) {
            if (!error && !session.expired()) handler();
        };
    }

    void wait_readable() {
        socket_.async_wait(udp::socket::wait_read, guarded([this] { on_readable(); }));
    }

    void on_readable() {
        const std::weak_ptr<char> session = session_;
        for (int i = 0; i < datagrams_per_turn; ++i) {
            udp::endpoint from;
            asio::error_code error;
            const std::size_t size = socket_.receive_from(asio::buffer(buffer_), from, 0, error);
            if (error == asio::error::would_block || error == asio::error::try_again) {
                break;
            }
            if (error) {
                // Mostly that a former datagram reached nobody (ICMP): none of our business any more.
                if (error != asio::error::connection_refused && trouble(error.message(), session)) return;
                continue;
            }
            ++stats_.datagrams_in;
            listener_->on_datagram(peers_.remember(from), {buffer_.data(), size});
            if (session.expired()) {
                return;
            }
        }
        wait_readable();
    }

    /// True when the listener closed us.
    bool trouble(const std::string& why, const std::weak_ptr<char>& session) {
        listener_->on_trouble(fmt::format("UDP {}: {}", path_, why));
        return session.expired();
    }

    void wait_writable() {
        if (std::exchange(writable_awaited_, true)) {
            return;
        }
        socket_.async_wait(udp::socket::wait_write, guarded([this] {
                               writable_awaited_ = false;
                               flush();
                           }));
    }

    void flush() {
        while (!waiting_.empty() && send_now(waiting_.front().first, waiting_.front().second)) {
            pending_ -= waiting_.front().second.size();
            waiting_.pop_front();
        }
        if (!waiting_.empty()) {
            wait_writable();
        }
    }

    asio::io_context& context_;
    std::string host_port_;
    udp::socket socket_;
    UdpListener* listener_ = nullptr;
    std::shared_ptr<char> session_;  ///< lives from open() to close(); handlers hold it weakly
    std::string path_;
    Peers peers_;
    UdpStats stats_;
    std::deque<std::pair<UdpPeer, std::string>> waiting_;
    std::size_t pending_ = 0;
    bool writable_awaited_ = false;
    std::vector<char> buffer_ = std::vector<char>(max_datagram);
};

}  // namespace

std::unique_ptr<UdpSocket> make_udp_socket(asio::io_context& context, std::string host_port) {
    return std::make_unique<AsioUdpSocket>(context, std::move(host_port));
}

}  // namespace fauxboard::link
