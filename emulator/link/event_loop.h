#pragma once

#include <sys/epoll.h>
#include <sys/types.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

class Timer;
class Watch;

/// Where a board, a screen or a tap waits while it runs: for descriptors (Watch), moments (Timer), signals
/// (Signals), and what was put off (post). One thread; all that is said to a loop is said on it.
///
/// Our own, since the loops of the libraries at hand arm a descriptor again for each message, or look at it a
/// second time: 1 to 2 us of the 13 that answering a screen took. Here a descriptor is armed once,
/// edge-triggered, and whoever reads it says when nothing is left.
class EventLoop {
  public:
    using Task = std::function<void()>;

    /// Throws LinkError where the system has no descriptors left.
    EventLoop();
    ~EventLoop();
    EventLoop(const EventLoop&) = delete;
    EventLoop& operator=(const EventLoop&) = delete;

    /// Calls `task` once on the next turn; tasks are called in the order in which they were posted, and
    /// before what descriptors bring. Must not throw; may be dropped uncalled when the loop ends before.
    void post(Task task) { tasks_.push_back(std::move(task)); }

    /// Takes turns until stop(), or until there is nothing to wait for.
    void run();
    /// One turn: waits until something is to do, and does all that is. False when there is nothing to wait
    /// for.
    bool run_one();
    /// The same, and waits `limit` at most.
    bool run_one_for(std::chrono::milliseconds limit);
    /// One turn without waiting. False when there was nothing to do.
    bool poll();
    /// Ends run(), and keeps it from beginning: for ever, and from the present turn on.
    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

  private:
    friend class Timer;
    friend class Watch;
    static constexpr std::size_t events_per_turn = 32;

    bool turn(int wait_ms);
    bool has_work() const;
    bool run_tasks();
    bool arm_alarm();
    bool ring_timers();
    bool call_watches();
    void queue(Watch& watch);
    void forget(Watch& watch);

    UniqueFd epoll_;
    UniqueFd alarm_;  ///< a timerfd
    std::vector<Task> tasks_;
    std::vector<Task> running_;
    std::vector<Watch*> due_;      ///< to be called on this turn, or the next one
    std::vector<Watch*> calling_;  ///< null where one was stopped meanwhile
    std::vector<Timer*> timers_;
    std::chrono::steady_clock::time_point armed_ = std::chrono::steady_clock::time_point::max();
    std::uint64_t round_ = 0;  ///< of ringing timers
    std::size_t watching_ = 0;
    bool stopped_ = false;
    std::array<epoll_event, events_per_turn> events_{};
};

/// Looks at one descriptor that is somebody else's. Its functions are called from the loop only; they may do
/// anything to this object, its end included, and must not throw.
class Watch {
  public:
    /// `on_readable`: there is something to read, or the end of the stream. Called on turn after turn until
    /// drained() is said; one read for each call leaves others their turn. `on_writable`: see
    /// await_writable().
    Watch(EventLoop& loop, std::function<void()> on_readable, std::function<void()> on_writable = {});
    ~Watch() { stop(); }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    /// Borrows `fd` (non-blocking) until stop(), which must come before it is closed. Throws LinkError when
    /// the system refuses.
    void start(int fd);
    /// Idempotent.
    void stop();
    bool active() const { return fd_ >= 0; }
    int fd() const { return fd_; }

    /// The last read found nothing (EAGAIN): `on_readable` is not called again before more comes. A read that
    /// was short may stand for one that finds nothing where reads never stop early, unless hung_up(): then
    /// the end is still to be read.
    void drained() { ready_ &= EPOLLOUT; }
    /// The other end has closed, as far as was seen.
    bool hung_up() const { return (ready_ & (EPOLLHUP | EPOLLRDHUP | EPOLLERR)) != 0; }
    /// Reading waits while `held`; a new watch is not. Costs nothing.
    void hold(bool held);
    /// One call of `on_writable`, as soon as something can be written, or never will.
    void await_writable();

  private:
    friend class EventLoop;

    bool wants_call() const { return may_read() || may_write(); }
    bool may_read() const { return !held_ && (ready_ & (EPOLLIN | EPOLLHUP | EPOLLRDHUP | EPOLLERR)) != 0; }
    bool may_write() const { return write_awaited_ && (ready_ & (EPOLLOUT | EPOLLHUP | EPOLLERR)) != 0; }
    void call_readable();
    /// `self` is null as soon as this has been stopped.
    void call_writable(Watch* const& self);
    bool arm(int operation, std::uint32_t events);

    EventLoop& loop_;
    // Shared with the loop while it calls them: they may end this object.
    std::shared_ptr<const std::function<void()>> on_readable_;
    std::shared_ptr<const std::function<void()>> on_writable_;
    int fd_ = -1;
    std::uint32_t ready_ = 0;  ///< events seen and not yet used up
    bool held_ = false;
    bool write_awaited_ = false;
    bool queued_ = false;  ///< in EventLoop::due_
};

/// Calls once at a moment of real time, never before it.
class Timer {
  public:
    using Clock = std::chrono::steady_clock;

    /// `on_ring` may do anything to this object, its end included, and must not throw.
    Timer(EventLoop& loop, std::function<void()> on_ring);
    ~Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

    /// Replaces what was asked before. A moment that is past rings on the loop's next turn.
    void at(Clock::time_point when) { when_ = when; }
    void after(Clock::duration wait) { at(Clock::now() + wait); }
    void cancel() { when_ = unset; }

  private:
    friend class EventLoop;
    static constexpr Clock::time_point unset = Clock::time_point::max();

    EventLoop& loop_;
    std::shared_ptr<const std::function<void()>> on_ring_;
    Clock::time_point when_ = unset;
    std::uint64_t round_ = 0;  ///< in which it rang last
};

/// All that asks a program to end and lets it: what it has made (a name in the file system) must go with it.
/// Left out are those by which the system says that the program itself is wrong, and those that cannot be
/// caught.
std::vector<int> ending_signals();
/// "SIGTERM"; "signal N" for one that has no name.
std::string signal_name(int number);

/// Signals as events of the loop. While this lives they do nothing else to the process but interrupt calls
/// that block; what came and was not handled until its end is swallowed. One object for a signal at a time.
class Signals {
  public:
    /// `on_signal` gets the number. Throws LinkError when the system refuses.
    Signals(EventLoop& loop, const std::vector<int>& numbers, std::function<void(int)> on_signal);
    ~Signals();
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

  private:
    struct Before {
        int number;
        struct sigaction action;
    };

    void take();

    UniqueFd out_;  ///< a pipe: what the handler tells, one byte each
    UniqueFd in_;
    std::vector<Before> before_;
    std::function<void(int)> on_signal_;
    Watch watch_;
};

}  // namespace fauxboard::link
