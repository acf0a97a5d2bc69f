#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "emulator/host/time_text.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::link {
class EventLoop;
}

namespace fauxboard::host {

using machine::SimTime;

class Clock;

/// Rings once at a moment of virtual time, never before it. Its clock outlives it. What it calls must not
/// throw; it may set and destroy any alarm, also this one.
class Alarm {
  public:
    Alarm(Clock& clock, std::function<void()> on_ring);
    ~Alarm();
    Alarm(const Alarm&) = delete;
    Alarm& operator=(const Alarm&) = delete;

    /// Asks for one call of on_ring at `when` (on the loop's next turn if that is past); replaces what was
    /// asked before. `machine::never` asks for none.
    void at(SimTime when);

  private:
    friend class Clock;

    Clock& clock_;
    std::shared_ptr<const std::function<void()>> on_ring_;
    SimTime when_ = machine::never;
    std::uint64_t round_ = 0;  ///< of ringing, in which it rang last
};

/// Where virtual time comes from, and the alarms that go with it. clock.cpp is the only code of the project
/// that reads the real clock, but for the event loop's timers. Alarms ring in the order of their times, of
/// equal times the one made first.
class Clock {
  public:
    Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;
    virtual ~Clock() = default;

    /// Virtual time goes on from 0 now; it is 0 until then. Alarms may be set before.
    virtual void start() = 0;
    /// Never goes back.
    SimTime now() const { return skipping_at_ != machine::never ? skipping_at_ : time(); }
    /// Not set yet. It rings from run() and skip() only.
    std::unique_ptr<Alarm> make_alarm(std::function<void()> on_ring) {
        return std::make_unique<Alarm>(*this, std::move(on_ring));
    }
    /// Makes time jump forward by `by`, which is not negative, and rings what is due on the way, each at its
    /// moment. Descriptors get no turn. Called from inside an alarm or a skip it throws std::logic_error.
    void skip(SimTime by);
    /// Held, time stands still but for skips; what is due rings all the same. Let go, it goes on from there.
    void hold(bool held);
    bool held() const { return held_; }
    /// Runs the event loop until somebody calls its stop(), or it has nothing left to wait for.
    virtual void run() = 0;

  protected:
    /// Virtual time, when nobody skips.
    virtual SimTime time() const = 0;
    /// ring_due() is to be called at `when`, or earlier; never called with an alarm ringing.
    virtual void arm(SimTime when) = 0;
    /// All time() to come is so much later.
    virtual void skipped(SimTime by) = 0;
    /// Time is held from now on, or goes on from where it is.
    virtual void hold_changed() {}

    /// Rings what is due, each alarm once: one that wants to ring again at once waits for the next round, so
    /// that others get their turn. Then arms for what comes next.
    void ring_due();
    /// When the next alarm is due.
    SimTime earliest() const;

  private:
    friend class Alarm;
    void ring_round(SimTime now);

    std::vector<Alarm*> alarms_;  ///< few: a board, its faults, a script
    std::uint64_t round_ = 0;
    bool ringing_ = false;
    bool held_ = false;
    SimTime skipping_at_ = machine::never;
};

/// Real time, scaled; or, at Speed::max, time that jumps from one alarm to the next and looks at the event
/// loop's descriptors now and then. `loop` outlives it.
std::unique_ptr<Clock> make_clock(link::EventLoop& loop, Speed speed);

/// Real time, from some moment on: for limits in real time, never for the board.
SimTime real_time();

/// What the calendar says, as time since 1970 (UTC): for files that other programs read, never for the board.
SimTime time_since_epoch();

}  // namespace fauxboard::host
