// What moves, and what is said about moving.

#include "emulator/filament/gcode_rows.h"

#include <algorithm>

namespace fauxboard::filament::codes {
namespace {

constexpr double probing_travel_mm_s = 100;
constexpr double probing_s = 1.5;
constexpr double probing_lift_mm = 5;
constexpr double most_of_an_arc_e_mm = 1e6;  ///< as one block of the planner's has its longest time

/// Where a G0 to G3 ends; F, if there, stays in force.
AxisValues target_of(GcodeSource& r, Line line) {
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

/// Filament that must not be moved counts as moved, as Marlin has it, and the rest of the line is done.
/// Whether that is so.
bool guard_extrusion(GcodeSource& r, double e_mm) {
    GcodeMachine& p = r.on;
    const double way = std::abs(e_mm - p.motion.planned()[3]);
    if (!p.guard.on || way == 0) {
        return false;
    }
    const bool cold = !p.guard.cold_allowed && p.thermal.sensed_c(HeaterId::nozzle) < p.guard.min_c;
    if (!cold && (p.guard.longest_mm <= 0 || way <= p.guard.longest_mm)) {
        return false;
    }
    p.motion.set_position({std::nullopt, std::nullopt, std::nullopt, e_mm});
    p.events.raise(cold ? event("motion.cold") : event("motion.too_long"));
    return true;
}

void move(GcodeSource& r, Line line) {
    ++r.moves;
    Motion& motion = r.on.motion;
    const AxisValues target = target_of(r, line);
    guard_extrusion(r, target[3]);
    if (target != motion.planned()) {
        motion.stream(target, r.on.modal.feed_mm_s * motion.speed_percent() / 100.0, r.byte);
    }
}

void arc(GcodeSource& r, Line line) {
    ++r.moves;
    ArcSegments::Request request;
    request.from = r.on.motion.planned();
    request.to = target_of(r, line);
    request.i = line.number('I') * r.on.modal.unit_mm;
    request.j = line.number('J') * r.on.modal.unit_mm;
    request.radius = line.number('R') * r.on.modal.unit_mm;
    request.clockwise = line.code == 2;
    request.feed_mm_s = r.on.modal.feed_mm_s;
    if (guard_extrusion(r, request.to[3])) {
        request.from[3] = request.to[3] = r.on.motion.planned()[3];
    }
    request.to[3] = std::clamp(request.to[3], request.from[3] - most_of_an_arc_e_mm,
                               request.from[3] + most_of_an_arc_e_mm);
    if (!r.arc.begin(request)) {
        r.on.events.raise(event("motion.bad_arc"));
    }
}

void dwell(GcodeSource& r, Line line) {
    wait(r, line.has('S') ? line.number('S') : line.number('P') / 1000);
}

void home(GcodeSource& r, Line line) {
    r.on.moves.home((line.has('X') ? 1U : 0U) | (line.has('Y') ? 2U : 0U) | (line.has('Z') ? 4U : 0U), r.now);
}

void set_position(GcodeSource& r, Line line) {
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

/// G30 and M48: to the place named, or where the head is, and down to the bed, so often.
void probe(GcodeSource& r, Line line, int times, EventId done) {
    GcodeMachine& p = r.on;
    const auto at = [&](char axis, std::size_t index) {
        const double offset = p.config.probe_offset_mm[index];
        return line.has(axis) ? line.number(axis) - offset : p.motion.planned()[index];
    };
    Procedure way;
    ProcedureStep step;
    step.kind = ProcedureStep::Kind::to;
    step.feed_mm_s = probing_travel_mm_s;
    step.values = {at('X', 0), at('Y', 1), std::nullopt, std::nullopt};
    way.push_back(step);
    for (int i = 0; i < times; ++i) {
        ProcedureStep touch;
        touch.kind = ProcedureStep::Kind::probe;
        touch.seconds = probing_s;
        touch.repeats = times > 1;
        way.push_back(touch);
        step.kind = ProcedureStep::Kind::by;
        step.values = {std::nullopt, std::nullopt, probing_lift_mm, std::nullopt};
        way.push_back(step);
    }
    ProcedureStep told;
    told.kind = ProcedureStep::Kind::raise;
    told.event = done;
    way.push_back(told);
    p.motion.run(way, r.now, p.events);
}

void probe_once(GcodeSource& r, Line line) {
    probe(r, line, 1, event("motion.probed"));
}

void probe_again_and_again(GcodeSource& r, Line line) {
    const int times = percent(line.number('P', 10), 4, 25);
    r.on.motion.series.begin(times);
    probe(r, line, times, event("motion.repeated"));
}

void probe_bed(GcodeSource& r, Line) {
    r.on.motion.mesh.valid = r.on.moves.run("probe_bed", r.now);
}

/// M220: S sets, B keeps what is, R takes it back; none of them changes nothing.
void speed(GcodeSource& r, Line line) {
    Motion& motion = r.on.motion;
    int& kept = r.on.modal.kept_speed_percent;
    kept = line.has('B') ? motion.speed_percent() : kept;
    if (line.has('R')) {
        motion.set_speed_percent(kept);
    }
    if (line.has('S')) {
        motion.set_speed_percent(percent(line.number('S'), 10, 999));
    }
}

void flow(GcodeSource& r, Line line) {
    if (line.has('S')) {
        r.on.motion.set_flow_percent(percent(line.number('S'), 10, 999));
    }
}

void mix_weight(GcodeSource& r, Line line) {
    const double channel = line.number('S', -1);
    if (channel >= 0 && channel < 3) {
        r.on.modal.weights[static_cast<std::size_t>(channel)] = line.number('P');
    }
}

/// M164 stores what M163 gathered; M165 says the weights itself, by the letters of either dialect.
void mix_store(GcodeSource& r, Line) {
    const auto& weights = r.on.modal.weights;
    r.on.mixer.set_weights(weights[0], weights[1], weights[2]);
    r.on.modal.weights = {};
}
void mix(GcodeSource& r, Line line) {
    r.on.mixer.set_weights(line.number('A'), line.number('B'), line.number('C'));
}
/// M166: mixing that changes with the height, from A to Z mm; S switches it on or off.
void mix_gradient(GcodeSource& r, Line line) {
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

void tool(GcodeSource& r, Line line) {
    r.on.mixer.select_tool(line.code);
}

constexpr auto table = std::to_array<GcodeCode>({
    {'G', 0, room, move},
    {'G', 1, room, move},
    {'G', 2, room, arc},
    {'G', 3, room, arc},
    {'G', 4, rest, dwell},
    {'G', 20, nothing, [](GcodeSource& r, Line) { r.on.modal.unit_mm = 25.4; }},
    {'G', 21, nothing, [](GcodeSource& r, Line) { r.on.modal.unit_mm = 1; }},
    {'G', 28, rest, home, true},
    {'G', 29, rest, probe_bed, true},
    {'G', 27, rest, [](GcodeSource& r, Line) { r.on.moves.run("park_head", r.now); }, true, true},
    {'G', 30, rest, probe_once, true, true},
    {'G', 90, nothing, [](GcodeSource& r, Line) { r.on.motion.set_relative(false); }},
    {'G', 91, nothing, [](GcodeSource& r, Line) { r.on.motion.set_relative(true); }},
    {'G', 92, nothing, set_position},
    {'M', 17, rest, [](GcodeSource& r, Line) { r.on.motion.set_motors(true); }},
    {'M', 18, rest, [](GcodeSource& r, Line) { r.on.motion.set_motors(false); }},
    {'M', 48, rest, probe_again_and_again, true, true},
    {'M', 82, nothing, [](GcodeSource& r, Line) { r.on.motion.set_relative_e(false); }},
    {'M', 83, nothing, [](GcodeSource& r, Line) { r.on.motion.set_relative_e(true); }},
    {'M', 84, rest, [](GcodeSource& r, Line) { r.on.motion.set_motors(false); }},
    {'M', 114, nothing, ignore},
    {'M', 163, nothing, mix_weight},
    {'M', 164, nothing, mix_store},
    {'M', 165, nothing, mix},
    {'M', 166, nothing, mix_gradient},
    {'M', 220, nothing, speed},
    {'M', 221, nothing, flow},
    {'M', 400, rest, ignore},
    {'T', 0, nothing, tool},
    {'T', 1, nothing, tool},
    {'T', 2, nothing, tool},
    {'T', 3, nothing, tool},
});

}  // namespace

std::span<const GcodeCode> motion_codes() {
    return table;
}

}  // namespace fauxboard::filament::codes
