// Heaters and fans.

#include "emulator/filament/gcode_rows.h"

namespace fauxboard::filament::codes {
namespace {

/// A heater that is not the nozzle in use: a slicer that believes in several hotends switches those off that
/// it is done with, and the one nozzle of a mixing printer must not go cold from it.
bool other_hotend(GcodeSource& r, Line line) {
    return line.has('T') && line.number('S') <= 0 && line.number('T') != r.on.mixer.tool();
}

/// M109 and M190 wait while it is too cold; those with R instead of S also while it is too warm.
void target(GcodeSource& r, Line line, HeaterId heater, bool waits) {
    const double c = line.has('S') ? line.number('S') : line.number('R', -1);
    if (c < 0 || (heater == HeaterId::nozzle && other_hotend(r, line))) {
        return;
    }
    GcodeMachine& p = r.on;
    p.thermal.set_target(heater, c);
    const bool cools = !line.has('S') && p.thermal.above(heater);
    const bool there = p.thermal.reached(heater) && (!p.wait.settles() || p.thermal.above(heater));
    const bool heats = p.thermal.heating(heater) && !there;
    if (waits && (heats || cools)) {
        p.wait.start(heater, r.now, p.events, cools);
    }
}

/// M303 and M306 T: the heater is brought to a temperature, and found out about on the way.
void tune(GcodeSource& r, Line line) {
    constexpr double usual_nozzle_c = 200;
    constexpr double usual_bed_c = 70;
    const HeaterId heater = line.number('E') < 0 ? HeaterId::bed : HeaterId::nozzle;
    const double usual_c = heater == HeaterId::bed ? usual_bed_c : usual_nozzle_c;
    const double c = line.number('S', usual_c);
    r.on.autotuned = autotune(r.on.thermal.plant(heater), c, heater == HeaterId::bed);
    r.on.thermal.set_target(heater, c);
    r.on.wait.start(heater, r.now, r.on.events);
}

void fan(GcodeSource& r, Line line, double pwm) {
    const double number = line.number('P');
    const int share = percent(pwm * 100 / 255, 0, 100);
    if (number == 0) {
        r.on.fans.part_percent = share;
    } else if (number == 2) {
        r.on.fans.second_percent = share;
    }
}

constexpr auto table = std::to_array<GcodeCode>({
    {'M', 104, nothing, [](GcodeSource& r, Line line) { target(r, line, HeaterId::nozzle, false); }},
    {'M', 105, nothing, ignore},
    {'M', 106, nothing, [](GcodeSource& r, Line line) { fan(r, line, line.number('S', 255)); }},
    {'M', 107, nothing, [](GcodeSource& r, Line line) { fan(r, line, 0); }},
    {'M', 109, turn, [](GcodeSource& r, Line line) { target(r, line, HeaterId::nozzle, true); }},
    {'M', 140, nothing, [](GcodeSource& r, Line line) { target(r, line, HeaterId::bed, false); }},
    {'M', 303, turn, tune, false, true},
    {'M', 306, turn, tune, false, true},
    {'M', 190, turn, [](GcodeSource& r, Line line) { target(r, line, HeaterId::bed, true); }},
});

}  // namespace

std::span<const GcodeCode> heater_codes() {
    return table;
}

}  // namespace fauxboard::filament::codes
