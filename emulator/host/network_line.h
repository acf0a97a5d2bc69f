#pragma once

#include <string>
#include <string_view>

#include "emulator/host/live_board.h"
#include "emulator/host/live_observer.h"
#include "emulator/link/udp_socket.h"

namespace fauxboard::host {

/// A live board's side of the network: what its socket hears goes to the board, and the answers back to their
/// askers. Live board and socket outlive it.
class NetworkLine final : public link::UdpListener {
  public:
    NetworkLine(LiveBoard& board, link::UdpSocket& socket, LiveObserver* observer)
        : board_(board), socket_(socket), observer_(observer) {
        board_.on_datagrams(
            [this](std::uint64_t peer, std::string_view bytes) { socket_.send(peer, bytes); });
    }
    ~NetworkLine() override { board_.on_datagrams({}); }
    NetworkLine(const NetworkLine&) = delete;
    NetworkLine& operator=(const NetworkLine&) = delete;

    void on_datagram(link::UdpPeer from, std::string_view bytes) override {
        if (from > newest_) {  // numbers go up with each that is not remembered
            newest_ = from;
            tell(board::Level::debug,
                 socket_.name(from) + " sends to the network module at " + socket_.path());
        }
        board_.visit([&](board::Board& board, SimTime now) { board.receive_datagram(now, from, bytes); });
    }
    void on_trouble(std::string_view why) override { tell(board::Level::warning, why); }

  private:
    void tell(board::Level level, std::string_view text) {
        if (observer_ != nullptr) {
            observer_->on_notice(board_.now(), level, text);
        }
    }

    LiveBoard& board_;
    link::UdpSocket& socket_;
    LiveObserver* observer_;
    link::UdpPeer newest_ = 0;
};

}  // namespace fauxboard::host
