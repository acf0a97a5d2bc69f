// The codes of a job's file and of the USB side: a table, and a function each.

#include "emulator/filament/gcode_codes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/gcode_line.h"
#include "emulator/filament/heating_wait.h"
#include "emulator/filament/mixer.h"
#include "emulator/filament/motion.h"
#include "emulator/filament/names.h"
#include "emulator/filament/procedures.h"
#include "emulator/filament/state.h"
#include "emulator/filament/thermal.h"

namespace fauxboard::filament {
namespace {

constexpr std::string_view axis_letters = "XYZE";
constexpr std::size_t longest_message = 60;
constexpr double longest_dwell_s = 86400;
constexpr double largest_setting = 1e6;
/// How long the firmware is busy with a message of the file.
constexpr double message_s = 0.001;

int percent(double value, int least, int most) {
    return static_cast<int>(std::lround(std::clamp(value, double(least), double(most))));
}

}  // namespace

/// The functions of the table.
struct Codes {
    using Line = const GcodeLine&;

    /// The numbers behind X, Y, Z and E, where given, into `out`.
    static void take_axes(Line line, AxisValues& out, double least) {
        for (std::size_t i = 0; i < axis_count; ++i) {
            if (line.has(axis_letters[i])) {
                out[i] = std::clamp(line.number(axis_letters[i]), least, largest_setting);
            }
        }
    }
    static void take(Line line, char name, double& out) {
        if (line.has(name)) {
            out = std::clamp(line.number(name), 0.0, largest_setting);
        }
    }

    /// Where a G0 to G3 ends; F, if there, stays in force.
    static AxisValues target_of(GcodeSource& r, Line line) {
        const Motion& motion = r.on.motion;
        AxisValues target = motion.planned();
        for (std::size_t i = 0; i < axis_count; ++i) {
            if (line.has(axis_letters[i])) {
                const bool relative = i == 3 ? motion.relative_e() : motion.relative();
                target[i] = line.number(axis_letters[i]) * r.on.modal.unit_mm + (relative ? target[i] : 0);
            }
        }
        if (line.number('F') > 0) {
            r.on.modal.feed_mm_s = line.number('F') * r.on.modal.unit_mm / 60;
        }
        return target;
    }

    static void move(GcodeSource& r, Line line) {
        ++r.moves;
        Motion& motion = r.on.motion;
        const AxisValues target = target_of(r, line);
        if (target != motion.planned()) {
            motion.stream(target, r.on.modal.feed_mm_s * motion.speed_percent() / 100.0, r.byte);
        }
    }

    static void arc(GcodeSource& r, Line line) {
        ++r.moves;
        ArcSegments::Request request;
        request.from = r.on.motion.planned();
        request.to = target_of(r, line);
        request.i = line.number('I') * r.on.modal.unit_mm;
        request.j = line.number('J') * r.on.modal.unit_mm;
        request.radius = line.number('R') * r.on.modal.unit_mm;
        request.clockwise = line.code == 2;
        request.feed_mm_s = r.on.modal.feed_mm_s;
        r.arc.begin(request);
    }

    static void wait(GcodeSource& r, double seconds) {
        r.wake = r.now + from_seconds(std::clamp(seconds, 0.0, longest_dwell_s));
    }

    static void dwell(GcodeSource& r, Line line) {
        wait(r, line.has('S') ? line.number('S') : line.number('P') / 1000);
    }

    static void home(GcodeSource& r, Line line) {
        r.on.moves.home((line.has('X') ? 1U : 0U) | (line.has('Y') ? 2U : 0U) | (line.has('Z') ? 4U : 0U),
                        r.now);
    }

    static void set_position(GcodeSource& r, Line line) {
        AxisTargets values;
        bool any = false;
        for (std::size_t i = 0; i < axis_count; ++i) {
            if (line.has(axis_letters[i])) {
                values[i] = line.number(axis_letters[i]) * r.on.modal.unit_mm;
                any = true;
            }
        }
        r.on.motion.set_position(any ? values : AxisTargets{0, 0, 0, 0});
    }

    static void wait_for_user(GcodeSource& r, Line line) {
        r.on.job.waits_for_user = true;
        r.on.control.pause_job(line.code == 600);
        r.on.events.raise(event("job.waits_for_user"));
    }

    /// A heater that is not the nozzle in use: a slicer that believes in several hotends switches those off
    /// that it is done with, and the one nozzle of a mixing printer must not go cold from it.
    static bool other_hotend(GcodeSource& r, Line line) {
        return line.has('T') && line.number('S') <= 0 && line.number('T') != r.on.mixer.tool();
    }

    static void target(GcodeSource& r, Line line, HeaterId heater, bool wait) {
        const double c = line.has('S') ? line.number('S') : line.number('R', -1);
        if (c < 0 || (heater == HeaterId::nozzle && other_hotend(r, line))) {
            return;
        }
        GcodeMachine& p = r.on;
        p.thermal.set_target(heater, c);
        if (wait && p.thermal.heating(heater) && !p.thermal.reached(heater)) {
            p.wait.start(heater, r.now, p.events);
        }
    }

    static void fan(GcodeSource& r, Line line, double pwm) {
        const double number = line.number('P');
        const int share = percent(pwm * 100 / 255, 0, 100);
        if (number == 0) {
            r.on.fans.part_percent = share;
        } else if (number == 2) {
            r.on.fans.second_percent = share;
        }
    }

    static void message(GcodeSource& r, Line line) {
        std::string& text = r.on.job.message;
        text.assign(line.text.substr(0, longest_message));
        std::replace_if(
            text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
        r.on.events.raise(event("job.message"));
        wait(r, message_s);  // told before the next one takes its place
    }

    static void mix_weight(GcodeSource& r, Line line) {
        const double channel = line.number('S', -1);
        if (channel >= 0 && channel < 3) {
            r.on.modal.weights[static_cast<std::size_t>(channel)] = line.number('P');
        }
    }

    /// M164 stores what M163 gathered; M165 says the weights itself, by the letters of either dialect.
    static void mix_store(GcodeSource& r, Line) {
        r.on.mixer.set_weights(r.on.modal.weights[0], r.on.modal.weights[1], r.on.modal.weights[2]);
        r.on.modal.weights = {};
    }
    static void mix(GcodeSource& r, Line line) {
        r.on.mixer.set_weights(line.number('A'), line.number('B'), line.number('C'));
    }
    /// M166: mixing that changes with the height, from A to Z mm; S switches it on or off.
    static void mix_gradient(GcodeSource& r, Line line) {
        Mixer& mixer = r.on.mixer;
        if (line.has('A')) {
            mixer.set_start_height(line.number('A'));
        }
        if (line.has('Z')) {
            mixer.set_end_height(line.number('Z'));
        }
        if (line.has('S')) {
            mixer.set_mode(line.number('S') != 0 ? 3 : 0);
        }
    }

    static void acceleration(GcodeSource& r, Line line) {
        Settings& settings = r.on.settings;
        take(line, 'S', settings.acceleration_mm_s2);
        take(line, 'P', settings.acceleration_mm_s2);
        take(line, line.has('R') ? 'R' : 'T', settings.retract_acceleration_mm_s2);
    }
    static void jerk(GcodeSource& r, Line line) {
        Settings& settings = r.on.settings;
        take(line, 'S', settings.min_velocity_mm_s);
        take(line, 'T', settings.min_travel_mm_s);
        take_axes(line, settings.jerk_mm_s, 0);
    }
    static void nothing(GcodeSource&, Line) {}

    static constexpr auto table = std::to_array<GcodeCode>({
        {'G', 0, false, move},
        {'G', 1, false, move},
        {'G', 2, false, arc},
        {'G', 3, false, arc},
        {'G', 4, true, dwell},
        {'G', 20, false, [](GcodeSource& r, Line) { r.on.modal.unit_mm = 25.4; }},
        {'G', 21, false, [](GcodeSource& r, Line) { r.on.modal.unit_mm = 1; }},
        {'G', 28, true, home, true},
        {'G', 29, true, [](GcodeSource& r, Line) { r.on.moves.run("probe_bed", r.now); }, true},
        {'G', 90, false, [](GcodeSource& r, Line) { r.on.motion.set_relative(false); }},
        {'G', 91, false, [](GcodeSource& r, Line) { r.on.motion.set_relative(true); }},
        {'G', 92, false, set_position},
        {'M', 0, true, wait_for_user},
        {'M', 1, true, wait_for_user},
        {'M', 17, true, [](GcodeSource& r, Line) { r.on.motion.set_motors(true); }},
        {'M', 18, true, [](GcodeSource& r, Line) { r.on.motion.set_motors(false); }},
        {'M', 25, true, [](GcodeSource& r, Line) { r.on.control.pause_job(true); }},
        {'M', 82, false, [](GcodeSource& r, Line) { r.on.motion.set_relative_e(false); }},
        {'M', 83, false, [](GcodeSource& r, Line) { r.on.motion.set_relative_e(true); }},
        {'M', 84, true, [](GcodeSource& r, Line) { r.on.motion.set_motors(false); }},
        {'M', 92, false, [](GcodeSource& r, Line line) { take_axes(line, r.on.settings.steps_per_mm, 1); }},
        {'M', 104, false, [](GcodeSource& r, Line line) { target(r, line, HeaterId::nozzle, false); }},
        {'M', 105, false, nothing},
        {'M', 106, false, [](GcodeSource& r, Line line) { fan(r, line, line.number('S', 255)); }},
        {'M', 107, false, [](GcodeSource& r, Line line) { fan(r, line, 0); }},
        {'M', 109, false, [](GcodeSource& r, Line line) { target(r, line, HeaterId::nozzle, true); }},
        {'M', 110, false, nothing},
        {'M', 112, false, [](GcodeSource& r, Line) { r.on.control.emergency_stop(); }},
        {'M', 114, false, nothing},
        {'M', 115, false, nothing},
        {'M', 117, false, message},
        {'M', 140, false, [](GcodeSource& r, Line line) { target(r, line, HeaterId::bed, false); }},
        {'M', 163, false, mix_weight},
        {'M', 164, false, mix_store},
        {'M', 165, false, mix},
        {'M', 166, false, mix_gradient},
        {'M', 190, false, [](GcodeSource& r, Line line) { target(r, line, HeaterId::bed, true); }},
        {'M', 201, false,
         [](GcodeSource& r, Line line) { take_axes(line, r.on.settings.max_acceleration_mm_s2, 1); }},
        {'M', 203, false,
         [](GcodeSource& r, Line line) { take_axes(line, r.on.settings.velocity_mm_s, 0.01); }},
        {'M', 204, false, acceleration},
        {'M', 205, false, jerk},
        {'M', 220, false,
         [](GcodeSource& r,
            Line line) { r.on.motion.set_speed_percent(percent(line.number('S', 100), 10, 999)); }},
        {'M', 221, false,
         [](GcodeSource& r,
            Line line) { r.on.motion.set_flow_percent(percent(line.number('S', 100), 10, 999)); }},
        {'M', 400, true, nothing},
        {'M', 600, true, wait_for_user},
        {'T', 0, false, [](GcodeSource& r, Line) { r.on.mixer.select_tool(0); }},
        {'T', 1, false, [](GcodeSource& r, Line) { r.on.mixer.select_tool(1); }},
        {'T', 2, false, [](GcodeSource& r, Line) { r.on.mixer.select_tool(2); }},
        {'T', 3, false, [](GcodeSource& r, Line) { r.on.mixer.select_tool(3); }},
    });
};

namespace {

constexpr std::size_t most_codes = 1000;

/// For each letter the row of each code, 0 for none: a job asks some hundred thousand times a second.
struct Index {
    std::array<std::array<std::uint8_t, most_codes>, 3> rows{};
};

constexpr std::size_t letter_index(char letter) {
    return letter == 'G' ? 0 : letter == 'M' ? 1 : letter == 'T' ? 2 : 3;
}

consteval Index make_index() {
    Index index;
    for (std::size_t i = 0; i < Codes::table.size(); ++i) {
        const GcodeCode& row = Codes::table[i];
        index.rows[letter_index(row.letter)][static_cast<std::size_t>(row.code)] =
            static_cast<std::uint8_t>(i + 1);
    }
    return index;
}

constexpr Index rows_by_code = make_index();

}  // namespace

const GcodeCode* find_code(char letter, int code) {
    const std::size_t which = letter_index(letter);
    if (which >= rows_by_code.rows.size() || code < 0 || code >= static_cast<int>(most_codes)) {
        return nullptr;
    }
    const std::uint8_t row = rows_by_code.rows[which][static_cast<std::size_t>(code)];
    return row == 0 ? nullptr : &Codes::table[row - 1U];
}

void stream_arc(GcodeSource& source) {
    Motion& motion = source.on.motion;
    motion.stream(source.arc.take(), source.arc.feed_mm_s() * motion.speed_percent() / 100.0, source.byte);
}

}  // namespace fauxboard::filament
