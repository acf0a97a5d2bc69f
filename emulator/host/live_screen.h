#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/host/clock.h"
#include "emulator/host/live_observer.h"
#include "emulator/link/link.h"
#include "emulator/screen/tour.h"
#include "protocol/framing.h"

namespace fauxboard::host {

/// Who presses the buttons of a live screen, or watches it. Called from the event loop.
class ScreenUser {
  public:
    virtual ~ScreenUser() = default;
    /// All that was due has been done. Returns when it wants to be called again at the latest (time of the
    /// screen; machine::never: only if something happens). May touch the screen.
    virtual SimTime on_turn(SimTime now) = 0;
    /// The screen has taken a line.
    virtual void on_judged(const screen::Judgement& judgement) = 0;
    /// See link::LinkListener::on_state.
    virtual void on_link(link::LinkState state, std::string_view why) = 0;
};

/// A virtual touch screen on a link in real time. It was switched on just so long before the line opened
/// that it hears from the first byte on.
///
/// What the system hands over at once has come over the line one after the other: the screen gets no more of
/// it between two looks into its buffer than that holds.
class LiveScreen final : public link::LinkListener {
  public:
    /// All must outlive this object; `observer` and `user` may be null. The link is opened by the caller,
    /// with this as its listener, and start() called then.
    LiveScreen(screen::Screen& screen, link::Link& link, Clock& clock, LiveObserver* observer,
               ScreenUser* user);

    /// Starts the clock and says the screen's hello.
    void start();
    /// Lets a tour press the buttons from now on; null: nobody does. The tour outlives that.
    void lead(screen::Tour* tour);
    /// As Screen::press() and Screen::touch(), now.
    screen::PressResult press(std::string_view path, std::size_t row = 0, std::optional<double> input = {});
    screen::PressResult touch(std::size_t button, std::size_t row, std::optional<double> input);

    /// Time of the screen.
    SimTime now() const { return head_start_ + clock_.now(); }
    /// The same since the line opened, as it stands in logs and recordings.
    SimTime line_time(SimTime at) const { return at - head_start_; }
    /// When the line opened.
    SimTime line_start() const { return head_start_; }
    /// Lines that came from the board.
    std::uint64_t lines_heard() const { return lines_heard_; }
    /// Whether a line has set this value since the screen was made.
    bool told(std::size_t value) const { return told_[value]; }
    /// Bytes thrown away because more waited than the screen could take in a minute.
    std::uint64_t bytes_dropped() const { return bytes_dropped_; }

    void on_bytes(std::string_view bytes) override;
    void on_state(link::LinkState state, std::string_view why) override;

  private:
    void turn();
    void feed(SimTime now);
    SimTime advance(SimTime now);
    void tell_judgements();
    void send_output();

    screen::Screen& screen_;
    link::Link& link_;
    Clock& clock_;
    std::unique_ptr<Alarm> alarm_;
    LiveObserver* observer_;
    ScreenUser* user_;
    screen::Tour* tour_ = nullptr;
    SimTime head_start_{0};
    bool running_ = false;
    protocol::LineSplitter from_board_;
    protocol::LineSplitter to_board_;
    std::string inbox_;       ///< has arrived, but not yet as a UART would have brought it
    std::uint64_t seen_ = 0;  ///< lines judged and told
    std::uint64_t lines_heard_ = 0;
    std::uint64_t bytes_dropped_ = 0;
    std::vector<bool> told_;
};

}  // namespace fauxboard::host
