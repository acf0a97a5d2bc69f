#pragma once

#include <cstdint>
#include <string>

#include "emulator/host/line_log.h"
#include "emulator/host/live_observer.h"
#include "emulator/host/text_output.h"

namespace fauxboard::host {

/// The same as LineLog for a program: JSON lines, all of them.
///
///     {"t": 12.345678, "from": "screen", "line": "N-0 M104 S200*106", "words": "..."}
///     {"t": 12.350000, "from": "screen", "line": "M104", "words": "...", "refused": "bad frame"}
///     {"t": 12.395678, "from": "board", "line": "...", "words": "..."}
///     {"t": 12.400000, "notice": "M999 is not in the profile; ignored", "level": "warning"}
///     {"t": 13.000000, "link": "waiting", "why": "the other side closed /dev/pts/5"}
///     {"t": 13.500000, "done": "filament.remove"}             by a client, a scenario
///     {"t": 13.600000, "fault": 1, "kind": "drop", "from": "board", "line": "..."}   what a fault did to a
///     line
///     {"t": 14.000000, "left_out": 12}        what nobody took in time, before this
class JsonLog final : public LiveObserver {
  public:
    explicit JsonLog(TextOutput& out) : out_(out) {}
    /// See LineLog::ask().
    void ask(LineLog::OwnWords own_words) { own_words_ = std::move(own_words); }

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override;
    void on_link(SimTime now, link::LinkState state, std::string_view why) override;
    void on_world(SimTime now, std::string_view words) override;
    void on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) override;

  private:
    void write(SimTime now, std::string_view members);

    std::string line_members(board::Channel channel, std::string_view from, std::string_view line,
                             protocol::Direction direction) const;

    TextOutput& out_;
    LineLog::OwnWords own_words_;
    std::uint64_t told_left_out_ = 0;
};

}  // namespace fauxboard::host
