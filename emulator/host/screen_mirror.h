#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/host/clock.h"
#include "emulator/screen/screen.h"

namespace fauxboard::host {

/// A virtual touch screen that looks on: it hears what the board says on its main line, whether a real screen
/// is there or nobody, and so shows what that one shows, unless a person has turned a page there. Its buttons
/// are requests to the board. What a screen says by itself, without being touched, it says only when it is
/// alone on the line.
class ScreenMirror {
  public:
    struct Parts {
        std::shared_ptr<const screen::ScreenProfile> profile;
        Clock& clock;
        /// One line, framed, without its end, for the board; called from a turn of the clock.
        std::function<void(std::string_view line)> ask;
        /// Nobody else is at the other end of the line.
        std::function<bool()> alone;
        /// A line that was not taken as it was meant; `at` in time of the board.
        std::function<void(SimTime at, const screen::Judgement& judgement)> on_judged;
    };
    /// It knows what `said` has told, oldest first: the last line of each kind.
    ScreenMirror(Parts parts, const std::vector<std::string>& said);

    /// The board has put a line on its main line.
    void hear(SimTime now, std::string_view line);
    /// As Screen::press(); `row` and `input` as in Screen::touch(), of a button of the open page. What it
    /// sends is in the result, and not with Parts::ask yet: see take_requests().
    screen::PressResult press(const std::string& button, std::size_t row, std::optional<double> input,
                              SimTime now);
    /// The requests that a touch has made, and forgets them.
    std::vector<std::string> take_requests();
    const screen::Screen& screen() const { return screen_; }

  private:
    void turn();
    SimTime time(SimTime now) const;
    void settle(SimTime now);
    void collect(bool touched);

    Parts parts_;
    SimTime head_start_;
    screen::Screen screen_;
    std::unique_ptr<Alarm> alarm_;
    std::string half_;                   ///< of a line that the screen says
    std::vector<std::string> requests_;  ///< that wait for take_requests()
    std::uint64_t judged_ = 0;
};

}  // namespace fauxboard::host
