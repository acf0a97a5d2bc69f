#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace fauxboard::resin {

/// The settings of a resin board, in the order in which a backup file lists them.
enum class ResinSetting : std::uint8_t {
    motor_direction,
    move_inverted,
    start_speed,
    turn_speed,
    acceleration,
    step,
    max_speed,
    home_speed,
    home_again_speed,
    lift_slow_speed,
    lift_fast_speed,
    lift_wait,
    withdrawal,
    filament_diameter,
    wire_back,
    board_fan,
    led,
    lift_slow,
    resolution_x,
    resolution_y,
    warm_up,
    lift,
    projector_baud,
    max_height,
    limit_type,
    limit_wiring,
    limit_side,
    after_homing,
    folders,
    offset_used,
    after_z_homing,
    led_fan,
    offset,
    logo,
    screensaver,
    direction_settle,
    pulse_hold,
    after_print,
    count_  // not a setting
};

inline constexpr std::size_t resin_setting_count = static_cast<std::size_t>(ResinSetting::count_);

/// One setting: what code sets it, where it shows, what it may be, and how files of the board write it.
/// Source: the list of codes, the backup file (M8512) and the diagnostics (M8093) of an Elegoo Mars Pro,
/// V4.3.3_LCDC.
struct ResinSettingInfo {
    ResinSetting id;
    std::uint16_t code;     ///< 8004 of M8004
    char letter;            ///< of the parameter
    char also;              ///< another letter for the same; 0: none
    std::string_view path;  ///< of its field
    std::string_view unit;
    double min;
    double max;
    double initial;
    bool whole;                ///< a whole number; others are written with 6 decimals
    bool in_backup;            ///< the backup file lists it
    bool joins;                ///< on the line of the one before it
    std::string_view help;     ///< one line of text
    std::string_view comment;  ///< what stands behind it there; empty: as `help`
};

/// Every setting, in the order of ResinSetting.
std::span<const ResinSettingInfo, resin_setting_count> resin_settings();

/// The setting that parameter `letter` of M`code` sets, or null.
const ResinSettingInfo* find_resin_setting(unsigned code, char letter);

/// Values of all settings.
class ResinSettings {
  public:
    ResinSettings();
    double operator[](ResinSetting id) const { return values_[static_cast<std::size_t>(id)]; }
    /// Kept within the setting's bounds; whole numbers are rounded. `value` must be finite.
    void set(ResinSetting id, double value);
    bool operator==(const ResinSettings&) const = default;

  private:
    std::array<double, resin_setting_count> values_{};
};

}  // namespace fauxboard::resin
