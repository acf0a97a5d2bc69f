#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/touch/touch_screen.h"

namespace fauxboard::testing {

using machine::SimTime;

/// A small made-up screen, 200 x 100 pixels, on a board that has fields and events for it.
extern const std::string_view made_up_screen;

std::shared_ptr<const screen::ScreenProfile> own_screen_from(std::string_view json);
/// What is wrong with a screen, a sentence a line; "" for nothing.
std::string wrong_with(std::string_view json);

/// A board with a screen of its own, in virtual time.
class TouchBench {
  public:
    explicit TouchBench(std::string_view json = made_up_screen);
    TouchBench(std::shared_ptr<const behaviour::Profile> profile,
               std::shared_ptr<const screen::ScreenProfile> own, const machine::Services& services);

    void run_for(double seconds);
    /// A finger for so long; runs on until what comes of it is done.
    void tap(int x, int y, double seconds = 0.12);
    /// The same on a control; the sentence when there is none.
    std::string tap(std::string_view control, double seconds = 0.12);
    void world(std::string_view phrase);
    double field(std::string_view path) const;
    std::string text_field(std::string_view path) const;
    /// Runs on until it has that value, to the millisecond; false when it has not within so long.
    bool run_until_field(std::string_view path, double value, double within_s);
    void set(std::string_view path, double value);

    screen::Scene scene();
    std::string page() { return scene().page; }
    /// The caption of the box, "" without one.
    std::string box();
    /// What can be read, a line each.
    std::string texts();
    bool has_text(std::string_view text);

    touch::TouchScreen screen;
    board::Board board;
    SimTime now{0};
};

}  // namespace fauxboard::testing
