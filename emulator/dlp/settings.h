#pragma once

#include <cstdint>

#include "emulator/dlp/touch_calibration.h"

namespace fauxboard::dlp {

/// Which of the board's programs: what it knows, and how its EEPROM is laid out.
enum class Firmware : std::uint8_t {
    v001,  ///< 0.01, of 2020-10-01
    v008,  ///< 0.08, of 2021-06-01: more settings, other bounds
};

/// Highest speed and acceleration that the board's planner takes, mm/s and mm/s2.
constexpr float planner_limit = 100;

/// The Z axis. Defaults are those of the board's program.
struct MotorSettings {
    std::uint8_t invert_dir = 1;
    std::int8_t home_direction = -1;  ///< -1 the lower switch, 1 the upper one
    float home_pos_mm = 0;
    float min_pos_mm = -3;
    float max_pos_mm = 180;
    std::uint8_t min_endstop_inverting = 1;
    std::uint8_t max_endstop_inverting = 1;
    float steps_per_mm = 1600;
    float acceleration = 0.7F;  ///< mm/s2, of the moves of a print
    float feedrate = 5;         ///< mm/s
    float travel_acceleration = 20;
    float travel_feedrate = 20;
    float homing_feedrate_fast = 6;
    float homing_feedrate_slow = 1;
    float current_vref = 800;  ///< mA
    float current_hold_vref = 300;
    std::uint32_t hold_time_ms = 10'000;  ///< 0: never
    std::uint32_t off_time_ms = 60'000;   ///< 0: never

    bool operator==(const MotorSettings&) const = default;
};

/// The rest of the board. What stands after rotate_display is known to 0.08 only.
struct GeneralSettings {
    std::uint8_t language = 0;  ///< 0 English, 1 Russian
    float zero_pos_mm = 0;      ///< Z=0 as the user set it
    float pause_lift_mm = 40;
    std::uint8_t buzzer = 1;
    std::uint16_t buzzer_touch_ms = 50;
    std::uint16_t buzzer_msg_ms = 800;
    std::uint32_t screensaver_ms = 60'000;  ///< 0: never
    std::uint8_t screensaver_type = 1;
    std::uint8_t rotate_display = 0;
    float end_lift_mm = 40;
    std::uint8_t external_clock = 0;
    TouchCalibration touch = no_calibration;
    std::uint8_t fan_mode = 0;  ///< of the board's own fan; see MksBoard::board_fan()
    float calibrate_lift_mm = 0;
    std::uint32_t decrease_steps = 0;  ///< layers over which the exposure goes down after the bottom

    bool operator==(const GeneralSettings&) const = default;
};

/// Working time of the parts, s.
struct WorkCounters {
    std::uint32_t led_s = 0;
    std::uint32_t display_s = 0;
    std::uint32_t fan_s = 0;
    std::uint32_t print_s = 0;
    std::uint32_t on_s = 0;  ///< 0.08 only

    bool operator==(const WorkCounters&) const = default;
};

struct Settings {
    MotorSettings motor;
    GeneralSettings general;

    bool operator==(const Settings&) const = default;
};

/// What a board of this program has when nobody has set anything.
Settings default_settings(Firmware firmware);

}  // namespace fauxboard::dlp
