#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/screen/screen.h"

namespace fauxboard::testing {

using machine::SimTime;

/// A screen that sends one command at a time, in virtual time, and a partner who answers from a script:
/// `answer` gives the bytes for a command. They come as fast as the line carries them.
class Partner {
  public:
    using Answer = std::function<std::string(std::string_view command)>;

    Partner(std::shared_ptr<const screen::ScreenProfile> profile, Answer answer);

    screen::Screen& operator*() { return screen_; }
    screen::Screen* operator->() { return &screen_; }

    void pass(double seconds);
    /// The board says this by itself; line ends stand in it.
    void say(std::string_view bytes);
    /// Presses; the sentence when that was not possible.
    std::string press(std::string_view path);
    /// The commands that came since the last time, parted by " | ".
    std::string commands();
    /// Sentences of all that was found with this verdict, a line each.
    std::string found(screen::Verdict verdict) const;

    Answer answer;  ///< may be changed on the way

  private:
    screen::Screen screen_;
    SimTime now_{0};
    std::string rest_;   ///< of a command
    std::string inbox_;  ///< on the way to the screen
    SimTime wire_{0};    ///< when it has carried the last piece
    std::vector<std::string> commands_;
};

}  // namespace fauxboard::testing
