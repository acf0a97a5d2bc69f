#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "emulator/host/live_observer.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::host {

/// Writes every line of the wire, every datagram, and what is done to the machine by hand, to a recording
/// (see recording.h), each at once, so that a kill loses none.
class Recorder final : public LiveObserver {
  public:
    static constexpr std::size_t max_waiting = 1024UL * 1024;
    /// Told once, when the recording had to end early: a full disk ends the recording, not the board.
    using OnTrouble = std::function<void(SimTime now, std::string_view sentence)>;

    /// Creates or empties `file`, or writes into a pipe that somebody reads. Throws link::HostError. What a
    /// pipe's reader does not take in time waits here, within max_waiting; the recording ends when it is
    /// more.
    explicit Recorder(std::string file, OnTrouble on_trouble);

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_datagram(SimTime now, std::uint64_t peer, bool to_board, std::string_view bytes) override;
    void on_notice(SimTime, board::Level, std::string_view) override {}
    void on_world(SimTime now, std::string_view words) override;
    void on_link(SimTime, link::LinkState, std::string_view) override {}

    std::uint64_t lines() const { return lines_; }

  private:
    void write(SimTime now, const std::string& text);
    int put(std::string_view text, std::size_t& done);
    void give_up(SimTime now, const std::string& why, std::size_t torn);

    std::string file_;
    OnTrouble on_trouble_;
    link::UniqueFd fd_;
    std::string waiting_;  ///< of a pipe whose reader is slow
    std::uint64_t lines_ = 0;
};

}  // namespace fauxboard::host
