// The keys of a profile's `machine` that only a printer which melts filament has.

#include <algorithm>
#include <array>

#include "emulator/behaviour/nearest.h"
#include "emulator/filament/kind.h"
#include "emulator/filament/names.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

using behaviour::Findings;
using behaviour::found;
using behaviour::Json;
using behaviour::nearest;
using behaviour::ObjectReader;

constexpr double huge = 1e6;
constexpr std::array<std::string_view, 4> axis_names{"x", "y", "z", "e"};
constexpr std::size_t max_procedure_steps = 60;  // Motion queues at most 64

/// Milliseconds in the file, SimTime in the machine.
void milliseconds(ObjectReader& reader, std::string_view key, SimTime& out, double min, double max) {
    double ms = static_cast<double>(out.count()) / 1000;
    reader.number(key, ms, min, max);
    out = from_seconds(ms / 1000);
}

void load_plant(const Json& node, const std::string& pointer, Findings& findings, PlantConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("heating_k_per_s", out.heating_k_per_s, 0, 100);
    reader.number("exchange_a_per_s", out.exchange_a_per_s, 0, 10);
    reader.number("exchange_b_per_s", out.exchange_b_per_s, 0, 10);
    reader.number("loss_behind_per_s", out.loss_behind_per_s, 0, 10);
    reader.number("loss_on_per_s", out.loss_on_per_s, 0, 10);
    reader.number("loss_off_per_s", out.loss_off_per_s, 0, 10);
    reader.number("sensor_lag_s", out.sensor_lag_s, 0.01, 600);
    reader.number("dead_time_s", out.dead_time_s, 0, 60);
    reader.number("ambient_c", out.ambient_c, -50, 100);
    reader.integer("counts_per_c", out.counts_per_c, 1, 1000);
    reader.number("noise_c", out.noise_c, 0, 10);
    reader.number("first_reading_offset_c", out.first_reading_offset_c, -10, 10);
    reader.finish();
}

void load_pid(const Json& node, const std::string& pointer, Findings& findings, PidConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("kp", out.kp, 0, huge);
    reader.number("ki", out.ki, 0, huge);
    reader.number("kd", out.kd, 0, huge);
    reader.number("k1", out.k1, 0, 1);
    reader.number("range_c", out.range_c, 0, 500);
    reader.number("off_below_c", out.off_below_c, 0, 500);
    reader.number("max_output", out.max_output, 1, huge);
    reader.finish();
}

void load_protection(const Json& node, const std::string& pointer, Findings& findings,
                     ProtectionConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("min_c", out.min_c, -100, 1000);
    reader.number("max_c", out.max_c, 0, 1000);
    reader.number("watch_s", out.watch_s, 0.1, 3600);
    reader.number("watch_rise_c", out.watch_rise_c, 0, 100);
    reader.boolean("any_change", out.any_change);
    reader.number("runaway_s", out.runaway_s, 0.1, 3600);
    reader.number("runaway_c", out.runaway_c, 0, 500);
    reader.number("open_reads_c", out.open_reads_c, -300, 2000);
    reader.number("shorted_reads_c", out.shorted_reads_c, -300, 2000);
    reader.finish();
}

/// A heater must be able to reach its highest target, and to swing over it, without being called too hot.
void check_too_hot(ObjectReader& reader, Findings& findings, HeaterConfig& out) {
    constexpr double swing_k = 15;
    const Json* protection = reader.get("protection");
    if (protection == nullptr || !protection->is_object() || !protection->contains("max_c")) {
        out.protection.max_c = std::max(out.protection.max_c, out.max_target_c + swing_k);
    } else if (out.protection.max_c <= out.max_target_c) {
        findings.add(reader.pointer("protection") + "/max_c",
                     "a heater is too hot above this; expected more than its max_target_c");
    }
}

void load_heater(const Json& node, const std::string& pointer, Findings& findings, HeaterConfig& out) {
    ObjectReader reader(node, pointer, findings);
    if (const Json* plant = reader.get("plant")) {
        load_plant(*plant, reader.pointer("plant"), findings, out.plant);
    }
    if (const Json* pid = reader.get("pid")) {
        load_pid(*pid, reader.pointer("pid"), findings, out.pid);
    }
    if (const Json* protection = reader.get("protection")) {
        load_protection(*protection, reader.pointer("protection"), findings, out.protection);
    }
    reader.number("max_target_c", out.max_target_c, 0, 1000);
    reader.boolean("clamps", out.clamps);
    reader.number("done_within_c", out.done_within_c, 0, 100);
    check_too_hot(reader, findings, out);
    reader.finish();
}

void load_input(const Json& node, const std::string& pointer, Findings& findings,
                SensorlessInputConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("noise_c", out.noise_c, 0, 100);
    reader.number("noise_wander_s", out.noise_wander_s, 0, 3600);
    reader.integer("counts_per_c", out.counts_per_c, 1, 1000);
    const Json* points = reader.get("points");
    reader.finish();
    if (points == nullptr) {
        return;
    }
    if (!points->is_array() || points->empty() || points->size() > 256) {
        findings.add(reader.pointer("points"),
                     found(*points) + "; expected 1 to 256 pairs [source C, value C]");
        return;
    }
    out.points.clear();
    for (std::size_t i = 0; i < points->size(); ++i) {
        const Json& point = (*points)[i];
        const std::string at = reader.pointer("points") + "/" + std::to_string(i);
        if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number()) {
            findings.add(at, found(point) + "; expected a pair [source C, value C]");
            continue;
        }
        if (!out.points.empty() && point[0].get<double>() < out.points.back().source_c) {
            findings.add(at, "the source temperatures must not fall from pair to pair");
        }
        out.points.push_back({point[0].get<double>(), point[1].get<double>()});
    }
}

void load_thermal(const Json& node, const std::string& pointer, Findings& findings, ThermalConfig& out) {
    ObjectReader reader(node, pointer, findings);
    milliseconds(reader, "period_ms", out.period, 10, 10000);
    reader.unsigned_integer("warm_up_measurements", out.warm_up_measurements, 0, 1000);
    constexpr std::array<std::string_view, 2> printed{"true", "folded"};
    std::size_t fold = out.fold ? 1 : 0;
    reader.choice("printed", printed, fold);
    out.fold = fold == 1;
    for (const auto& [key, heater] : {std::pair{"nozzle", &out.nozzle}, std::pair{"bed", &out.bed}}) {
        if (const Json* value = reader.get(key)) {
            load_heater(*value, reader.pointer(key), findings, *heater);
        }
    }
    for (const auto& [key, input] : {std::pair{"t1", &out.t1}, std::pair{"t2", &out.t2}}) {
        if (const Json* value = reader.get(key)) {
            load_input(*value, reader.pointer(key), findings, *input);
        }
    }
    reader.finish();
}

/// "xyz" -> those axes present, value 0.
void load_axis_letters(ObjectReader& reader, std::string_view key, Findings& findings, ProcedureStep& step) {
    std::string letters;
    reader.text(key, letters, 8);
    for (const char c : letters) {
        if (c < 'x' || c > 'z') {
            findings.add(reader.pointer(key),
                         "found the text \"" + letters + "\"; expected letters out of x, y and z");
            return;
        }
        step.values[static_cast<std::size_t>(c - 'x')] = 0;
    }
}

void load_raise(ObjectReader& reader, Findings& findings, ProcedureStep& step) {
    std::string name;
    reader.text("raise", name);
    if (const auto event = machine::find_event(name)) {
        step.event = *event;
        return;
    }
    std::vector<std::string_view> names;
    for (const machine::EventId event : machine::events_of(own_kind)) {
        names.push_back(event->name);
    }
    findings.add(reader.pointer("raise"), "unknown event \"" + name + '"', std::string(nearest(name, names)));
}

ProcedureStep load_step(const Json& node, const std::string& pointer, Findings& findings) {
    using Kind = ProcedureStep::Kind;
    struct Verb {
        std::string_view key;
        Kind kind;
    };
    constexpr std::array verbs{Verb{"zero", Kind::zero},   Verb{"home", Kind::home},
                               Verb{"to", Kind::to},       Verb{"by", Kind::by},
                               Verb{"probe", Kind::probe}, Verb{"homed", Kind::homed},
                               Verb{"wait_s", Kind::wait}, Verb{"lose_rounds", Kind::lose_rounds},
                               Verb{"raise", Kind::raise}};
    ProcedureStep step;
    ObjectReader reader(node, pointer, findings);
    std::size_t count = 0;
    for (const Verb& verb : verbs) {
        if (reader.has(verb.key)) {
            step.kind = verb.kind;
            ++count;
        }
    }
    if (count != 1) {
        findings.add(pointer, std::to_string(count) +
                                  " verbs; expected exactly one of zero, home, to, by, probe, homed, "
                                  "wait_s, lose_rounds, raise");
        return step;
    }
    reader.number("feed_mm_s", step.feed_mm_s, 0, 10000);
    reader.number("seconds", step.seconds, 0, 3600);
    constexpr std::array<std::string_view, 2> probes{"measure", "reference"};
    std::size_t probe = 0;
    switch (step.kind) {
        case Kind::zero:
            load_axis_letters(reader, "zero", findings, step);
            break;
        case Kind::home:
            load_axis_letters(reader, "home", findings, step);
            reader.boolean("together", step.together);
            reader.number("bump_s", step.bump_s, 0, 60);
            break;
        case Kind::homed:
            load_axis_letters(reader, "homed", findings, step);
            break;
        case Kind::to:
            reader.axes("to", axis_names, step.values, -2000, 2000);
            break;
        case Kind::by:
            reader.axes("by", axis_names, step.values, -2000, 2000);
            break;
        case Kind::probe:
            reader.choice("probe", probes, probe);
            reader.integer("point", step.mesh_point, 0, 8);
            break;
        case Kind::wait:
            reader.number("wait_s", step.seconds, 0, 3600);
            break;
        case Kind::lose_rounds:
            reader.integer("lose_rounds", step.rounds, 0, 100);
            break;
        case Kind::raise:
            load_raise(reader, findings, step);
            break;
    }
    step.reference = probe == 1;
    reader.finish();
    return step;
}

void load_procedures(const Json& node, const std::string& pointer, Findings& findings, MotionConfig& out) {
    ObjectReader reader(node, pointer, findings);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, steps] : node.items()) {
        if (name == "comment") {
            continue;
        }
        const std::string at = reader.pointer(name);
        if (!steps.is_array() || steps.size() > max_procedure_steps) {
            findings.add(at, found(steps) + "; expected a list of at most 60 steps");
            continue;
        }
        Procedure procedure;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            procedure.push_back(load_step(steps[i], at + "/" + std::to_string(i), findings));
        }
        out.procedures[name] = std::move(procedure);
    }
}

void load_motion(const Json& node, const std::string& pointer, Findings& findings, MotionConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.numbers("volume_mm", out.volume_mm, 1, 5000);
    reader.numbers("power_on_position_mm", out.power_on_mm, 0, 5000);
    reader.number("homing_feed_mm_s", out.homing_feed_mm_s, 0.1, 1000);
    reader.number("homing_bump_s", out.homing_bump_s, 0, 60);
    reader.unsigned_integer("planner_blocks", out.planner_blocks, 1, 64);
    reader.number("default_feed_mm_s", out.default_feed_mm_s, 0.1, 1000);
    reader.number("probe_trigger_mm", out.probe_trigger_mm, -50, 50);
    reader.numbers("probe_offset_mm", out.probe_offset_mm, -500, 500);
    reader.number("probe_spread_mm", out.probe_spread_mm, 0, 1);
    reader.number("idle_off_s", out.idle_off_s, 0, 86400);
    if (const Json* mesh = reader.get("bed_mesh_mm")) {
        ObjectReader rows(*mesh, reader.pointer("bed_mesh_mm"), findings);
        for (const auto& [key, row] :
             {std::pair{"front", std::size_t{0}}, std::pair{"middle", std::size_t{1}},
              std::pair{"back", std::size_t{2}}}) {
            rows.numbers(key, out.bed_mesh_mm[row], -10, 10);
        }
        rows.finish();
    }
    if (const Json* procedures = reader.get("procedures")) {
        load_procedures(*procedures, reader.pointer("procedures"), findings, out);
    }
    reader.finish();
}

void load_filament(const Json& node, const std::string& pointer, Findings& findings, FilamentConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("piece_s", out.piece_s, 0.01, 600);
    reader.number("piece_commit_s", out.piece_commit_s, 0, 600);
    reader.integer("feed_mm_s", out.feed_mm_s, 0, 1000);
    reader.number("min_extrude_c", out.min_extrude_c, 0, 500);
    reader.number("detector_mm", out.detector_mm, 0, 10000);
    reader.finish();
}

void load_job(const Json& node, const std::string& pointer, Findings& findings, Config& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("finished_s", out.job.finished_s, 0, 86400);
    reader.boolean("ends_idle", out.ends_idle);
    reader.boolean("pause_at_once", out.job.pause_at_once);
    reader.boolean("cut_off_is_paused", out.job.cut_off_is_paused);
    reader.boolean("resume_homes_first", out.job.resume_homes_first);
    reader.finish();
}

void load_board_fan(const Json& node, const std::string& pointer, Findings& findings, BoardFanConfig& out) {
    out.automatic = true;
    ObjectReader reader(node, pointer, findings);
    reader.integer("idle_percent", out.idle_percent, 0, 100);
    reader.integer("busy_percent", out.busy_percent, 0, 100);
    reader.number("nozzle_c", out.nozzle_c, 0, 500);
    reader.number("bed_c", out.bed_c, 0, 500);
    reader.number("starts_s", out.starts_s, 0, 60);
    reader.finish();
}

}  // namespace

void load_config(ObjectReader& reader, Findings& findings, Config& config) {
    const auto part = [&](std::string_view key, auto load, auto& out) {
        if (const Json* node = reader.get(key)) {
            load(*node, reader.pointer(key), findings, out);
        }
    };
    part("thermal", load_thermal, config.thermal);
    part("motion", load_motion, config.motion);
    part("filament", load_filament, config.filament);
    part("job", load_job, config);
    part("board_fan", load_board_fan, config.board_fan);
    if (const Json* node = reader.get("heating")) {
        ObjectReader heating(*node, reader.pointer("heating"), findings);
        heating.number("report_s", config.heating.report_s, 0, 3600);
        heating.number("residency_s", config.heating.residency_s, 0, 3600);
        heating.number("hysteresis_c", config.heating.hysteresis_c, 0, 100);
        heating.finish();
    }
    if (const Json* node = reader.get("extrusion")) {
        ObjectReader extrusion(*node, reader.pointer("extrusion"), findings);
        extrusion.boolean("guarded", config.extrusion.guarded);
        extrusion.number("longest_mm", config.extrusion.longest_mm, 0, huge);
        extrusion.finish();
    }
    reader.integer("board_fan_percent", config.board_fan.percent, 0, 100);
    reader.integer("part_fan_least_pwm", config.board_fan.least_pwm, 0, 255);
    reader.number("manual_level_start_mm", config.manual_level_start_mm, 0, 500);
}

}  // namespace fauxboard::filament
