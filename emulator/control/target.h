#pragma once

#include <functional>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/control/display.h"
#include "emulator/control/error.h"
#include "emulator/fault/fault_control.h"

namespace fauxboard::control {

using board::SimTime;

/// The running board that a control channel reaches into, and what its host can do with it.
class Target {
  public:
    virtual ~Target() = default;

    /// For reading, at any time.
    virtual const board::Board& board() const = 0;
    /// Calls `use` once, at once, with the board brought up to now; what comes of it (output, alarms) is seen
    /// to afterwards; Hub::on_moved() is asked soon, but not before this returns. Not to be called from
    /// inside `use`.
    virtual void visit(const std::function<void(board::Board& board, SimTime now)>& use) = 0;
    /// Makes virtual time jump forward by `by`, 1 us or more, once this request is through. Returns the time
    /// at which that is done; Hub::on_moved() hears of it. Called from inside visit().
    virtual SimTime skip(SimTime by) = 0;
    /// Ends the run, soon.
    virtual void quit() = 0;
    /// Null when this run's line has none.
    virtual fault::FaultControl* faults() = 0;
    /// What only the host knows, as members of the answer to `status`: link, speed.
    virtual Json status() const = 0;
    /// What shows the board to a person; null when nothing does.
    virtual Display* display() { return nullptr; }
};

}  // namespace fauxboard::control
