#pragma once

#include <string>
#include <vector>

#include "emulator/screen/screen.h"

namespace fauxboard::screen {

/// What must come back after a touch, and what did.
class Listener {
  public:
    /// What pressing the button will have to bring: its own expectations and those of the page it opens, with
    /// the values as they are before the touch.
    void expect(const Screen& screen, const Button& button, std::size_t row, std::optional<double> input);
    /// Nothing was sent, so nothing must come.
    void expect_silence() { wanted_.clear(); }
    /// The commands that the screen has taken up to now must be acknowledged, of a screen that waits for
    /// that.
    void expect_acknowledged(const Screen& screen);
    /// The clock of all limits starts.
    void start(SimTime now) { start_ = now; }
    /// What must come may be so much later than its limit.
    void set_slack(SimTime slack) { slack_ = slack; }

    /// Time has passed without a line.
    void look(const Screen& screen);
    void take(const Screen& screen, const Judgement& judgement);

    enum class State : std::uint8_t { waiting, met, failed };
    State state(SimTime now) const;
    /// When state() may change without a line.
    SimTime deadline() const;
    SimTime started() const { return start_; }

    std::vector<std::string> expected_words() const;
    /// What came, but for what the board sends by itself.
    const std::vector<std::string>& came() const { return came_; }
    /// "L24 with babystep within 0.5 s" of those that did not come; "silence".
    std::string missing_words() const;

  private:
    struct Wanted {
        Expectation what;
        std::string words;
        bool came = false;
        std::uint64_t over = 0;  ///< not 0: not a line, but so many commands of the screen's are over
    };

    static std::string describe(const Screen& screen, const Expectation& what);
    static bool matches(const Screen& screen, const Expectation& what, const Judgement& judgement,
                        std::string_view body);

    std::vector<Wanted> wanted_;
    std::vector<std::string> came_;
    bool timed_out_ = false;      ///< the screen gave up waiting for an acknowledgement
    std::uint64_t timeouts_ = 0;  ///< of the screen, before the touch
    bool disturbed_ = false;      ///< something came that was neither asked for nor known to come by itself
    SimTime silence_{0};
    SimTime start_{0};
    SimTime slack_{0};
};

}  // namespace fauxboard::screen
