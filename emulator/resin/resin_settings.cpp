#include "emulator/resin/resin_settings.h"
#include "emulator/resin/names.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::resin {
namespace {

using enum ResinSetting;

/// What a row is beside its numbers.
enum : unsigned { whole = 1, backup = 2, joins = 4 };

constexpr ResinSettingInfo row(ResinSetting id, unsigned code, char letter, std::string_view path,
                               std::string_view unit, double min, double max, double initial, unsigned kind,
                               std::string_view help, std::string_view comment = {}, char also = 0) {
    return {id,
            static_cast<std::uint16_t>(code),
            letter,
            also,
            path,
            unit,
            min,
            max,
            initial,
            (kind & whole) != 0,
            (kind & backup) != 0,
            (kind & joins) != 0,
            help,
            comment};
}

constexpr std::string_view homing_action =
    "Action after XYZ homing 0: Return to zero point (0,0,0) 1: Stop at the limit position";

constexpr std::array<ResinSettingInfo, resin_setting_count> table{{
    row(motor_direction, 8004, 'I', "config.motor_direction", "", -1, 1, -1, whole | backup,
        "Z motor direction"),
    row(move_inverted, 8005, 'Z', "config.move_inverted", "", 0, 1, 0, whole | backup,
        "what Z moves: 0 extrusion head, 1 platform",
        "Z axis 0: extrusion head movement 1: platform movement"),
    row(start_speed, 8006, 'I', "config.start_speed", "mm/s", 0, 1000, 30, whole | backup,
        "starting speed: that of a move without one of its own", "starting speed"),
    row(turn_speed, 8007, 'I', "config.turn_speed", "mm/s", 0, 1000, 15, whole | backup,
        "rail turning speed (jerk)", "rail turning speed"),
    row(acceleration, 8008, 'I', "config.acceleration", "mm/s2", 0, 100000, 1000, whole | backup,
        "acceleration"),
    row(step, 8010, 'S', "config.step", "mm", 0, 1, 0.000625, backup, "length of one step of Z", "z mm"),
    row(max_speed, 8013, 'I', "config.max_speed", "mm/s", 0, 1000, 5, whole | backup, "Z max speed"),
    row(home_speed, 8015, 'I', "config.home_speed", "mm/s", 0, 1000, 3, whole | backup,
        "speed to the end stop when homing", "Z first zero speed"),
    row(home_again_speed, 8016, 'I', "config.home_again_speed", "mm/s", 0, 1000, 3, whole | backup,
        "speed to the end stop for the second time", "Z second reset speed"),
    row(lift_slow_speed, 8015, 'P', "config.lift_slow_speed", "mm/s", 0, 1000, 2, backup,
        "speed of the first, slow part of a lift", "Z slowly rising speed", 'T'),
    row(lift_fast_speed, 8016, 'P', "config.lift_fast_speed", "mm/s", 0, 1000, 3, backup,
        "speed of the rest of a lift and of the way back", "Z fast rising and falling speed", 'T'),
    row(lift_wait, 8016, 'D', "config.lift_wait", "ms", 0, 600000, 1, whole | backup, "wait after a lift",
        "milliseconds to wait after Z rises"),
    row(withdrawal, 8020, 'S', "config.withdrawal", "mm", 0, 1000, 3, backup, "Makerware withdrawal length"),
    row(filament_diameter, 8021, 'S', "config.filament_diameter", "mm", 0, 10, 1.75, backup,
        "consumable diameter"),
    row(wire_back, 8028, 'S', "config.wire_back", "mm", 0, 1000, 0, backup, "wire back compensation"),
    row(board_fan, 8030, 'T', "config.board_fan", "", -2, 1, -2, whole | backup,
        "fan of the motherboard (filter, exhaust): 0 off, 1 with the LED, -1 on, -2 while printing",
        "MB_F control of motherboard cooling fan, 1: follow exposure 0: normally closed -1: normally open "
        "-2: follow "
        "printing"),
    row(led, 8030, 'S', "config.led", "", 0, 4, 4, whole | backup,
        "LED: 0 off, 1 on, 2 while printing, 4 with the exposure",
        "LED control, 0: normally closed 1: normally open 2: following model printing 4: following exposure"),
    row(lift_slow, 8070, 'S', "config.lift_slow", "mm", 0, 1000, 3, backup,
        "how far a lift goes slowly, where the file does not say", "each Z moves slowly up the distance"),
    row(resolution_x, 8071, 'X', "config.resolution_x", "pixels", 0, 65535, 1440, whole | backup,
        "pixels of the LCD in X", "projection resolution"),
    row(resolution_y, 8071, 'Y', "config.resolution_y", "pixels", 0, 65535, 2560, whole | backup | joins,
        "pixels of the LCD in Y"),
    row(warm_up, 8070, 'T', "config.warm_up", "s", 0, 3600, 0, whole | backup, "projector warm-up time"),
    row(lift, 8070, 'Z', "config.lift", "mm", 0, 1000, 6, backup,
        "how far a lift goes in all, where the file does not say", "the distance moved by each Z rise"),
    row(projector_baud, 8070, 'I', "config.projector_baud", "baud", 0, 4000000, 9600, whole | backup,
        "projector baud rate"),
    row(max_height, 8026, 'I', "config.max_height", "mm", 0, 2000, 155, backup, "Z maximum travel"),
    row(limit_type, 8029, 'I', "config.limit_type", "", 0, 2, 0, whole | backup,
        "end stops in use: 0 lower, 1 upper, 2 both",
        "XY limit 0: minimum limit 1: maximum limit 2: bilateral limit"),
    row(limit_wiring, 8029, 'T', "config.limit_wiring", "", 0, 1, 0, whole | backup,
        "limit wiring: 0 normally open, 1 normally closed",
        "limit wiring 0: limit normally open 1: limit normally closed"),
    row(limit_side, 8029, 'S', "config.limit_side", "", 0, 1, 0, whole | backup,
        "where Z homes: 0 nearest the screen, 1 farthest from it",
        "Z limit type 0: minimum limit 1: maximum limit"),
    row(after_homing, 8029, 'C', "config.after_homing", "", 0, 1, 0, whole | backup,
        "after homing: 0 go to zero, 1 stay at the end stop", homing_action),
    row(folders, 8034, 'I', "config.folders", "", 0, 1, 1, whole | backup, "folder support or not"),
    row(offset_used, 8083, 'I', "config.offset_used", "", 0, 1, 1, whole | backup,
        "zero is 0 at the end stop, 1 off it by config.offset", "whether to enable auto leveling"),
    row(after_z_homing, 8030, 'C', "config.after_z_homing", "", 0, 1, 0, whole | backup,
        "after Z return: 0 go to zero, 1 stay at the end stop",
        "Action after Z return 0: Return to zero point (0,0,0) 1: Stop at limit position"),
    row(led_fan, 8030, 'I', "config.led_fan", "", -2, 1, -2, whole | backup,
        "fan of the LED: 0 off, 1 with the exposure, -1 on, -2 while printing",
        "LED fan LED_F control, 1: Follow exposure 0: Normally closed -1: Normally open -2: Followed "
        "printing"),
    row(offset, 8084, 'Z', "config.offset", "mm", -100, 100, -0.1, backup, "zero point, from the end stop",
        "Delta Z offset, 0: Disable offset, the stroke is determined by setting Z to zero, non-zero, the "
        "stroke is "
        "triggered by the leveling trigger position + offset value"),
    row(logo, 8085, 'I', "config.logo", "ms", 100, 6000, 5000, whole | backup, "boot logo duration",
        "Boot logo duration, minimum 100ms, maximum 6000ms"),
    row(screensaver, 8085, 'T', "config.screensaver", "s", 0, 86400, 0, whole | backup,
        "standby time of the screen saver; 0 is never", "standby time of screen saver, unit is second"),
    row(direction_settle, 8087, 'I', "config.direction_settle", "ns", 0, 1000000, 0, whole | backup,
        "time from direction valid to pulse valid",
        "I: Time from direction valid to pulse valid (ns), T: Minimum pulse holding time (ns). If there is "
        "no "
        "external driver, please set all to 0"),
    row(pulse_hold, 8087, 'T', "config.pulse_hold", "ns", 0, 1000000, 0, whole | backup | joins,
        "minimum pulse holding time"),
    row(after_print, 8489, 'P', "config.after_print", "", 0, 3, 3, whole,
        "after a print: 0 motors off, 1 nothing, 2 home and motors off, 3 up and motors off"),
}};

consteval bool ordered() {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (static_cast<std::size_t>(table[i].id) != i || table[i].initial < table[i].min ||
            table[i].initial > table[i].max) {
            return false;
        }
    }
    return true;
}
static_assert(ordered(), "the rows stand in the order of ResinSetting, each default within its bounds");

}  // namespace

std::span<const ResinSettingInfo, resin_setting_count> resin_settings() {
    return table;
}

const ResinSettingInfo* find_resin_setting(unsigned code, char letter) {
    const auto* const hit = std::find_if(table.begin(), table.end(), [&](const ResinSettingInfo& info) {
        return info.code == code && (info.letter == letter || (info.also != 0 && info.also == letter));
    });
    return hit == table.end() ? nullptr : hit;
}

ResinSettings::ResinSettings() {
    for (std::size_t i = 0; i < table.size(); ++i) {
        values_[i] = table[i].initial;
    }
}

void ResinSettings::set(ResinSetting id, double value) {
    const auto index = static_cast<std::size_t>(id);
    const ResinSettingInfo& info = table[index];
    const double inside = std::clamp(value, info.min, info.max);
    values_[index] = info.whole ? std::round(inside) : inside;
}

}  // namespace fauxboard::resin
