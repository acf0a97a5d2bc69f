// What hosts ask a printer that melts filament: reports, positions in steps, what was probed, texts for
// others.

#include <array>
#include <cmath>

#include "emulator/behaviour/field_rows.h"
#include "emulator/filament/printer.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

using enum behaviour::FieldType;
using behaviour::Value;

constexpr behaviour::FieldRows<Printer> row;

template <Reports::Kind K>
constexpr auto report_get = [](const Printer& p) { return p.reports.seconds(K); };
template <Reports::Kind K>
constexpr auto report_set = [](Printer& p, const Value& v) { p.reports.set(K, v.number, p.now()); };
/// Where the motor of an axis stands.
template <Axis A>
constexpr auto steps = [](const Printer& p) {
    constexpr auto axis = static_cast<std::size_t>(A);
    return std::round(p.motion.executed()[axis] * p.settings.steps_per_mm[axis]);
};
/// What the firmware gives a heater, as half of a byte.
template <HeaterId Id>
constexpr auto pwm = [](const Printer& p) { return std::floor(p.thermal.power(Id) * 127); };
template <std::size_t I>
constexpr auto mesh_point = [](auto& p) -> auto& {
    return p.motion.mesh.mm[I];
};
template <std::size_t I>
constexpr auto size = [](const Printer& p) { return p.config().motion.volume_mm[I]; };
template <auto Value>
constexpr auto series = [](const Printer& p) { return (p.motion.series.*Value)(); };
template <auto Value>
constexpr auto autotuned = [](const Printer& p) { return p.autotuned.*Value; };
template <std::size_t I>
constexpr auto probed = [](const Printer& p) { return p.motion.probed_mm()[I]; };

constexpr std::array table{
    row.handled(
        "host.busy_s", number, "s", 0, 3600, "time after which a waiting host is told so (M113); 0 never",
        [](const Printer& p) { return p.host.busy_s(); },
        [](Printer& p, const Value& v) { p.host.set_busy_s(v.number, p.now()); }),
    row.shown("host.code", integer, "", "number of the code carried out last; -1 for a word",
              [](const Printer& p) { return p.host.code(); }),
    row.shown("host.text", text, "", "what the last M118 is to tell",
              [](const Printer& p) { return std::string_view{p.told.text}; }),
    row.shown("host.text_echo", boolean, "", "behind echo: (M118 E1)",
              [](const Printer& p) { return p.told.echo; }),
    row.shown("host.text_action", boolean, "", "behind // (M118 A1)",
              [](const Printer& p) { return p.told.action; }),
    row.shown("host.text_line", integer, "",
              "0 to all lines, 1 and up to that one, -1 to its sender (M118 P)",
              [](const Printer& p) { return p.told.line; }),
    row.handled("reports.temperatures", number, "s", 0, 3600,
                "interval of report.temperatures (M155); 0 none", report_get<Reports::Kind::temperatures>,
                report_set<Reports::Kind::temperatures>),
    row.handled("reports.position", number, "s", 0, 3600, "interval of report.position (M154); 0 none",
                report_get<Reports::Kind::position>, report_set<Reports::Kind::position>),
    row.handled("reports.job", number, "s", 0, 3600, "interval of report.job (M27 S); 0 none",
                report_get<Reports::Kind::job>, report_set<Reports::Kind::job>),
    row.shown("heaters.nozzle.pwm", integer, "", "output of the nozzle's controller, 0 to 127",
              pwm<HeaterId::nozzle>),
    row.shown("heaters.bed.pwm", integer, "", "output of the bed's controller, 0 to 127", pwm<HeaterId::bed>),
    row.shown("heating.residency", integer, "s",
              "how long the temperature waited for must still hold; -1 while it is not there",
              [](const Printer& p) { return p.wait.residency_left_s(); }),
    row.plain("extruder.cold_allowed", boolean, "", 0, 1, "filament moves through a cold nozzle (M302 P1)",
              FAUXBOARD_PLACE(guard.cold_allowed)),
    row.plain("extruder.min", number, "C", 0, 1000, "below it a nozzle is too cold for filament (M302 S)",
              FAUXBOARD_PLACE(guard.min_c)),
    row.shown("position.steps.x", integer, "steps", "where the motor of X stands", steps<Axis::x>),
    row.shown("position.steps.y", integer, "steps", "where the motor of Y stands", steps<Axis::y>),
    row.shown("position.steps.z", integer, "steps", "where the motor of Z stands", steps<Axis::z>),
    row.shown("position.steps.e", integer, "steps", "where the motor of the extruder stands", steps<Axis::e>),
    row.shown("motion.planner_free", integer, "", "moves that the planner has room for, of 15",
              [](const Printer& p) { return p.motion.planner_free(); }),
    row.shown("machine.size.x", number, "mm", "how far X goes", size<0>),
    row.shown("machine.size.y", number, "mm", "how far Y goes", size<1>),
    row.shown("machine.size.z", number, "mm", "how far Z goes", size<2>),
    row.shown("probe.x", number, "mm", "X of the point probed last", probed<0>),
    row.shown("probe.y", number, "mm", "Y of the point probed last", probed<1>),
    row.shown("probe.z", number, "mm", "height of the bed at the point probed last", probed<2>),
    row.shown("probe.touches", integer, "", "touches made for the M48 under way, or the last",
              series<&ProbeSeries::count>),
    row.shown("probe.touches_wanted", integer, "", "touches that it was asked for",
              series<&ProbeSeries::wanted>),
    row.shown("probe.touch", number, "mm", "what the last of them found", series<&ProbeSeries::last>),
    row.shown("probe.mean", number, "mm", "mean of them", series<&ProbeSeries::mean>),
    row.shown("probe.min", number, "mm", "the lowest of them", series<&ProbeSeries::min>),
    row.shown("probe.max", number, "mm", "the highest of them", series<&ProbeSeries::max>),
    row.shown("probe.range", number, "mm", "between these",
              [](const Printer& p) { return p.motion.series.max() - p.motion.series.min(); }),
    row.shown("probe.deviation", number, "mm", "standard deviation of them", series<&ProbeSeries::deviation>),
    row.shown("autotune.bias", integer, "", "power, of 127, that the last M303 switched around",
              autotuned<&Autotune::bias>),
    row.shown("autotune.d", integer, "", "how far it switched, of 127", autotuned<&Autotune::d>),
    row.shown("autotune.min", number, "C", "lowest temperature of a cycle", autotuned<&Autotune::min_c>),
    row.shown("autotune.max", number, "C", "highest temperature of a cycle", autotuned<&Autotune::max_c>),
    row.shown("autotune.ku", number, "", "ultimate gain", autotuned<&Autotune::ku>),
    row.shown("autotune.tu", number, "s", "ultimate period", autotuned<&Autotune::tu_s>),
    row.shown("autotune.kp", number, "", "P found", autotuned<&Autotune::kp>),
    row.shown("autotune.ki", number, "", "I found", autotuned<&Autotune::ki>),
    row.shown("autotune.kd", number, "", "D found", autotuned<&Autotune::kd>),
    row.stored("leveling.mesh.valid", boolean, "", 0, 1, "the bed has been measured (G29)",
               FAUXBOARD_PLACE(motion.mesh.valid)),
    row.stored("leveling.mesh.z0", number, "mm", -10, 10, "height at the front, left", mesh_point<0>),
    row.stored("leveling.mesh.z1", number, "mm", -10, 10, "height at the front, middle", mesh_point<1>),
    row.stored("leveling.mesh.z2", number, "mm", -10, 10, "height at the front, right", mesh_point<2>),
    row.stored("leveling.mesh.z3", number, "mm", -10, 10, "height in the middle, left", mesh_point<3>),
    row.stored("leveling.mesh.z4", number, "mm", -10, 10, "height in the middle", mesh_point<4>),
    row.stored("leveling.mesh.z5", number, "mm", -10, 10, "height in the middle, right", mesh_point<5>),
    row.stored("leveling.mesh.z6", number, "mm", -10, 10, "height at the back, left", mesh_point<6>),
    row.stored("leveling.mesh.z7", number, "mm", -10, 10, "height at the back, middle", mesh_point<7>),
    row.stored("leveling.mesh.z8", number, "mm", -10, 10, "height at the back, right", mesh_point<8>),
    row.handled(
        "flow.percent", integer, "%", 10, 999, "flow of the extruder (M221)",
        [](const Printer& p) { return p.motion.flow_percent(); },
        [](Printer& p, const Value& v) {
            p.motion.set_flow_percent(static_cast<int>(std::lround(v.number)));
        }),
};

}  // namespace

std::span<const behaviour::Field> host_fields() {
    return table;
}

}  // namespace fauxboard::filament
