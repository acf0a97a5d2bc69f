#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "emulator/board/board.h"
#include "emulator/host/clock.h"
#include "emulator/host/live_observer.h"
#include "emulator/link/link.h"

namespace fauxboard::host {

/// A board on a link in real (or jumping) time: hands bytes and time to the board, and its output to the
/// link. The printer goes on while nobody is at the other end. Everything happens on the event loop's thread.
class LiveBoard final : public link::LinkListener {
  public:
    /// All must outlive this object, which ends by stop() or by `link` being closed. `observer` may be null.
    LiveBoard(board::Board& board, link::Link& link, Clock& clock, LiveObserver* observer);

    /// Switches the board on and starts the clock; the link is open. After `duration` of virtual time
    /// `on_end` is called, once; `printer::never` for no end.
    void start(SimTime duration, std::function<void()> on_end);
    /// Puts a changed profile in force.
    void reload(std::shared_ptr<const behaviour::Profile> profile);
    /// Calls `use` with the board brought up to now, and sees to what comes of it: output, alarms. Not to be
    /// called from inside a call of the board or of `use`.
    void visit(const std::function<void(board::Board& board, SimTime now)>& use);
    /// Somebody who watches the machine: called from the event loop when the time that it last returned has
    /// come, and soon after each visit(), with the board and its machine brought up to that time. Set before
    /// start().
    void follow(std::function<SimTime(SimTime now)> follower) { follower_ = std::move(follower); }
    /// Where the board's datagrams go: called with whom each is for; nothing drops them.
    void on_datagrams(std::function<void(std::uint64_t peer, std::string_view bytes)> sender) {
        datagram_sender_ = std::move(sender);
    }
    /// Virtual time, no later than the end.
    SimTime now() const;

    void on_bytes(std::string_view bytes) override;
    void on_state(link::LinkState state, std::string_view why) override;

  private:
    void wake();
    void catch_up(SimTime now);
    void settle(SimTime now);
    void show(SimTime now);
    void send_output();

    board::Board& board_;
    link::Link& link_;
    Clock& clock_;
    std::unique_ptr<Alarm> alarm_;
    LiveObserver* observer_;
    std::function<void()> on_end_;
    std::function<SimTime(SimTime)> follower_;
    std::function<void(std::uint64_t, std::string_view)> datagram_sender_;
    SimTime end_{0};
    SimTime due_{0};                    ///< what the board's last advance() returned
    SimTime show_due_{printer::never};  ///< what the follower last returned
    bool running_ = false;
};

}  // namespace fauxboard::host
