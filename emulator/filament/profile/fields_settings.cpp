// What is set once and kept: motion parameters, leveling, add-ons.

#include <array>

#include "emulator/behaviour/field_rows.h"
#include "emulator/filament/event_rows.h"
#include "emulator/filament/printer.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

using behaviour::Field;
using behaviour::Value;
using enum behaviour::FieldType;

constexpr behaviour::FieldRows<Printer> row;

constexpr std::array table{
    row.stored("settings.steps.x", number, "steps/mm", steps_bounds.least, steps_bounds.most,
               "X resolution (M92)", FAUXBOARD_PLACE(settings.steps_per_mm[0])),
    row.stored("settings.steps.y", number, "steps/mm", steps_bounds.least, steps_bounds.most,
               "Y resolution (M92)", FAUXBOARD_PLACE(settings.steps_per_mm[1])),
    row.stored("settings.steps.z", number, "steps/mm", steps_bounds.least, steps_bounds.most,
               "Z resolution (M92)", FAUXBOARD_PLACE(settings.steps_per_mm[2])),
    row.stored("settings.steps.e", number, "steps/mm", steps_bounds.least, steps_bounds.most,
               "extruder resolution (M92)", FAUXBOARD_PLACE(settings.steps_per_mm[3])),
    row.stored("settings.velocity.x", number, "mm/s", velocity_bounds.least, velocity_bounds.most,
               "highest X velocity (M203)", FAUXBOARD_PLACE(settings.velocity_mm_s[0])),
    row.stored("settings.velocity.y", number, "mm/s", velocity_bounds.least, velocity_bounds.most,
               "highest Y velocity (M203)", FAUXBOARD_PLACE(settings.velocity_mm_s[1])),
    row.stored("settings.velocity.z", number, "mm/s", velocity_bounds.least, velocity_bounds.most,
               "highest Z velocity (M203)", FAUXBOARD_PLACE(settings.velocity_mm_s[2])),
    row.stored("settings.velocity.e", number, "mm/s", velocity_bounds.least, velocity_bounds.most,
               "highest extruder velocity (M203)", FAUXBOARD_PLACE(settings.velocity_mm_s[3])),
    row.stored("settings.velocity.min", number, "mm/s", slowest_bounds.least, slowest_bounds.most,
               "lowest velocity of a printing move (M205 S)", FAUXBOARD_PLACE(settings.min_velocity_mm_s)),
    row.stored("settings.velocity.travel", number, "mm/s", slowest_bounds.least, slowest_bounds.most,
               "lowest velocity of a travel move (M205 T)", FAUXBOARD_PLACE(settings.min_travel_mm_s)),
    row.stored("settings.acceleration.print", number, "mm/s2", acceleration_bounds.least,
               acceleration_bounds.most, "acceleration of moves (M204 S)",
               FAUXBOARD_PLACE(settings.acceleration_mm_s2)),
    row.stored("settings.acceleration.retract", number, "mm/s2", acceleration_bounds.least,
               acceleration_bounds.most, "acceleration of retracts (M204 T)",
               FAUXBOARD_PLACE(settings.retract_acceleration_mm_s2)),
    row.stored("settings.acceleration.x", number, "mm/s2", acceleration_bounds.least,
               acceleration_bounds.most, "highest X acceleration (M201)",
               FAUXBOARD_PLACE(settings.max_acceleration_mm_s2[0])),
    row.stored("settings.acceleration.y", number, "mm/s2", acceleration_bounds.least,
               acceleration_bounds.most, "highest Y acceleration (M201)",
               FAUXBOARD_PLACE(settings.max_acceleration_mm_s2[1])),
    row.stored("settings.acceleration.z", number, "mm/s2", acceleration_bounds.least,
               acceleration_bounds.most, "highest Z acceleration (M201)",
               FAUXBOARD_PLACE(settings.max_acceleration_mm_s2[2])),
    row.stored("settings.acceleration.e", number, "mm/s2", acceleration_bounds.least,
               acceleration_bounds.most, "highest extruder acceleration (M201)",
               FAUXBOARD_PLACE(settings.max_acceleration_mm_s2[3])),
    row.stored("settings.jerk.x", number, "mm/s", jerk_bounds.least, jerk_bounds.most, "X jerk (M205 X)",
               FAUXBOARD_PLACE(settings.jerk_mm_s[0])),
    row.stored("settings.jerk.y", number, "mm/s", jerk_bounds.least, jerk_bounds.most, "Y jerk (M205 Y)",
               FAUXBOARD_PLACE(settings.jerk_mm_s[1])),
    row.stored("settings.jerk.z", number, "mm/s", jerk_bounds.least, jerk_bounds.most, "Z jerk (M205 Z)",
               FAUXBOARD_PLACE(settings.jerk_mm_s[2])),
    row.stored("settings.jerk.e", number, "mm/s", jerk_bounds.least, jerk_bounds.most,
               "extruder jerk (M205 E)", FAUXBOARD_PLACE(settings.jerk_mm_s[3])),
    row.stored("settings.double_z.z0", number, "mm", -10, 10, "home offset of the first Z motor (M2011 P0)",
               FAUXBOARD_PLACE(settings.double_z_mm[0])),
    row.stored("settings.double_z.z1", number, "mm", -10, 10, "home offset of the second Z motor (M2011 P1)",
               FAUXBOARD_PLACE(settings.double_z_mm[1])),

    row.stored("leveling.auto", boolean, "", 0, 1, "automatic leveling is on (AL)",
               FAUXBOARD_PLACE(leveling.automatic)),
    row.stored("leveling.sensor", integer, "", 0, 254,
               "ST of L3: 0 capacitive switch, 1 3D Touch, 254 only the switch's page",
               FAUXBOARD_PLACE(leveling.sensor)),
    row.stored("leveling.z_offset", number, "mm", -50, 50, "nozzle below probe (L11)",
               FAUXBOARD_PLACE(leveling.z_offset_mm)),
    row.shown("leveling.probe_height", number, "mm",
              "the same seen from the nozzle: leveling.z_offset with its sign turned",
              [](const Printer& p) { return -p.leveling.z_offset_mm; }),
    row.plain("leveling.manual", boolean, "", 0, 1, "manual leveling is under way",
              FAUXBOARD_PLACE(leveling.manual)),
    row.stored("leveling.manual_z", number, "mm", -50, 500, "height of manual leveling (L10)",
               FAUXBOARD_PLACE(leveling.manual_z_mm)),
    row.plain("leveling.pin_down", boolean, "", 0, 1, "the pin of the 3D Touch is out",
              FAUXBOARD_PLACE(leveling.pin_down)),
    row.plain("leveling.probe_alarm", boolean, "", 0, 1, "the 3D Touch blinks its alarm",
              FAUXBOARD_PLACE(leveling.probe_alarm)),
    row.stored("delta.endstop.x", number, "mm", -50, 50, "delta: end stop adjustment of tower X",
               FAUXBOARD_PLACE(leveling.endstop_adjust_mm[0])),
    row.stored("delta.endstop.y", number, "mm", -50, 50, "delta: end stop adjustment of tower Y",
               FAUXBOARD_PLACE(leveling.endstop_adjust_mm[1])),
    row.stored("delta.endstop.z", number, "mm", -50, 50, "delta: end stop adjustment of tower Z",
               FAUXBOARD_PLACE(leveling.endstop_adjust_mm[2])),
    row.stored("delta.height", number, "mm", 0, 2000, "delta: print height (H of L10)",
               FAUXBOARD_PLACE(leveling.print_height_mm)),
    row.stored("delta.radius_error", number, "mm", -100, 100, "delta: radius error (O of L10)",
               FAUXBOARD_PLACE(leveling.radius_error_mm)),
    row.stored("delta.radius", number, "mm", 0, 1000, "delta: radius (R of L10)",
               FAUXBOARD_PLACE(leveling.delta_radius_mm)),
    row.stored("delta.rod", number, "mm", 0, 1000, "delta: diagonal rod (D of L10)",
               FAUXBOARD_PLACE(leveling.diagonal_rod_mm)),
    row.stored("delta.rod_offset", number, "mm", 0, 1000, "delta: smooth rod offset (F of L10)",
               FAUXBOARD_PLACE(leveling.rod_offset_mm)),

    row.stored("addons.sound", boolean, "", 0, 1, "sound (SE)", FAUXBOARD_PLACE(addons.sound)),
    row.stored("addons.backlight", boolean, "", 0, 1, "backlight (BE)", FAUXBOARD_PLACE(addons.backlight)),
    row.stored("addons.backlight_percent", integer, "%", 0, 100, "brightness (BP)",
               FAUXBOARD_PLACE(addons.backlight_percent)),
    row.stored("addons.lock", boolean, "", 0, 1, "screen lock (CE)", FAUXBOARD_PLACE(addons.lock)),
    row.stored("addons.lock_password", integer, "", 0, 9999, "password of the lock (SP), no leading zeros",
               FAUXBOARD_PLACE(addons.lock_password)),
    row.stored("addons.lock_seconds", integer, "s", 0, 9999, "idle time before the lock closes (ST)",
               FAUXBOARD_PLACE(addons.lock_seconds)),
    row.stored("addons.hotend_deviation", boolean, "", 0, 1, "hotend temperature deviation is in force (HE)",
               FAUXBOARD_PLACE(addons.hotend_deviation)),
    row.stored("addons.hotend_center", integer, "C", -500, 500, "centre of the deviation (HC)",
               FAUXBOARD_PLACE(addons.hotend_center_c)),
    row.stored("addons.hotend_offset", integer, "C", -500, 500, "temperature deviation (HO)",
               FAUXBOARD_PLACE(addons.hotend_offset_c)),
};

}  // namespace

std::span<const behaviour::Field> settings_fields() {
    return table;
}

}  // namespace fauxboard::filament
