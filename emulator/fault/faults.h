#pragma once

#include <vector>

#include "emulator/fault/fault_line.h"

namespace fauxboard::fault {

/// Both directions of one line with all its faults: what a host owns, one per link.
class Faults {
  public:
    Faults() : to_screen_(Direction::to_screen, &to_board_), to_board_(Direction::to_board, &to_screen_) {}
    Faults(const Faults&) = delete;
    Faults& operator=(const Faults&) = delete;

    /// Throws FaultSpecError when a direction it is for is full, or when it is for a printer.
    FaultId add(SimTime now, const FaultSpec& spec);
    /// The fault begins anew under its id, also in another direction. False when there is none of that id.
    /// Throws as add() does; then nothing is changed.
    bool change(SimTime now, FaultId id, const FaultSpec& spec);
    /// False when there is none of that id.
    bool remove(SimTime now, FaultId id);
    /// Removes all; what was held comes out, and a link that was down is up again.
    void clear(SimTime now);
    bool empty() const { return to_screen_.size() + to_board_.size() == 0; }
    /// By id; for faults of both directions seen and acted are sums, and over means in both. A disconnection
    /// by time alone acts once, for both directions.
    std::vector<FaultStatus> list(SimTime now) const;

    /// See FaultLine::on_deed().
    void on_deed(const std::function<void(const Deed&)>& told) {
        to_screen_.on_deed(told);
        to_board_.on_deed(told);
    }

    FaultLine& to_screen() { return to_screen_; }
    FaultLine& to_board() { return to_board_; }
    const FaultLine& to_screen() const { return to_screen_; }
    const FaultLine& to_board() const { return to_board_; }

    /// Does what is due in both directions up to `now`; both may have output then. Returns when it next wants
    /// to be called: also when the link goes down or comes back.
    SimTime advance(SimTime now);
    /// False while a disconnection lasts: the owner takes the link away, and brings it back when this is true
    /// again. Ask after each push() and advance().
    bool connected(SimTime now) const { return !to_screen_.cuts_link(now) && !to_board_.cuts_link(now); }

  private:
    void put(SimTime now, FaultId id, const FaultSpec& spec);

    FaultLine to_screen_;
    FaultLine to_board_;
    FaultId last_id_ = 0;
};

}  // namespace fauxboard::fault
