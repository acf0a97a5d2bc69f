// What is set once and kept.

#include "emulator/filament/gcode_rows.h"

namespace fauxboard::filament::codes {
namespace {

void acceleration(GcodeSource& r, Line line) {
    Settings& settings = r.on.settings;
    take(line, 'S', settings.acceleration_mm_s2, acceleration_bounds);
    take(line, 'P', settings.acceleration_mm_s2, acceleration_bounds);
    take(line, line.has('R') ? 'R' : 'T', settings.retract_acceleration_mm_s2, acceleration_bounds);
}

void jerk(GcodeSource& r, Line line) {
    Settings& settings = r.on.settings;
    take(line, 'S', settings.min_velocity_mm_s, slowest_bounds);
    take(line, 'T', settings.min_travel_mm_s, slowest_bounds);
    take_axes(line, settings.jerk_mm_s, jerk_bounds);
}

constexpr auto table = std::to_array<GcodeCode>({
    {'M', 92, nothing,
     [](GcodeSource& r, Line line) { take_axes(line, r.on.settings.steps_per_mm, steps_bounds); }},
    {'M', 201, nothing,
     [](GcodeSource& r, Line line) {
         take_axes(line, r.on.settings.max_acceleration_mm_s2, acceleration_bounds);
     }},
    {'M', 203, nothing,
     [](GcodeSource& r, Line line) { take_axes(line, r.on.settings.velocity_mm_s, velocity_bounds); }},
    {'M', 204, nothing, acceleration},
    {'M', 205, nothing, jerk},
});

}  // namespace

std::span<const GcodeCode> setting_codes() {
    return table;
}

}  // namespace fauxboard::filament::codes
