#pragma once

#include "emulator/behaviour/actions.h"
#include "emulator/machine/events.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::board {

/// What a board has built in besides its lines, and what acts on the machine as the board's own program does:
/// a touch screen of its own. Called by the board, in the board's time; times never go back. Nothing here is
/// called while the board's program hangs.
class Front {
  public:
    virtual ~Front() = default;
    /// The board was switched on, or reset.
    virtual void power_on(machine::SimTime now, behaviour::ActionContext& context) = 0;
    /// Something happened to the machine; the profile's rules for it have been carried out.
    virtual void on_event(machine::SimTime now, machine::EventId event,
                          behaviour::ActionContext& context) = 0;
    /// When it wants to be called next; machine::never: not before something happens.
    virtual machine::SimTime next_due(const machine::Machine& machine) const = 0;
    /// Does what is due; next_due() is later than `now` from then on.
    virtual void advance(machine::SimTime now, behaviour::ActionContext& context) = 0;
};

}  // namespace fauxboard::board
