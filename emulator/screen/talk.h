#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/screen/screen_profile.h"

namespace fauxboard::screen {

/// The commands of a screen that sends one at a time: which is under way, which wait, how long already, and
/// what the screen waits for beside its acknowledgement. Knows of bytes and lines only that they come.
class Talk {
  public:
    /// `rules` outlive this.
    explicit Talk(const TalkRules& rules) : rules_(rules) {}

    /// Nothing was said yet.
    void power_on(SimTime now);
    /// The board started anew: nothing is under way, nothing waits.
    void forget(SimTime now);

    /// Takes a command; those that overtake leave at once, the others in their turn. False when too many
    /// wait.
    bool queue(std::string body);
    /// Whether this very command waits for its turn, or is under way.
    bool has(std::string_view body) const;
    /// The next command to put on the line, if one may go now. `came`: bytes that came from the board so far.
    std::optional<std::string> next(SimTime now, std::uint64_t came);

    /// A line came, whatever it says.
    void heard(SimTime now) { heard_ = now; }
    /// What an acknowledgement does, as a judgement of the line that brought it.
    struct Ack {
        Verdict verdict = Verdict::ok;
        std::string why;
    };
    /// One came; it was whole with the byte of that number.
    Ack acknowledge(std::uint64_t came);
    /// What the screen waits for after this command came.
    void answered(std::string_view command);

    /// When it gives up waiting for an acknowledgement.
    SimTime timeout_due() const;
    /// It does: the command that was not answered.
    std::string give_up(SimTime now);

    /// Why the screen does not react to touches; empty when it does.
    std::string dead() const;
    /// Commands taken so far, and of them those that are over, one after the other.
    std::uint64_t taken() const { return taken_; }
    std::uint64_t over() const { return over_; }

  private:
    bool overtakes(std::string_view body) const;
    void finish();

    const TalkRules& rules_;
    std::deque<std::string> urgent_;
    std::deque<std::string> waiting_;
    std::optional<std::string> under_way_;
    std::string before_;        ///< the command before the one under way
    std::uint64_t came_ = 0;    ///< bytes that had come when it left
    SimTime heard_{0};          ///< the last line, or when it left
    std::uint64_t unowed_ = 0;  ///< acknowledgements to come that nobody waits for
    bool spoke_ = false;
    const TalkRules::Wait* wait_ = nullptr;
    bool stalled_ = false;  ///< its command is over, and what it waits for did not come
    std::uint64_t taken_ = 0;
    std::uint64_t over_ = 0;
};

}  // namespace fauxboard::screen
