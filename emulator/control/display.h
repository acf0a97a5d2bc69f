#pragma once

#include <string>
#include <string_view>

#include "emulator/behaviour/document.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::control {

using behaviour::Json;
using machine::SimTime;

/// What shows the board to a person and takes touches: the board's own screen, or a virtual one at its line
/// in the same process. Everything is called from inside Target::visit(), with the machine brought up to
/// `now`.
class Display {
  public:
    virtual ~Display() = default;

    /// {"page", "title", "texts", "box": null or {"caption", "text", "buttons"}, "controls": [{"name", "x",
    /// "y", "w", "h", "label", "enabled"}]}
    virtual Json page(SimTime now) = 0;
    /// The same as a PNG file.
    virtual std::string png(SimTime now) = 0;

    /// What became of a touch.
    struct Touched {
        std::string why;  ///< it was not taken, a sentence; empty when it was
        SimTime done{0};  ///< when the finger is off and what comes of it is done
    };
    virtual Touched touch(SimTime now, int x, int y, SimTime how_long) = 0;
    virtual Touched touch(SimTime now, std::string_view control, SimTime how_long) = 0;
};

}  // namespace fauxboard::control
