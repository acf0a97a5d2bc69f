#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/screen/frame_reader.h"
#include "emulator/screen/judgement.h"
#include "emulator/screen/line_intake.h"
#include "emulator/screen/navigation.h"
#include "emulator/screen/screen_profile.h"
#include "emulator/screen/talk.h"

namespace fauxboard::screen {

/// What came of a touch, or of a walk through the pages to one.
struct PressResult {
    bool pressed = false;
    std::string sentence;           ///< why not, with the nearest names or the candidates; empty when pressed
    std::vector<std::string> sent;  ///< the bodies sent, in order, those on the way there included
    std::size_t button = 0;         ///< what the path meant, when pressed
};

/// Everything that was counted since the screen was made.
struct ScreenCounters {
    std::uint64_t lines_received = 0;
    std::array<std::uint64_t, verdict_count> verdicts{};  ///< of them, by Verdict
    std::uint64_t lines_sent = 0;
    std::uint64_t bytes_lost = 0;     ///< came while the buffer was full
    std::uint64_t bytes_unheard = 0;  ///< came while the screen was starting or off
    std::uint64_t output_lost = 0;    ///< bytes nobody took in time
    std::uint64_t crashes = 0;
    std::uint64_t restarts = 0;  ///< because the board asked for it
    std::uint64_t timeouts = 0;  ///< commands whose acknowledgement it did not wait for any longer
};

/// One virtual touch screen: bytes in, bytes out, time in. No clock, no I/O, no threads; many screens may
/// share a profile. Used as a board is: power_on(), advance() when the time it returned has come, receive()
/// when bytes come; after each call take output(). Times never go back.
///
/// Every line it receives is judged as the real screen would take it. A line on which that one would crash
/// makes this one start anew, as there; the findings and counters stay.
class Screen {
  public:
    explicit Screen(std::shared_ptr<const ScreenProfile> profile);

    /// Switches the screen on, or resets it: values, page and line are as new.
    void power_on(SimTime now);
    /// Bytes from the board. Lost while the screen is off or starting.
    void receive(SimTime now, std::string_view bytes);
    /// Does what is due up to `now`, but stops as soon as there is output. Returns when it wants to be called
    /// next (machine::never: not before something comes), which may be in the past if it stopped early.
    SimTime advance(SimTime now);
    /// Bytes for the board, since the last clear_output().
    std::string_view output() const { return output_; }
    void clear_output() { output_.clear(); }
    /// The moment of the last thing done.
    SimTime time() const { return time_; }
    /// So many bytes may be received now, in one go, and none of them will be lost.
    std::size_t room() const { return intake_.room(); }
    /// Switched on and past its start: it hears and can be touched.
    bool ready() const { return on_ && !hello_due_; }

    /// Touches the button that `path` means (see resolve()), from wherever the screen stands: the pages on
    /// the way are opened by touch as well, with all they send.
    PressResult press(std::string_view path, SimTime now);
    /// The same with the row and the number typed in beside the path, which count on the open page.
    PressResult press(std::string_view path, std::size_t row, std::optional<double> input, SimTime now);
    /// Touches one button of the page that is open. `row` as in Step, `input` the number typed in.
    PressResult touch(std::size_t button, std::size_t row, std::optional<double> input, SimTime now);

    /// Touches the screen where no button is: it does not fall back to another page for a while.
    void touch_beside(SimTime now) {
        catch_up(now);
        touched_ = time_;
    }

    /// The open page as a person would see it: title, values, buttons ("(Home)" is a button that stays shut
    /// now). UTF-8, lines of at most some 78 columns, stable.
    std::string show() const { return show_page(page_); }
    /// Another page with the values it would show now; a sentence when there is none of that path.
    std::string show(std::string_view page) const;

    const ScreenProfile& profile() const { return *profile_; }
    const Page& page() const { return profile_->pages[page_]; }
    Standpoint standpoint() const { return {*profile_, values_, page_, before_}; }
    const std::vector<Shown>& values() const { return values_; }
    /// A value as text: numbers as short as they go, lists a line each. Nothing for an unknown name.
    std::optional<std::string> get(std::string_view name) const;
    /// A number, or nothing.
    std::optional<double> number(std::string_view name) const;

    /// The last lines judged, oldest first; at most 512.
    const std::deque<Judgement>& judgements() const { return judgements_; }
    /// Every kind of line that was not ok, in the order in which they came; at most 256 kinds.
    const std::vector<Finding>& findings() const { return findings_; }
    const ScreenCounters& counters() const { return counters_; }
    /// The commands under way and waiting, of a screen that sends one at a time.
    const Talk& talk() const { return talk_; }

  private:
    void restart(SimTime now);
    void step(SimTime due);
    void catch_up(SimTime now);
    SimTime next_due() const;
    SimTime idle_due() const;
    void drain();
    void take(const IntakeLine& line);
    void act_on(const Taken& taken);
    void act_on(const FrameCase& how);
    void record(Judgement judgement);
    void open(std::size_t page);
    void assume(const std::vector<Assign>& assigns, const Scope& scope) {
        assign(assigns, profile_->values, scope, values_);
    }
    void tell_page();
    void talk_on();
    void poll();
    void give_up();
    SimTime talk_due() const;
    void acknowledge(Judgement& judgement, std::uint64_t came);
    void send_all(const std::vector<const Send*>& sends, const Scope& scope);
    void send(std::string body);
    void write(std::string_view body);
    void put(std::string_view bytes);
    std::string show_page(std::size_t page) const;

    struct Answer {
        SimTime at{0};
        std::string body;
    };

    std::shared_ptr<const ScreenProfile> profile_;
    LineIntake intake_;
    Talk talk_;
    std::vector<SimTime> polls_due_;
    bool jammed_ = false;  ///< it never reads again
    std::vector<Shown> values_;
    std::size_t page_ = 0;
    std::size_t before_ = 0;
    bool on_ = false;
    bool hello_due_ = false;
    SimTime time_{0};
    SimTime power_on_{0};
    SimTime touched_{0};
    std::deque<Answer> answers_;
    std::string output_;
    std::vector<std::string> sent_;  ///< by the touch under way
    std::deque<Judgement> judgements_;
    std::vector<Finding> findings_;
    ScreenCounters counters_;
};

}  // namespace fauxboard::screen
