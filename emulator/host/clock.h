#pragma once

#include <functional>
#include <memory>

#include "emulator/host/time_text.h"
#include "emulator/printer/sim_time.h"

namespace asio {
class io_context;
}

namespace fauxboard::host {

using printer::SimTime;

/// Where virtual time comes from, and the alarm that goes with it. clock.cpp is the only code of the project
/// that reads the real clock.
class Clock {
  public:
    Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;
    virtual ~Clock() = default;

    /// Virtual time goes on from 0 now. `on_wake` is called from run() only.
    virtual void start(std::function<void()> on_wake) = 0;
    /// Never goes back.
    virtual SimTime now() const = 0;
    /// Asks for one call of on_wake at `when` (at once if that is past); replaces what was asked before. It
    /// may come too early: ask again then. `printer::never` asks for none.
    virtual void wake_at(SimTime when) = 0;
    /// Runs the event loop until somebody calls its stop(), or it has nothing left to wait for.
    virtual void run() = 0;
};

/// Real time, scaled; or, at Speed::max, time that jumps from one alarm to the next and looks at the event
/// loop's descriptors now and then. `context` outlives it.
std::unique_ptr<Clock> make_clock(asio::io_context& context, Speed speed);

/// What the calendar says, as time since 1970 (UTC): for files that other programs read, never for the board.
SimTime time_since_epoch();

}  // namespace fauxboard::host
