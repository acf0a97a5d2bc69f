#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "emulator/host/live_observer.h"
#include "emulator/link/output_file.h"

namespace fauxboard::host {

/// Writes every line of the wire, every datagram, what is done to the machine by hand, and what faults do, to
/// a recording (see recording.h), each at once, so that a kill loses none.
class Recorder final : public LiveObserver {
  public:
    /// Told once, when the recording had to end early: a full disk ends the recording, not the board.
    using OnTrouble = std::function<void(SimTime now, std::string_view sentence)>;

    /// Throws link::HostError: see link::OutputFile.
    explicit Recorder(std::string file, OnTrouble on_trouble);

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_datagram(SimTime now, std::uint64_t peer, bool to_board, std::string_view bytes) override;
    void on_notice(SimTime, board::Level, std::string_view) override {}
    void on_world(SimTime now, std::string_view words) override;
    void on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) override;
    void on_fault(SimTime now, std::string_view sentence) override;
    void on_link(SimTime, link::LinkState, std::string_view) override {}

    /// No more comes; what a slow reader has not taken by now it may lose, which is told.
    void finish(SimTime now);
    std::uint64_t lines() const { return out_.pieces(); }

  private:
    void write(SimTime now, const std::string& text);

    std::string file_;
    OnTrouble on_trouble_;
    link::OutputFile out_;
};

}  // namespace fauxboard::host
