#pragma once

#include <functional>
#include <optional>
#include <string>

#include "emulator/board/board.h"
#include "emulator/control/display.h"
#include "emulator/control/error.h"
#include "emulator/fault/fault_control.h"

namespace fauxboard::control {

using board::SimTime;

/// A touch of a button: by the end of its path, the row (from 1) where it stands once for each, the number
/// typed in where it asks for one.
struct Press {
    std::string button;
    std::size_t row = 0;
    std::optional<double> input;
};

/// What a run has for people to look at beside the board: a touch screen or its mirror, the lines that were
/// said last, curves, a scenario. All in JSON as the ops of the same names answer it; null and empty where
/// there is none. Called from inside visit().
class View {
  public:
    virtual ~View() = default;
    virtual Json screen(SimTime /*now*/) { return nullptr; }
    /// {"sent": [...], "screen": ...}. Throws ControlError when the button cannot be pressed.
    virtual Json press(board::Board& board, SimTime now, const Press& press);
    virtual Json talk() { return Json::array(); }
    virtual Json curves() {
        return {{"series", Json::array()}, {"t", Json::array()}, {"values", Json::array()}};
    }
    virtual Json scenario() { return nullptr; }
    virtual Json drawing(const board::Board& /*board*/, SimTime /*now*/) { return nullptr; }
};

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
    /// Virtual time stands still but for skip(), or goes on. Called from inside visit(), or between two.
    virtual void hold(bool /*held*/) {}
    /// Ends the run, soon.
    virtual void quit() = 0;
    /// Null when this run's line has none.
    virtual fault::FaultControl* faults() = 0;
    /// What only the host knows, as members of the answer to `status`: link, speed.
    virtual Json status() const = 0;
    /// Some client has subscribed to one more topic.
    virtual void on_wanted() {}
    /// What people look at beside the board itself. The op of that name answers with what it gives; by
    /// default there is nothing of the kind.
    virtual View& view() {
        static View nothing;
        return nothing;
    }
    /// For whoever keeps a log: what a client has just had done. Called from inside visit().
    virtual void tell(SimTime /*now*/, std::string_view /*sentence*/) {}
    /// What shows the board to a person; null when nothing does.
    virtual Display* display() { return nullptr; }
};

}  // namespace fauxboard::control
