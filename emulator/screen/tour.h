#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/screen/listener.h"
#include "emulator/screen/screen.h"

namespace fauxboard::screen {

enum class TourVerdict : std::uint8_t {
    met,         ///< what the screen expects came back
    not_met,     ///< something else came, or nothing, or something where nothing must come
    not_pressed  ///< the button could not be reached
};

/// "met", "not met", "not pressed".
std::string_view tour_verdict_words(TourVerdict verdict);

/// What came of one button.
struct TourResult {
    std::string button;                 ///< its path
    std::vector<std::string> sent;      ///< bodies
    std::vector<std::string> expected;  ///< in words; "silence" alone
    std::vector<std::string> came;      ///< bodies, without what the board sends by itself
    TourVerdict verdict = TourVerdict::not_pressed;
    SimTime at{0};    ///< when it was touched
    SimTime took{0};  ///< from then to the verdict
    std::string sentence;
};

/// Presses every button of a screen's profile once, page by page in the order of the profile, and checks what
/// comes back against what the profile says the screen expects. Of a button with rows it presses the first
/// row that fits. Pages that open only by themselves are opened by showing the screen the frame that opens
/// them, and preparations are done before (homing before moving, heating before loading). Nothing is skipped
/// without a result that says so.
///
/// Sans-I/O: drive it instead of the screen, which must be switched on already: advance(now), take the
/// screen's output to the board, give what the board says to the screen's receive(); until done().
class Tour {
  public:
    /// `slack`: so much later than the profile's limit a reply may come, for a line whose own delays do not
    /// shrink with virtual time. It makes no passing tour longer.
    explicit Tour(Screen& screen, SimTime slack = SimTime{0});
    /// Not the whole tour, but these buttons, in this order, as a person would press them: no preparations,
    /// no frames shown to the screen, no waiting for the machine. Ends at the first that cannot be pressed.
    Tour(Screen& screen, std::vector<std::string> paths, SimTime slack);

    /// Advances the screen and the tour. The contract of Screen::advance().
    SimTime advance(SimTime now);
    bool done() const { return next_ == order_.size() && goals_.empty(); }
    const std::vector<TourResult>& results() const { return results_; }
    bool passed() const;
    /// Buttons there are to press.
    std::size_t total() const { return order_.size(); }

  private:
    enum class Phase : std::uint8_t { preparing, walking, listening_on_the_way, listening, settling };

    /// A button on its way to being pressed; a preparation puts another one on top of it.
    struct Goal {
        std::size_t button = 0;
        std::size_t row = 0;
        std::optional<double> input;
        bool recorded = false;
        Phase phase = Phase::preparing;
        std::vector<const Prepare*> steps;
        std::size_t prepared = 0;  ///< of them, done
        std::size_t shown = 0;     ///< frames shown to the screen to open the page
        unsigned touches = 0;
        std::string remark;  ///< what the result should mention
        TourResult result;
    };

    SimTime due() const { return wake_ < hold_ ? hold_ : wake_; }
    bool step();
    void start_next();
    void start_press(Goal& goal, const std::string& path);
    void name(Goal& goal) const;
    bool prepare(Goal& goal);
    bool walk(Goal& goal);
    bool touch_on_the_way(Goal& goal, const Step& step);
    bool touch(Goal& goal);
    bool listen(Goal& goal);
    void wait_for_lines();
    bool show_frame(std::string_view body);
    void give_up(Goal& goal, const std::string& why);
    void finish(Goal& goal);
    void collect();

    Screen& screen_;
    SimTime slack_;
    std::vector<std::string> paths_;  ///< as a person wrote them; empty: the tour
    std::vector<std::size_t> order_;
    std::size_t next_ = 0;
    std::vector<Goal> goals_;
    Listener listener_;
    SimTime hold_{0};               ///< nothing is done before, whatever comes
    SimTime wake_{0};               ///< nothing is done before, unless a line comes
    std::optional<SimTime> limit_;  ///< of a wait for a value
    std::uint64_t seen_ = 0;        ///< lines judged so far
    std::uint64_t timeouts_ = 0;    ///< of the screen so far
    SimTime last_touch_;            ///< of any button; at first, when the tour began
    std::vector<TourResult> results_;
};

}  // namespace fauxboard::screen
