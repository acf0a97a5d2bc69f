#include "emulator/dlp/uv_test.h"

#include <algorithm>
#include <array>

namespace fauxboard::dlp {
namespace {

constexpr unsigned test_bank = 1;
constexpr SimTime light_time = ms(120'000);
constexpr SimTime fan_time = ms(130'000);
constexpr SimTime fan_after = ms(10'000);
constexpr SimTime settle_time = ms(100);  ///< between command and panel

/// A stretch of lines or columns; the last one is part of it.
struct Stretch {
    unsigned first;
    unsigned last;
};
constexpr Stretch hole_columns{250, 1189};
constexpr Stretch hole_lines{250, 2310};
constexpr std::array<Stretch, 2> block_columns{{{0, 599}, {840, 1439}}};
constexpr std::array<Stretch, 3> block_lines{{{0, 699}, {930, 1629}, {1860, 2559}}};

bool within(unsigned n, const Stretch& stretch) {
    return n >= stretch.first && n <= stretch.last;
}

}  // namespace

void test_line(unsigned image, unsigned n, PanelLine& line) {
    line.fill(0);
    if (image == 3) {
        if (std::any_of(block_lines.begin(), block_lines.end(),
                        [n](const Stretch& lines) { return within(n, lines); })) {
            for (const Stretch& columns : block_columns) {
                light(line, columns.first, columns.last + 1);
            }
        }
    } else if (image == 1 && within(n, hole_lines)) {
        light(line, 0, hole_columns.first);
        light(line, hole_columns.last + 1, panel_columns);
    } else {
        light(line, 0, panel_columns);
    }
}

void UvTest::power_on() {
    image_ = 1;
    light_ = display_ = false;
    load_due_ = display_due_ = never;
}

void UvTest::send(SimTime now) {
    panel_.begin_picture(test_bank);
    PanelLine line{};
    Packet packet{};
    for (unsigned n = 0; n < panel_lines; ++n) {
        test_line(image_, n, line);
        std::copy(line.begin(), line.end(), packet.begin() + 2);
        panel_.send_line(packet, n, now);
    }
    panel_.end_picture(now);
}

void UvTest::load(SimTime now) {
    send(now);
}

bool UvTest::choose(unsigned image, SimTime load_time, SimTime now) {
    if (image == image_ || image < 1 || image > images || loading()) {
        return false;
    }
    image_ = image;
    panel_.command(test_bank, false, false, now);
    load_due_ = now + load_time;
    return true;
}

void UvTest::set_light(bool on, SimTime now) {
    if (on == light_) {
        return;
    }
    light_ = on;
    if (on) {
        lamp_.light_for(light_time, now);
        lamp_.fan_for(fan_time, now);
    } else {
        lamp_.off(now);
        lamp_.fan_off_in(fan_after, now);
    }
}

void UvTest::set_display(bool on, SimTime now) {
    if (on == display_) {
        return;
    }
    display_ = on;
    if (on) {
        panel_.command(test_bank, true, true, now);
    } else {
        panel_.sleep(now);
    }
    display_due_ = now + settle_time;
}

void UvTest::leave(SimTime now) {
    set_display(false, now);
    set_light(false, now);
}

void UvTest::advance(SimTime now) {
    if (light_ && !lamp_.counting()) {
        light_ = false;
        listener_.raise(Event::uvtest_light_off);
    }
    if (load_due_ <= now) {
        load_due_ = never;
        send(now);
        if (display_) {
            panel_.command(test_bank, true, true, now);
        }
        listener_.raise(Event::uvtest_loaded);
    }
    if (display_due_ <= now) {
        display_due_ = never;
        if (display_) {
            panel_.wake(now);
            listener_.raise(Event::print_displayed);
        } else {
            panel_.command(test_bank, false, false, now);
        }
    }
}

}  // namespace fauxboard::dlp
