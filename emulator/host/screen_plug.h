#pragma once

#include <array>
#include <memory>
#include <string>

#include "emulator/host/clock.h"
#include "emulator/host/live_screen.h"
#include "emulator/link/link.h"
#include "emulator/screen/screen.h"

namespace fauxboard::host {

/// A virtual touch screen plugged into a board in the same process: the line between the two is memory, and
/// what is written at one end arrives at the other at the same virtual time, at the clock's next round. So a
/// run has no hardware, no descriptor, and is the same each time.
class ScreenPlug {
  public:
    /// `clock` outlives this.
    ScreenPlug(std::shared_ptr<const screen::ScreenProfile> profile, Clock& clock);
    ~ScreenPlug();
    ScreenPlug(const ScreenPlug&) = delete;
    ScreenPlug& operator=(const ScreenPlug&) = delete;

    /// The board's end of the line.
    link::Link& board_end();
    /// Switches the screen on. Once, when the board's end is open.
    void start();
    void close();
    const screen::Screen& screen() const { return screen_; }
    /// See screen::Screen::press().
    screen::PressResult press(std::string_view path, std::size_t row = 0, std::optional<double> input = {}) {
        return live_->press(path, row, input);
    }
    screen::PressResult touch(std::size_t button, std::size_t row) {
        return live_->touch(button, row, std::nullopt);
    }

  private:
    class End;
    std::unique_ptr<End> board_end_;
    std::unique_ptr<End> screen_end_;
    screen::Screen screen_;
    std::unique_ptr<LiveScreen> live_;
};

}  // namespace fauxboard::host
