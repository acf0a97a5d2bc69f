#include "emulator/link/udp_socket.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <deque>
#include <utility>
#include <vector>

#include "emulator/link/error_text.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/inet_socket.h"
#include "emulator/link/link.h"

namespace fauxboard::link {
namespace {

/// Of one turn of the event loop, so that a flood does not starve the rest.
constexpr int datagrams_per_turn = 32;

bool not_now(int error) {
    return error == EAGAIN || error == EWOULDBLOCK;
}

/// The last senders, the most recent at the end.
class Peers {
  public:
    UdpPeer remember(const SocketAddress& address) {
        const auto found = std::find_if(known_.begin(), known_.end(),
                                        [&](const Known& known) { return known.address == address; });
        if (found != known_.end()) {
            std::rotate(found, found + 1, known_.end());
            return known_.back().peer;
        }
        if (known_.size() == UdpSocket::peers_limit) {
            known_.erase(known_.begin());
        }
        known_.push_back({++last_, address});
        return last_;
    }
    const SocketAddress* find(UdpPeer peer) const {
        const auto found = std::find_if(known_.begin(), known_.end(),
                                        [&](const Known& known) { return known.peer == peer; });
        return found == known_.end() ? nullptr : &found->address;
    }

  private:
    struct Known {
        UdpPeer peer;
        SocketAddress address;
    };
    std::vector<Known> known_;
    UdpPeer last_ = 0;
};

class LoopUdpSocket final : public UdpSocket {
  public:
    LoopUdpSocket(EventLoop& loop, std::string host_port)
        : host_port_(std::move(host_port)),
          watch_(
              loop, [this] { on_readable(); }, [this] { flush(); }) {}
    ~LoopUdpSocket() override { LoopUdpSocket::close(); }

    void open(UdpListener& listener) override {
        close();
        const SocketAddress address = resolve(host_port_, SOCK_DGRAM).front();
        UniqueFd fd = make_inet_socket(address, SOCK_DGRAM);
        if (!fd || ::bind(fd.get(), address.get(), address.size()) != 0) {
            const int error = errno;
            throw LinkError(
                fmt::format("UDP {} cannot be listened on ({}). Choose another port, or see who has it.",
                            address.text(), error_text(error)));
        }
        watch_.start(fd.get());
        fd_ = std::move(fd);
        path_ = SocketAddress::of(fd_.get()).text();
        listener_ = &listener;
        session_ = std::make_shared<char>();
    }

    void close() override {
        session_.reset();
        listener_ = nullptr;
        watch_.stop();
        fd_.reset();
        stats_.datagrams_lost += waiting_.size();
        waiting_.clear();
        pending_ = 0;
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
        const SocketAddress* const address = peers_.find(peer);
        return address == nullptr ? std::string() : address->text();
    }

  private:
    /// False when the system takes nothing just now; all else is done, sent or lost.
    bool send_now(UdpPeer to, std::string_view bytes) {
        const SocketAddress* const address = peers_.find(to);
        const bool sent = address != nullptr && ::sendto(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL,
                                                         address->get(), address->size()) >= 0;
        if (address != nullptr && !sent && not_now(errno)) {
            return false;
        }
        ++(sent ? stats_.datagrams_out : stats_.datagrams_lost);
        return true;
    }

    void keep(UdpPeer to, std::string_view bytes) {
        if (bytes.size() > pending_limit - pending_) {
            ++stats_.datagrams_lost;
            return;
        }
        waiting_.emplace_back(to, std::string(bytes));
        pending_ += bytes.size();
        watch_.await_writable();
    }

    void on_readable() {
        const std::weak_ptr<char> session = session_;
        for (int i = 0; i < datagrams_per_turn; ++i) {
            sockaddr_storage from{};
            socklen_t from_size = sizeof from;
            auto* const who = reinterpret_cast<sockaddr*>(&from);
            const ssize_t size = ::recvfrom(fd_.get(), buffer_.data(), buffer_.size(), 0, who, &from_size);
            if (size < 0 && not_now(errno)) {
                watch_.drained();
                return;
            }
            if (size < 0) {
                // Mostly that a former datagram reached nobody (ICMP): none of our business any more.
                if (errno != ECONNREFUSED && trouble(error_text(errno), session)) return;
                continue;
            }
            ++stats_.datagrams_in;
            listener_->on_datagram(peers_.remember({who, from_size}),
                                   {buffer_.data(), static_cast<std::size_t>(size)});
            if (session.expired()) {
                return;
            }
        }
    }

    /// True when the listener closed us.
    bool trouble(const std::string& why, const std::weak_ptr<char>& session) {
        listener_->on_trouble(fmt::format("UDP {}: {}", path_, why));
        return session.expired();
    }

    void flush() {
        while (!waiting_.empty() && send_now(waiting_.front().first, waiting_.front().second)) {
            pending_ -= waiting_.front().second.size();
            waiting_.pop_front();
        }
        if (!waiting_.empty()) {
            watch_.await_writable();
        }
    }

    std::string host_port_;
    UniqueFd fd_;
    Watch watch_;
    UdpListener* listener_ = nullptr;
    std::shared_ptr<char> session_;  ///< lives from open() to close(): tells when the listener closed us
    std::string path_;
    Peers peers_;
    UdpStats stats_;
    std::deque<std::pair<UdpPeer, std::string>> waiting_;
    std::size_t pending_ = 0;
    std::vector<char> buffer_ = std::vector<char>(max_datagram);
};

}  // namespace

std::unique_ptr<UdpSocket> make_udp_socket(EventLoop& loop, std::string host_port) {
    return std::make_unique<LoopUdpSocket>(loop, std::move(host_port));
}

}  // namespace fauxboard::link
