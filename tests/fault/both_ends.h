#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/fault/faults.h"
#include "emulator/screen/screen.h"
#include "emulator/screen/tour.h"

namespace fauxboard::fault {

/// Bytes, each with the time it passed.
struct Stream {
    std::string bytes;
    std::vector<SimTime> times;
    void add(SimTime now, std::string_view more) {
        bytes += more;
        times.resize(bytes.size(), now);
    }
    bool operator==(const Stream&) const = default;
};

/// One direction: what its sender said, and what came out for the receiver.
struct Way {
    Stream said;
    Stream came;
    bool untouched() const { return said == came; }
    bool operator==(const Way&) const = default;
};

/// A board and a touch screen with the line between them, in virtual time. Somebody touches the screen every
/// 400 ms while time runs, whatever it shows.
class BothEnds {
  public:
    BothEnds();
    /// Lets time pass; what passed the line meanwhile is in to_screen and to_board, and nothing older.
    void run(SimTime time);
    /// Presses these buttons as a person would, waiting for what the screen expects; false, with a doctest
    /// message that says why, when it does not come.
    bool met(std::vector<std::string> buttons);
    SimTime now() const { return now_; }

    Faults faults;
    Way to_screen;
    Way to_board;
    std::size_t times_down = 0;  ///< how often the link was seen to go down

  private:
    void pass(SimTime end, bool touches, screen::Tour* tour);
    bool exchange(screen::Tour* tour);
    void touch();

    board::Board board_;
    screen::Screen screen_;
    SimTime now_{0};
    SimTime board_due_{0};
    SimTime screen_due_{0};
    SimTime faults_due_{0};
    SimTime touch_due_{0};
    std::size_t touches_ = 0;
    bool up_ = true;
};

}  // namespace fauxboard::fault
