#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "emulator/host/live_observer.h"
#include "emulator/host/log_level.h"
#include "emulator/host/plain_text.h"
#include "emulator/host/text_output.h"
#include "protocol/annotate.h"

namespace fauxboard::host {

/// How much of the line a person wants to see.
enum class Detail : std::uint8_t {
    quiet,    ///< warnings and errors
    normal,   ///< every line, notices, link states; in a flood, some of them
    verbose,  ///< all there is, debug notices and floods included
};

/// Prints the talk on the line as it passes, a line each: time in seconds, direction, bytes, words.
///
///     12.345  screen → board  N-0 M104 S200*106            nozzle: target 200 °C
///
/// On a terminal a line is as wide as that, and what is cut off ends with a mark; verbose, and everywhere
/// else, it is whole.
class LineLog final : public LiveObserver {
  public:
    /// What the main line's other end is called from here on: "screen" until told.
    void call_peer(std::string_view name) { peer_ = name; }
    /// What the board's profile says of a line, where the tables of the protocol do not; empty: nothing.
    using OwnWords = std::function<std::string(board::Channel channel, const protocol::DecodedLine& line)>;
    void ask(OwnWords own_words) { own_words_ = std::move(own_words); }
    /// What of the program's own doings is told: instead of what goes with the detail.
    void tell_own(LogLevel least) { least_ = least; }
    /// `lines_per_second` (of virtual time) is what passes for long in Detail::normal; bursts of four times
    /// as many lines do, too. Zero: no limit. Warnings have a measure of their own, and errors another: no
    /// flood of lines keeps them from being said.
    LineLog(TextOutput& out, Detail detail, double lines_per_second);

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override;
    void on_event(SimTime now, machine::EventId event) override;
    void on_link(SimTime now, link::LinkState state, std::string_view why) override;
    void on_world(SimTime now, std::string_view words) override;
    void on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) override;
    /// Says what has been left out and not been told yet.
    void finish(SimTime now);

  private:
    /// What may be said of one kind of lines, and what was not.
    struct Measure {
        double tokens = 0;
        SimTime refilled{0};
        std::uint64_t held_back = 0;
    };
    enum Kind : std::uint8_t { talk, warnings, errors };
    static constexpr std::size_t kinds = 3;

    bool passes(SimTime now, Kind kind = talk);
    void tell_held_back(SimTime now, Kind kind);
    void print(SimTime now, Ink ink, std::string_view head, std::string_view text, std::string_view words);

    std::string_view other_end(board::Channel channel) const {
        return channel == board::Channel::main ? std::string_view(peer_) : board::other_end(channel);
    }

    std::string words_of(board::Channel channel, const protocol::DecodedLine& line) const;
    /// What fits behind `column`.
    std::string fit(std::string_view text, std::size_t column) const;

    TextOutput& out_;
    Detail detail_;
    LogLevel least_;
    std::string peer_ = "screen";
    OwnWords own_words_;
    bool colours_;
    double rate_;
    double burst_;
    std::array<Measure, kinds> measures_;
};

}  // namespace fauxboard::host
