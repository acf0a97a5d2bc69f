#pragma once

#include <cstdint>
#include <string>

namespace fauxboard::dlp {

/// What happens by itself, or comes of what was asked for. Their names: see the table of events.
enum class Event : std::uint8_t {
    board_ready,
    print_started,
    print_not_opened,
    print_homing_failed,
    print_layer_begun,
    print_displayed,
    print_exposing,
    print_exposed,
    print_paused,
    print_resumed,
    print_pause_reached,
    print_finishing,
    print_finished,
    print_cancelled,
    print_read_error,
    platform_homed,
    platform_homing_failed,
    platform_zero_set,
    platform_stopped,
    files_changed,
    files_deleted,
    files_not_deleted,
    setup_loaded,
    setup_failed,
    setup_saved,
    setup_changed,
    uvtest_loaded,
    uvtest_light_off,
    motor_off,
    panel_failed,
    clock_not_set,
    touch_calibrated,
    touch_not_calibrated,
};

/// Who is told of events, and of what a person wants to know.
class Listener {
  public:
    virtual ~Listener() = default;
    virtual void raise(Event event) = 0;
    virtual void note(const std::string& text) = 0;
};

}  // namespace fauxboard::dlp
