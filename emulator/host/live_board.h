#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

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
    /// `on_end` is called, once; `machine::never` for no end.
    void start(SimTime duration, std::function<void()> on_end);
    /// Puts a changed profile in force.
    void reload(std::shared_ptr<const behaviour::Profile> profile);
    /// Calls `use` with the board brought up to now, and sees to what comes of it: output, alarms. Not to be
    /// called from inside a call of the board or of `use`.
    void visit(const std::function<void(board::Board& board, SimTime now)>& use);
    /// Somebody who watches the machine: called from the event loop when the time that it last returned has
    /// come, first at power-on, and soon after each visit(), with the board and its machine brought up to
    /// that time. Set before start().
    void follow(std::function<SimTime(SimTime now)> follower) {
        follower_ = std::move(follower);
        show_due_ = follower_ ? SimTime{0} : machine::never;
    }
    /// Where the board's datagrams go: called with whom each is for; nothing drops them.
    void on_datagrams(std::function<void(std::uint64_t peer, std::string_view bytes)> sender) {
        datagram_sender_ = std::move(sender);
    }
    /// Virtual time, no later than the end.
    SimTime now() const;

    /// Puts one more of the board's lines on a link, which must outlive this object. The listener to open it
    /// with; before start().
    link::LinkListener& attach(board::Channel channel, link::Link& link);

    void on_bytes(std::string_view bytes) override { take(board::Channel::main, bytes); }
    void on_state(link::LinkState state, std::string_view why) override;

  private:
    /// A line of the board beside the main one.
    class SideLine final : public link::LinkListener {
      public:
        SideLine(LiveBoard& board, board::Channel channel, link::Link& link)
            : board_(board), channel_(channel), link_(link) {}
        void on_bytes(std::string_view bytes) override { board_.take(channel_, bytes); }
        void on_state(link::LinkState state, std::string_view why) override { board_.on_state(state, why); }
        void send_output() {
            if (const std::string_view output = board_.board_.output(channel_); !output.empty()) {
                link_.write(output);
            }
            if (const bool crowded = board_.board_.crowded(channel_); crowded != held_) {
                held_ = crowded;
                link_.hold(held_);
            }
        }

      private:
        LiveBoard& board_;
        board::Channel channel_;
        link::Link& link_;
        bool held_ = false;  ///< its sender waits until there is room
    };

    void take(board::Channel channel, std::string_view bytes);
    void wake();
    void catch_up(SimTime now);
    void settle(SimTime now);
    void show(SimTime now);
    void send_output();

    board::Board& board_;
    link::Link& link_;
    std::vector<std::unique_ptr<SideLine>> side_lines_;
    Clock& clock_;
    std::unique_ptr<Alarm> alarm_;
    LiveObserver* observer_;
    std::function<void()> on_end_;
    std::function<SimTime(SimTime)> follower_;
    std::function<void(std::uint64_t, std::string_view)> datagram_sender_;
    SimTime end_{0};
    SimTime due_{0};                    ///< what the board's last advance() returned
    SimTime show_due_{machine::never};  ///< what the follower last returned
    bool held_ = false;                 ///< the sender of the main line waits until there is room
    bool running_ = false;
};

}  // namespace fauxboard::host
