#include "emulator/dlp/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace fauxboard::dlp {
namespace {

using enum Section;
constexpr double no_bound = std::numeric_limits<double>::infinity();
constexpr std::uint32_t ms_per_s = 1000;
constexpr std::uint32_t ms_per_min = 60'000;
constexpr std::uint32_t most_off_min = 71'582;  ///< more does not fit into 32 bits of milliseconds

/// The board compares with the decimal bound, which no float is exactly: 0.1 as it reads it stays.
bool keep(float& slot, float value, const Parameter& p, double at_most = no_bound) {
    const double most = std::min(p.most, at_most);
    const auto wide = static_cast<double>(value);
    slot = wide < p.least ? static_cast<float>(p.least) : wide > most ? static_cast<float>(most) : value;
    return slot == value;
}

template <class T>
bool keep_counted(T& slot, std::uint32_t value, const Parameter& p) {
    const std::uint32_t kept =
        std::clamp(value, static_cast<std::uint32_t>(p.least), static_cast<std::uint32_t>(p.most));
    slot = static_cast<T>(kept);
    return kept == value;
}

/// 0 or 1; all else is 1.
bool keep_switch(std::uint8_t& slot, std::int32_t value) {
    const bool wrong = value < 0 || value > 1;
    slot = static_cast<std::uint8_t>(wrong ? 1 : value);
    return !wrong;
}

bool keep_direction(std::int8_t& slot, std::int32_t value) {
    const bool wrong = value != -1 && value != 1;
    slot = static_cast<std::int8_t>(wrong ? -1 : value);
    return !wrong;
}

bool keep_hold(MotorSettings& motor, std::uint32_t seconds, const Parameter& p) {
    std::uint32_t kept = 0;
    const bool same = keep_counted(kept, seconds, p);
    motor.hold_time_ms = kept * ms_per_s;
    return same;
}

/// In minutes; what is negative or too much is the most there is. Not before the hold, unless it is never.
bool keep_off(MotorSettings& motor, std::int32_t minutes) {
    const bool beyond = minutes < 0 || minutes > static_cast<std::int32_t>(most_off_min);
    const std::uint32_t wanted = (beyond ? most_off_min : static_cast<std::uint32_t>(minutes)) * ms_per_min;
    motor.off_time_ms = wanted == 0 ? 0 : std::max(wanted, motor.hold_time_ms);
    return !beyond && motor.off_time_ms == wanted;
}

bool keep_screensaver(GeneralSettings& general, std::uint32_t minutes, const Parameter& p) {
    std::uint32_t kept = 0;
    const bool same = keep_counted(kept, minutes, p);
    general.screensaver_ms = kept * ms_per_min;
    return same;
}

bool keep_rotation(std::uint8_t& slot, std::uint32_t value) {
    slot = value > 0 ? 1 : 0;
    return value <= 1;
}

/// 0 to 2; more becomes 3.
bool keep_fan_mode(std::uint8_t& slot, std::uint32_t value) {
    constexpr std::uint32_t last_mode = 2;
    slot = static_cast<std::uint8_t>(std::min(value, last_mode + 1));
    return value <= last_mode;
}

constexpr double planner_bound(Firmware firmware) {
    return firmware == Firmware::v008 ? double{planner_limit} : no_bound;
}

#define FAUXBOARD_DLP_GET(member) [](const Settings& s) { return static_cast<double>(s.member); }

constexpr std::array table{
    Parameter{z_motor, "INVERT_DIR", "invert_dir", "", "direction of the motor", true, 0, 1,
              [](Settings& s, const NumberViews& n, const Parameter&, Firmware) {
                  return keep_switch(s.motor.invert_dir, n.whole);
              },
              FAUXBOARD_DLP_GET(motor.invert_dir)},
    Parameter{z_motor, "HOME_DIRECTION", "home_direction", "",
              "homing goes to the lower (-1) or upper (1) switch", true, -1, 1,
              [](Settings& s, const NumberViews& n, const Parameter&, Firmware) {
                  return keep_direction(s.motor.home_direction, n.whole);
              },
              FAUXBOARD_DLP_GET(motor.home_direction)},
    Parameter{z_motor, "HOME_POS", "home_pos", "mm", "place of the platform after homing", false, -no_bound,
              no_bound,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep(s.motor.home_pos_mm, n.decimal, p);
              },
              FAUXBOARD_DLP_GET(motor.home_pos_mm)},
    Parameter{z_motor, "MIN_POS", "min_pos", "mm", "lower limit of a homed platform", false, -no_bound,
              no_bound,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep(s.motor.min_pos_mm, n.decimal, p);
              },
              FAUXBOARD_DLP_GET(motor.min_pos_mm)},
    Parameter{z_motor, "MAX_POS", "max_pos", "mm",
              "upper limit of a homed platform; how far homing looks for the switch", false, -no_bound,
              no_bound,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep(s.motor.max_pos_mm, n.decimal, p);
              },
              FAUXBOARD_DLP_GET(motor.max_pos_mm)},
    Parameter{z_motor, "MIN_ENDSTOP_INVERTING", "min_endstop_inverting", "", "lower switch inverted", true, 0,
              1,
              [](Settings& s, const NumberViews& n, const Parameter&, Firmware) {
                  return keep_switch(s.motor.min_endstop_inverting, n.whole);
              },
              FAUXBOARD_DLP_GET(motor.min_endstop_inverting)},
    Parameter{z_motor, "MAX_ENDSTOP_INVERTING", "max_endstop_inverting", "", "upper switch inverted", true, 0,
              1,
              [](Settings& s, const NumberViews& n, const Parameter&, Firmware) {
                  return keep_switch(s.motor.max_endstop_inverting, n.whole);
              },
              FAUXBOARD_DLP_GET(motor.max_endstop_inverting)},
    Parameter{z_motor, "STEPS_PER_MM", "steps_per_mm", "steps/mm", "of the motor", true, 1, 200'000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.motor.steps_per_mm, n.counted, p);
              },
              FAUXBOARD_DLP_GET(motor.steps_per_mm)},
    Parameter{z_motor, "HOMING_FEEDRATE_FAST", "homing_feedrate_fast", "mm/s", "first run to the switch",
              false, 0.1, 40,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep(s.motor.homing_feedrate_fast, n.decimal, p);
              },
              FAUXBOARD_DLP_GET(motor.homing_feedrate_fast)},
    Parameter{z_motor, "HOMING_FEEDRATE_SLOW", "homing_feedrate_slow", "mm/s", "second run to the switch",
              false, 0.1, 40,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep(s.motor.homing_feedrate_slow, n.decimal, p);
              },
              FAUXBOARD_DLP_GET(motor.homing_feedrate_slow)},
    Parameter{z_motor, "ACCELERATION", "acceleration", "mm/s2", "of the moves of a print", false, 0.1,
              no_bound,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware f) {
                  return keep(s.motor.acceleration, n.decimal, p, planner_bound(f));
              },
              FAUXBOARD_DLP_GET(motor.acceleration)},
    Parameter{z_motor, "FEEDRATE", "feedrate", "mm/s", "of the move to the first layer", false, 0.1,
              planner_limit,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware f) {
                  return keep(s.motor.feedrate, n.decimal, p, f == Firmware::v008 ? planner_limit : 40);
              },
              FAUXBOARD_DLP_GET(motor.feedrate)},
    Parameter{z_motor, "TRAVEL_ACCELERATION", "travel_acceleration", "mm/s2", "of free moves", false, 0.1,
              no_bound,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware f) {
                  return keep(s.motor.travel_acceleration, n.decimal, p, planner_bound(f));
              },
              FAUXBOARD_DLP_GET(motor.travel_acceleration)},
    Parameter{z_motor, "TRAVEL_FEEDRATE", "travel_feedrate", "mm/s", "of free moves", false, 0.1, no_bound,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware f) {
                  return keep(s.motor.travel_feedrate, n.decimal, p, planner_bound(f));
              },
              FAUXBOARD_DLP_GET(motor.travel_feedrate)},
    Parameter{z_motor, "CURRENT_VREF", "current_vref", "mA", "of the motor", true, 100, 1000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.motor.current_vref, n.counted, p);
              },
              FAUXBOARD_DLP_GET(motor.current_vref)},
    Parameter{z_motor, "CURRENT_HOLD_VREF", "current_hold_vref", "mA", "of the motor that only holds", true,
              100, 1000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.motor.current_hold_vref, n.counted, p);
              },
              FAUXBOARD_DLP_GET(motor.current_hold_vref)},
    Parameter{z_motor, "HOLD_TIME", "hold_time_ms", "ms", "until the motor only holds; 0: never", true, 0,
              100'000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_hold(s.motor, n.counted, p);
              },
              FAUXBOARD_DLP_GET(motor.hold_time_ms)},
    Parameter{z_motor, "OFF_TIME", "off_time_ms", "ms",
              "until the motor is off and homing forgotten; 0: never", true, 0, most_off_min,
              [](Settings& s, const NumberViews& n, const Parameter&, Firmware) {
                  return keep_off(s.motor, n.whole);
              },
              FAUXBOARD_DLP_GET(motor.off_time_ms)},
    Parameter{general, "BUZZER_MSG_DURATION", "buzzer_msg_ms", "ms", "sound of a message", true, 0, 15'000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.general.buzzer_msg_ms, n.counted, p);
              },
              FAUXBOARD_DLP_GET(general.buzzer_msg_ms)},
    Parameter{general, "BUZZER_TOUCH_DURATION", "buzzer_touch_ms", "ms", "sound of a touch", true, 0, 15'000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.general.buzzer_touch_ms, n.counted, p);
              },
              FAUXBOARD_DLP_GET(general.buzzer_touch_ms)},
    Parameter{general, "ROTATE_DISPLAY", "rotate_display", "", "the screen is turned by 180 degrees", true, 0,
              1,
              [](Settings& s, const NumberViews& n, const Parameter&, Firmware) {
                  return keep_rotation(s.general.rotate_display, n.counted);
              },
              FAUXBOARD_DLP_GET(general.rotate_display)},
    Parameter{general, "SCREENSAVER_TIME", "screensaver_ms", "ms", "until the screensaver; 0: never", true, 0,
              15'000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_screensaver(s.general, n.counted, p);
              },
              FAUXBOARD_DLP_GET(general.screensaver_ms)},
    Parameter{general, "GUI_LANGUAGE", "gui_language", "", "0 English, 1 Russian", true, 0, 1,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.general.language, n.counted, p);
              },
              FAUXBOARD_DLP_GET(general.language), Firmware::v008},
    Parameter{general, "LIFT_AFTER_CALIBRATE", "lift_after_calibrate", "mm", "lift after Z=0 was set", false,
              0, 1000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep(s.general.calibrate_lift_mm, n.decimal, p);
              },
              FAUXBOARD_DLP_GET(general.calibrate_lift_mm), Firmware::v008},
    Parameter{general, "USE_EXTERNAL_CLOCK", "use_external_clock", "", "a clock chip of its own", true, 0, 1,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.general.external_clock, n.counted, p);
              },
              FAUXBOARD_DLP_GET(general.external_clock), Firmware::v008},
    Parameter{printing, "LIFT_ON_PAUSE", "lift_on_pause", "mm", "lift beyond that of the layer, on a pause",
              false, 0.1, 1000,
              [](Settings& s, const NumberViews& n, const Parameter& p,
                 Firmware) { return keep(s.general.pause_lift_mm, n.decimal, p); },
              FAUXBOARD_DLP_GET(general.pause_lift_mm), Firmware::v008},
    Parameter{printing, "LIFT_ON_COMPLETION", "lift_on_completion", "mm", "lift after a print", false, 0.1,
              1000,
              [](Settings& s, const NumberViews& n, const Parameter& p,
                 Firmware) { return keep(s.general.end_lift_mm, n.decimal, p); },
              FAUXBOARD_DLP_GET(general.end_lift_mm), Firmware::v008},
    Parameter{printing, "MB_FAN_MODE", "mb_fan_mode", "", "fan of the board", true, 0, 2,
              [](Settings& s, const NumberViews& n, const Parameter&, Firmware) {
                  return keep_fan_mode(s.general.fan_mode, n.counted);
              },
              FAUXBOARD_DLP_GET(general.fan_mode), Firmware::v008},
    Parameter{printing, "EXPOSURE_DECREASE_STEPS", "exposure_decrease_steps", "layers",
              "over which the exposure goes down after the bottom layers", true, 0, 1000,
              [](Settings& s, const NumberViews& n, const Parameter& p, Firmware) {
                  return keep_counted(s.general.decrease_steps, n.counted, p);
              },
              FAUXBOARD_DLP_GET(general.decrease_steps), Firmware::v008},
};

std::int32_t whole_of(std::string_view text) {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const bool negative = text.starts_with('-');
    std::int64_t value = 0;
    for (const char c : text.substr(negative ? 1 : 0)) {
        if (c < '0' || c > '9') {
            break;
        }
        value = std::min(value * 10 + (c - '0'), most + 1);
    }
    return static_cast<std::int32_t>(negative ? -value : std::min(value, most));
}

std::uint32_t counted_of(std::string_view text) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    const bool negative = text.starts_with('-');
    std::uint64_t value = 0;
    for (const char c : text.substr(negative ? 1 : 0)) {
        if (c < '0' || c > '9') {
            break;
        }
        value = std::min(value * 10 + static_cast<std::uint64_t>(c - '0'), most + 1);
    }
    if (value > most) {
        return static_cast<std::uint32_t>(most);
    }
    const auto kept = static_cast<std::uint32_t>(value);
    return negative ? 0U - kept : kept;
}

float decimal_of(std::string_view text) {
    const double value = std::strtod(std::string(text).c_str(), nullptr);
    return std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())
               ? static_cast<float>(std::copysign(no_bound, value))
               : static_cast<float>(value);
}

}  // namespace

NumberViews read_number(std::string_view text) {
    return {decimal_of(text), whole_of(text), counted_of(text)};
}

std::span<const Parameter, parameter_count> parameters() {
    return table;
}

}  // namespace fauxboard::dlp
