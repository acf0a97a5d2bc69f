#pragma once

#include <functional>
#include <string_view>

#include "emulator/board/board.h"
#include "emulator/control/target.h"
#include "emulator/screen/screen.h"

namespace fauxboard::script {

using board::SimTime;

/// Where a scenario is played: a running board with its line, and perhaps a touch screen in the same process.
class Stage {
  public:
    virtual ~Stage() = default;
    /// As control::Target::visit().
    virtual void visit(const std::function<void(board::Board& board, SimTime now)>& use) = 0;
    /// The faults of the line; null when it takes none.
    virtual fault::FaultControl* faults() = 0;
    /// The touch screen; null when there is none in this process.
    virtual const screen::Screen* screen() = 0;
    /// Touches a button of that screen, walking to its page. Never called without one.
    virtual screen::PressResult press(std::string_view path) = 0;
    /// What shows the board to a person and takes touches; null when nothing does.
    virtual control::Display* display() { return nullptr; }
    /// Keeps a picture under that name. Why not; empty when it was kept.
    virtual std::string keep_picture(const std::string& /*file*/, std::string_view /*png*/) {
        return "pictures cannot be kept here";
    }
    /// Words of the scenario for whoever watches.
    virtual void note(std::string_view words) = 0;
};

}  // namespace fauxboard::script
