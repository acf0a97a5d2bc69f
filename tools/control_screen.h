#pragma once

// The screen that is part of a running board, reached by the board's control channel: `fauxboard screen ...
// --control PATH`.

#include <memory>
#include <string>
#include <string_view>

#include "emulator/screen/screen_profile.h"
#include "tools/control_client.h"

namespace fauxboard::tools {

class ControlScreen {
  public:
    /// Throws link::LinkError when nobody listens there.
    explicit ControlScreen(const std::string& path) : client_(path, answer_ms) {}

    /// What the screen shows, as the op `page` tells it. Throws link::HostError when it shows nothing.
    Json page();
    /// The same as a PNG file.
    std::string png();
    /// Touches a control of the page, or the box, that is open. Why not; empty when it was done.
    std::string touch(std::string_view control);
    /// Touches a pixel.
    void touch(int x, int y);
    /// From now on the board's time passes by touch() and pass() alone, for as long as this is there.
    void hold_time();
    /// Lets the board's time pass.
    void pass(std::string_view time);
    /// The screen's profile, found by the board's.
    std::shared_ptr<const screen::ScreenProfile> profile();

  private:
    static constexpr int answer_ms = 30'000;
    /// The answer, whether yes or no. Throws link::HostError when none comes.
    Json ask(const Json& request);

    ControlClient client_;
};

/// Where a page stands: the page's name, and the box over it: "Files", "Files / Warning! Are you sure".
std::string place_of(const Json& page);

}  // namespace fauxboard::tools
