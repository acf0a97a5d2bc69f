#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/behaviour/profile.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::board {

using machine::SimTime;

/// The board's schedule: slots of fixed length, round after round, each perhaps sending one frame. Keeps
/// what each slot needs to decide (rounds, values last sent); whoever turns it sends.
///
/// It needs no turning while nothing can come of it: next_due() looks ahead to the first slot that may send.
class ScheduleRunner {
  public:
    /// Stands still until power_on().
    explicit ScheduleRunner(const behaviour::Profile& profile) {
        reload(profile, SimTime{0});
        next_ = machine::never;
    }

    /// Another profile's slots and watched values; the schedule's place is kept as far as it fits. One that
    /// had no slots starts one slot's time from `now`.
    void reload(const behaviour::Profile& profile, SimTime now);
    void power_on(SimTime now);

    /// The time of the slot that comes next; `never` while frozen or without slots.
    SimTime next_slot() const { return next_; }

    /// The time of the next slot that may send. With `volatile_state`, any slot with a frame may; else those
    /// whose conditions hold as things are.
    SimTime next_due(const behaviour::Scope& scope, bool volatile_state) const;

    /// Goes over the slot that comes next. Returns the frame it sends, if any.
    const behaviour::Slot* turn(const behaviour::Scope& scope);

    /// The frame went out, for whatever reason: its watched values are those of now.
    void sent(std::size_t frame, const machine::Machine& machine) {
        if (!profile_->frames[frame].watched.empty()) {
            remember(frame, machine);
        }
    }

    /// What the machine is like counts as told, in the slots that start so.
    void take_as_told(const machine::Machine& machine);

    /// Stands still for whole rounds, or for some time.
    void lose_rounds(int rounds);
    void stall(SimTime time);

    /// While frozen the schedule stands at its slot; it goes on one slot's time after the thaw.
    bool frozen() const { return frozen_; }
    void thaw(SimTime now);

  private:
    static constexpr std::size_t no_frame = ~std::size_t{0};
    struct SlotState {
        std::uint64_t base = 0;           ///< round from which `every_rounds` counts
        std::uint64_t last_sent = 0;      ///< round + 1 in which it last sent, 0 never
        std::size_t to_frame = no_frame;  ///< slots from here to the first that has a frame: 0 this one
    };

    void remember(std::size_t frame, const machine::Machine& machine);
    bool changed(const std::vector<std::size_t>& which, std::size_t frame,
                 const machine::Machine& machine) const;
    bool conditions_hold(std::size_t index, const behaviour::Scope& scope) const;
    bool sent_this_round(std::size_t frame) const;

    const behaviour::Profile* profile_ = nullptr;
    std::vector<SlotState> slots_;
    std::vector<std::size_t> watch_from_;  ///< per frame, where its watched values start
    std::vector<double> watched_;
    std::size_t index_ = 0;
    std::uint64_t round_ = 0;
    SimTime next_ = machine::never;
    bool frozen_ = false;
};

}  // namespace fauxboard::board
