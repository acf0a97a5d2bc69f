#pragma once

#include <functional>
#include <map>
#include <string>

#include "emulator/fault/fault_control.h"
#include "emulator/host/live_observer.h"

namespace fauxboard::host {

/// Tells when a fault of the printer begins and is over, and when one of a line is put on it and taken off
/// it: by the command line, a client, a scenario or a time of its own. Looks whenever something passes, so
/// that a board without faults pays nothing for it.
class FaultWatch final : public LiveObserver {
  public:
    using Say = std::function<void(const std::string& sentence)>;
    /// Asks for a look() at that time, with the board brought up to it; machine::never for none.
    using Wake = std::function<void(SimTime when)>;

    /// Both outlive this. `say` may tell the very observers that this is one of.
    FaultWatch(const board::Board& board, const fault::FaultControl& lines, Say say, Wake wake = {})
        : board_(board), lines_(lines), say_(std::move(say)), wake_(std::move(wake)) {}

    /// Says what has changed since the last look.
    void look();

    void on_received(SimTime, board::Channel, std::string_view, board::Verdict) override { look(); }
    void on_sent(SimTime, board::Channel, std::string_view) override { look(); }
    void on_notice(SimTime, board::Level, std::string_view) override { look(); }
    void on_event(SimTime, machine::EventId) override { look(); }
    void on_link(SimTime, link::LinkState, std::string_view) override { look(); }

  private:
    struct Known {
        std::string words;  ///< "fault 1, drop:to_screen,every=2,"
        bool seen = true;   ///< in the look under way
    };
    void see(const std::string& id, const std::string& words, const char* begins);

    const board::Board& board_;
    const fault::FaultControl& lines_;
    Say say_;
    Wake wake_;
    std::map<std::string, Known> known_;  ///< those in force, by id
    bool looking_ = false;
};

}  // namespace fauxboard::host
