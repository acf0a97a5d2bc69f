#pragma once

#include <array>
#include <string>

#include "emulator/filament/config.h"

// The values of the machine that are plain state: something sets them, something shows them, nothing moves by
// itself.
namespace fauxboard::filament {

/// Motion parameters: the pages behind M2140. Defaults are those a real A30T reported (L24 frames).
/// Within which settings are kept, whoever sets them: a code, a profile, what was saved.
struct SettingBounds {
    double least;
    double most;
};
inline constexpr SettingBounds steps_bounds{0.01, 100'000};      ///< steps/mm
inline constexpr SettingBounds velocity_bounds{0.01, 10'000};    ///< mm/s
inline constexpr SettingBounds slowest_bounds{0, 10'000};        ///< mm/s
inline constexpr SettingBounds acceleration_bounds{1, 100'000};  ///< mm/s^2
inline constexpr SettingBounds jerk_bounds{0, 1000};             ///< mm/s

struct Settings {
    AxisValues steps_per_mm{80, 80, 400, 390};
    AxisValues velocity_mm_s{150, 150, 20, 25};
    double min_velocity_mm_s = 1;
    double min_travel_mm_s = 5;
    double acceleration_mm_s2 = 500;
    double retract_acceleration_mm_s2 = 500;
    AxisValues max_acceleration_mm_s2{500, 500, 50, 1000};
    AxisValues jerk_mm_s{7, 7, 0.5, 5};
    std::array<double, 2> double_z_mm{0, 0};
};

struct AddOns {
    bool sound = false;
    bool backlight = true;
    int backlight_percent = 50;
    bool lock = false;
    int lock_password = 0;
    int lock_seconds = 16;
    bool hotend_deviation = false;
    int hotend_center_c = 0;
    int hotend_offset_c = 0;
};

struct Fans {
    int part_percent = 0;
    int second_percent = 0;
};

struct Leveling {
    bool automatic = true;
    int sensor = 1;              ///< 0 capacitive switch, 1 3D Touch
    double z_offset_mm = -2.67;  ///< nozzle below probe
    bool manual = false;         ///< the manual leveling page is open
    double manual_z_mm = 8.0;
    bool pin_down = false;
    bool probe_alarm = false;
    // Delta machines only.
    std::array<double, 3> endstop_adjust_mm{0, 0, 0};
    double print_height_mm = 0, radius_error_mm = 0, delta_radius_mm = 0, diagonal_rod_mm = 0,
           rod_offset_mm = 0;
};

struct Filament {
    bool detector = true;
    bool present = false;
};

/// What became of the filament, apart from what the board believes.
struct FilamentPath {
    double lost = 0;        ///< share of what is extruded that does not move: a jam
    double moved_mm = 0;    ///< that has really gone through
    double stuck_mm = 0;    ///< extruded since it last moved
    double counted_mm = 0;  ///< of what was extruded, so much is in moved_mm or lost
};

/// What keeps filament from being pulled through a cold nozzle (M302).
struct ExtrusionGuard {
    bool on = false;
    bool cold_allowed = false;
    double min_c = 170;
    double longest_mm = 0;  ///< of one move; 0: any
};

/// A text that a command brings for others (M118), and to whom.
struct ToldText {
    std::string text;
    bool echo = false;    ///< E1: behind "echo:"
    bool action = false;  ///< A1: behind "//"
    int line = -1;        ///< P: 0 all, 1 and up one of them; -1: whoever sent it
};

struct ScreenSide {
    bool known = false;  ///< told us its firmware since power-on
    std::string firmware;
    int move_step = 0;
    int level_step = 0;
    int update_state = 0;  ///< last M2100 S
    std::string update_file = "A30_LCD.bin";
};

struct Wifi {
    bool module = false;
    bool enabled = false, auto_connect = false, access_point = false;
    int server_state = 0, signal = 0, router_state = 0;
    std::string router_ip, ssid, server_ip;
};

/// One closed-loop stepper driver behind M2132.
struct StepperDriver {
    bool closed_loop = false;
    int calibration_error = 0, enable_level = 0, direction_level = 0, microsteps = 16, max_current_ma = 1000,
        hold_current_ma = 500, position = 0, error_limit = 0;
};

struct Steppers {
    int selected = 0;
    std::array<StepperDriver, 4> drivers{};
};

}  // namespace fauxboard::filament
