#pragma once

#include <vector>

#include "emulator/board/board.h"
#include "emulator/fault/fault_line.h"
#include "emulator/link/link.h"

namespace fauxboard::host {

using board::SimTime;

/// Told what passes on a live board: its lines, and the link that carries them. Must not call back.
class LiveObserver : public board::Observer {
  public:
    /// See link::LinkListener::on_state.
    virtual void on_link(SimTime now, link::LinkState state, std::string_view why) = 0;
    /// A fault has acted on a line of that channel; see fault::Deed.
    virtual void on_deed(SimTime /*now*/, board::Channel /*channel*/, const fault::Deed& /*deed*/) {}
    /// A fault has been put on a line or taken off it, or one of the printer begins or is over.
    virtual void on_fault(SimTime now, std::string_view sentence) {
        on_notice(now, board::Level::info, sentence);
    }
};

/// Several observers as one, told in the order they were added.
class Observers final : public LiveObserver {
  public:
    /// `observer` outlives this.
    void add(LiveObserver& observer) { all_.push_back(&observer); }

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override {
        for (LiveObserver* each : all_)
            each->on_received(now, channel, line, verdict);
    }
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override {
        for (LiveObserver* each : all_)
            each->on_sent(now, channel, line);
    }
    void on_notice(SimTime now, board::Level level, std::string_view text) override {
        for (LiveObserver* each : all_)
            each->on_notice(now, level, text);
    }
    void on_event(SimTime now, machine::EventId event) override {
        for (LiveObserver* each : all_)
            each->on_event(now, event);
    }
    void on_datagram(SimTime now, std::uint64_t peer, bool to_board, std::string_view bytes) override {
        for (LiveObserver* each : all_)
            each->on_datagram(now, peer, to_board, bytes);
    }
    void on_world(SimTime now, std::string_view words) override {
        for (LiveObserver* each : all_)
            each->on_world(now, words);
    }
    void on_link(SimTime now, link::LinkState state, std::string_view why) override {
        for (LiveObserver* each : all_)
            each->on_link(now, state, why);
    }
    void on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) override {
        for (LiveObserver* each : all_)
            each->on_deed(now, channel, deed);
    }
    void on_fault(SimTime now, std::string_view sentence) override {
        for (LiveObserver* each : all_)
            each->on_fault(now, sentence);
    }

  private:
    std::vector<LiveObserver*> all_;
};

}  // namespace fauxboard::host
