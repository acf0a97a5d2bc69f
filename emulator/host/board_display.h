#pragma once

#include "emulator/board/board.h"
#include "emulator/control/display.h"
#include "emulator/host/screen_plug.h"
#include "emulator/touch/touch_screen.h"

namespace fauxboard::host {

using machine::SimTime;

/// The screen that is part of a board, for people and programs to see and touch.
class BoardDisplay final : public control::Display {
  public:
    /// Both outlive this.
    BoardDisplay(touch::TouchScreen& screen, const board::Board& board) : screen_(screen), board_(board) {}

    control::Json page(SimTime now) override;
    std::string png(SimTime now) override;
    Touched touch(SimTime now, int x, int y, SimTime how_long) override;
    Touched touch(SimTime now, std::string_view control, SimTime how_long) override;

  private:
    touch::TouchScreen& screen_;
    const board::Board& board_;
};

/// The same of a virtual screen at the board's line, which has no places of its own and is laid out.
class PlugDisplay final : public control::Display {
  public:
    /// Outlives this.
    explicit PlugDisplay(ScreenPlug& plug) : plug_(plug) {}

    control::Json page(SimTime now) override;
    std::string png(SimTime now) override;
    Touched touch(SimTime now, int x, int y, SimTime how_long) override;
    Touched touch(SimTime now, std::string_view control, SimTime how_long) override;

  private:
    ScreenPlug& plug_;
};

}  // namespace fauxboard::host
