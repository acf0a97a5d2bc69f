#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/screen/screen.h"
#include "emulator/screen/tour.h"

namespace fauxboard::testing {

using machine::SimTime;

/// Finds the shipped screens by name, and nothing else.
behaviour::SourceFinder screen_finder();
/// A shipped screen, loaded once per program.
std::shared_ptr<const screen::ScreenProfile> shipped_screen(std::string_view name);
/// A screen from a text that may extend shipped ones.
std::shared_ptr<const screen::ScreenProfile> screen_from(std::string_view json);

/// A screen alone, on and past its start, with its hello taken.
class Bench {
  public:
    explicit Bench(std::string_view name = "geeetech-a30t") : Bench(shipped_screen(name)) {}
    explicit Bench(std::shared_ptr<const screen::ScreenProfile> profile);

    screen::Screen& operator*() { return screen_; }
    screen::Screen* operator->() { return &screen_; }

    /// The board says the body, in a right frame; gives the last judgement.
    const screen::Judgement& say(std::string_view body);
    /// The bytes of one line as they are; the line end is added.
    const screen::Judgement& say_raw(std::string_view line);
    /// Presses, and gives what was sent, parted by " | "; the sentence when it was not pressed.
    std::string press(std::string_view path);
    void pass(double seconds);
    /// All output so far, as bytes.
    std::string take();
    SimTime now() const { return now_; }

  private:
    screen::Screen screen_;
    SimTime now_{0};
    std::string bytes_;
};

/// Runs a tour against a board in virtual time, up to `limit_s` seconds.
struct TourRun {
    std::vector<screen::TourResult> results;
    std::vector<screen::Finding> findings;
    screen::ScreenCounters counters;
    std::size_t total = 0;
    bool done = false;
    double seconds = 0;
};
TourRun run_tour(const std::string& screen, std::shared_ptr<const behaviour::Profile> board, double limit_s,
                 const machine::Services& services = {});

/// A board and a screen for a minute, in which the screen's buttons are pressed one after the other.
struct Together {
    Together(std::shared_ptr<const behaviour::Profile> board,
             std::shared_ptr<const screen::ScreenProfile> screen, const machine::Services& services,
             const std::vector<std::string>& presses);
    std::vector<screen::Finding> findings;
};

}  // namespace fauxboard::testing
