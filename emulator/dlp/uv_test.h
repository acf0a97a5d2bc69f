#pragma once

#include <cstdint>

#include "emulator/dlp/event.h"
#include "emulator/dlp/lamp.h"
#include "emulator/dlp/time.h"
#include "emulator/dlp/uv_panel.h"

namespace fauxboard::dlp {

/// Line `n` of the pictures with which lamp and panel are tried: 1 a frame, 2 all, 3 six blocks.
void test_line(unsigned image, unsigned n, PanelLine& line);

/// The page where lamp and panel are switched on by hand.
class UvTest {
  public:
    static constexpr unsigned images = 3;

    UvTest(UvPanel& panel, Lamp& lamp, Listener& listener)
        : panel_(panel), lamp_(lamp), listener_(listener) {}

    void power_on();
    /// Puts an image into bank 1; takes as long as a layer's picture. False for one that is chosen already.
    bool choose(unsigned image, SimTime load_time, SimTime now);
    /// At once, as when the board starts.
    void load(SimTime now);
    void set_light(bool on, SimTime now);
    void set_display(bool on, SimTime now);
    /// Both go off.
    void leave(SimTime now);
    void advance(SimTime now);
    SimTime next_event() const { return std::min(load_due_, display_due_); }

    unsigned image() const { return image_; }
    bool loading() const { return load_due_ != never; }
    bool light() const { return light_; }
    bool display() const { return display_; }

  private:
    void send(SimTime now);

    UvPanel& panel_;
    Lamp& lamp_;
    Listener& listener_;
    unsigned image_ = 1;
    bool light_ = false;
    bool display_ = false;
    SimTime load_due_ = never;
    SimTime display_due_ = never;  ///< panel or command follow a little later
};

}  // namespace fauxboard::dlp
