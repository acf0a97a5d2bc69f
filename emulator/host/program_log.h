#pragma once

#include <string>
#include <string_view>

#include "emulator/host/live_observer.h"
#include "emulator/host/log_file.h"
#include "emulator/host/log_level.h"

namespace fauxboard::host {

/// The program's log of its own doings, apart from the talk on the line: what was done to a board, by whom,
/// and what went wrong, a line each with the calendar's time (UTC) and the board's.
///
///     2026-11-30T21:40:12.345678Z     12.345678  info     done     motion.home
///     {"time": "2026-11-30T21:40:12.345678Z", "t": 12.345678, "level": "info", "what": "done", "text":
///     "motion.home"}
///
/// `what` is notice, link, done, fault, refused, event or program. One of several boards is named: "board".
class ProgramLog final : public LiveObserver {
  public:
    struct Style {
        LogLevel least = LogLevel::info;
        bool json = false;
        std::string board;  ///< of several; empty: there is one
    };
    /// `file` outlives this. One that is off is better not made an observer at all.
    ProgramLog(LogFile& file, Style style) : file_(file), style_(std::move(style)) {}

    /// The first line of each file of such a log.
    static std::string head(bool json);

    void say(SimTime now, LogLevel level, std::string_view what, std::string_view text);

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime, board::Channel, std::string_view) override {}
    void on_notice(SimTime now, board::Level level, std::string_view text) override;
    void on_event(SimTime now, machine::EventId event) override;
    void on_link(SimTime now, link::LinkState state, std::string_view why) override;
    void on_world(SimTime now, std::string_view words) override;
    void on_fault(SimTime now, std::string_view sentence) override;
    void on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) override;

  private:
    LogFile& file_;
    Style style_;
};

}  // namespace fauxboard::host
