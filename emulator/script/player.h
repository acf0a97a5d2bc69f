#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/script/outcome.h"
#include "emulator/script/scenario.h"
#include "emulator/script/stage.h"
#include "emulator/script/steps.h"

namespace fauxboard::script {

/// Plays a scenario on a stage. No clock, no I/O, no threads: both times are arguments.
///
/// Use: hand it everything that passes on the board (it is an observer of it), and call advance() when the
/// time it returned has come and, at the same virtual time, after anything has passed; until done(). Same
/// scenario, board and times give the same run.
class Player final : public board::Observer {
  public:
    /// `real_per_virtual`: real seconds that a virtual one takes at the speed of the run, 0 when it does not
    /// wait; the limits in real time of steps that give none are made of it.
    Player(std::shared_ptr<const Scenario> scenario, double real_per_virtual);
    ~Player() override;

    /// Does what is due at `now`; `real` is time by the clock on the wall since the run began. Returns when
    /// it wants to be called next, machine::never when not before something passes or it is done.
    SimTime advance(SimTime now, SimTime real, Stage& stage);
    /// Ends it before its time: `why` is "by SIGTERM", "by --duration".
    void interrupt(SimTime now, std::string_view why);
    bool done() const { return outcome_.has_value(); }
    /// Valid when done().
    const Outcome& outcome() const { return *outcome_; }
    const Scenario& scenario() const { return *scenario_; }
    /// What came of the outermost steps so far; the one under way is the number running().
    const std::vector<StepResult>& results() const { return outcome_ ? outcome_->results : results_; }
    std::size_t running() const { return main_; }
    /// A branch, and what it waits for.
    struct Waiting {
        std::string branch;
        std::string words;
        SimTime since{0};
    };
    std::vector<Waiting> waiting() const;
    /// Something has passed that advance() has not seen yet.
    bool wants_turn() const { return !passed_.empty(); }

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime, board::Level, std::string_view) override {}
    void on_event(SimTime now, machine::EventId event) override;

  private:
    /// What has passed and is still to be seen by those who wait.
    struct Passed {
        Trigger::Kind kind;
        SimTime at;
        std::string text;  ///< without frame and checksum
        machine::EventId event{};
    };
    /// Where a branch is in one of the blocks it has entered.
    struct Level {
        const Block* block = nullptr;
        const Step* owner = nullptr;  ///< the step whose block it is; null for the scenario's own
        std::size_t next = 0;
        std::uint64_t rounds_done = 0;
    };
    /// What is under way: its next step, or what it waits for.
    struct Branch {
        std::string name;
        std::vector<Level> levels;
        const Step* watching = nullptr;
        std::unique_ptr<Step> made;  ///< a dynamic step with its values
        SimTime began{0};
        SimTime real_began{0};
        Branch* parent = nullptr;
        const Step* together = nullptr;  ///< waits for its children
        std::size_t children = 0;
        bool over = false;
    };

    void keep_talk(SimTime now, Talk::From from, std::string_view text);
    void push(Passed passed);
    void see_all();
    void run(Branch& branch);
    void begin(Branch& branch, const Step& written);
    const Step* fill_in(Branch& branch, const Step& step);
    void enter(Branch& branch, const Step& step);
    void leave_level(Branch& branch);
    void end_branch(Branch& branch);
    void cancel(Branch& parent);
    void go_on(Branch& branch);
    void check(Branch& branch);
    void in_vain(Branch& branch, const Step& step, const std::string& time);
    bool see(Branch& branch, const Passed& passed);
    bool holds(const Trigger& trigger);
    Json look() const;
    std::string page_shown() const;
    std::string text_shown() const;
    void guard(const Passed& passed);
    void guard_states();
    SimTime real_limit(const Step& step) const;
    SimTime next_due() const;
    void main_step(std::size_t index);
    std::string explain(const Trigger& trigger) const;
    void fail(const Branch* branch, const Step& step, Outcome::Verdict verdict, const std::string& what);
    void finish(Outcome::Verdict verdict, std::string sentence);

    std::shared_ptr<const Scenario> scenario_;
    double real_per_virtual_;
    std::vector<std::unique_ptr<Branch>> branches_;  ///< in the order in which they were made
    std::deque<Passed> passed_;
    std::deque<Talk> talk_;  ///< the last of it
    std::map<std::string, MadeFault, std::less<>> faults_;
    Captures captures_;
    std::vector<StepResult> results_;
    std::optional<Outcome> outcome_;
    SimTime now_{0};
    SimTime real_{0};
    SimTime turn_{-1};            ///< virtual time of the last step
    std::size_t turn_steps_ = 0;  ///< steps since time last passed
    std::size_t steps_done_ = 0;
    std::size_t main_ = static_cast<std::size_t>(-1);  ///< outermost step under way
    std::optional<Where> where_;
    Stage* stage_ = nullptr;  ///< while advance() lasts
    bool overflow_ = false;
    bool started_ = false;
};

}  // namespace fauxboard::script
