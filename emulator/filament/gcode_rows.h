#pragma once

// What the tables of codes share. Private to the gcode_*_codes.cpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/gcode_codes.h"
#include "emulator/filament/gcode_line.h"
#include "emulator/filament/heating_wait.h"
#include "emulator/filament/host_commands.h"
#include "emulator/filament/mixer.h"
#include "emulator/filament/motion.h"
#include "emulator/filament/procedures.h"
#include "emulator/filament/state.h"
#include "emulator/filament/thermal.h"

namespace fauxboard::filament::codes {

using Line = const GcodeLine&;
using enum Needs;

std::span<const GcodeCode> motion_codes();
std::span<const GcodeCode> heater_codes();
std::span<const GcodeCode> job_codes();
std::span<const GcodeCode> setting_codes();

inline constexpr std::string_view axis_letters = "XYZE";

inline int percent(double value, int least, int most) {
    return static_cast<int>(std::lround(std::clamp(value, double(least), double(most))));
}

/// The number behind `name`, where it stands.
inline void take(Line line, char name, double& out, const SettingBounds& bounds) {
    if (line.has(name)) {
        out = std::clamp(line.number(name), bounds.least, bounds.most);
    }
}

/// The numbers behind X, Y, Z and E, where given, into `out`.
inline void take_axes(Line line, AxisValues& out, const SettingBounds& bounds) {
    for (std::size_t i = 0; i < axis_count; ++i) {
        take(line, axis_letters[i], out[i], bounds);
    }
}

inline void ignore(GcodeSource&, Line) {}

/// The source's next line not before so many seconds have passed.
inline void wait(GcodeSource& r, double seconds) {
    constexpr double longest_dwell_s = 86400;
    r.wake = r.now + from_seconds(std::clamp(seconds, 0.0, longest_dwell_s));
}

}  // namespace fauxboard::filament::codes
