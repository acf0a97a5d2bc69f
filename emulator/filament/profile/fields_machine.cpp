// Heaters, motion, mixing, filament, fans: what moves and warms.

#include <array>
#include <cmath>

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

template <HeaterId Id>
constexpr auto target_get = [](const Printer& p) { return p.thermal.target_c(Id); };
template <HeaterId Id>
constexpr auto target_set = [](Printer& p, const Value& v) { p.thermal.set_target(Id, v.number); };
template <HeaterId Id>
constexpr auto heater_on = [](const Printer& p) { return p.thermal.heating(Id); };
template <HeaterId Id>
constexpr auto true_c = [](const Printer& p) { return p.thermal.temperature_c(Id); };
template <HeaterId Id>
constexpr auto power = [](const Printer& p) { return p.thermal.power(Id) * 100; };
template <ThermalChannel C>
constexpr auto printed = [](const Printer& p) { return p.thermal.printed_c(C); };
template <ThermalChannel C>
constexpr auto whole_c = [](const Printer& p) { return std::round(p.thermal.printed_c(C)); };
template <Axis A>
constexpr auto position = [](const Printer& p) { return p.motion.position(A); };
template <std::size_t I>
constexpr auto share = [](const Printer& p) { return p.mixer.ratio()[I]; };

constexpr std::array table{
    row.shown("heaters.bed.printed", number, "C",
              "bed temperature as the board prints it (folded on boards that fold)",
              printed<ThermalChannel::bed>),
    row.shown("heaters.bed.whole", integer, "C", "heaters.bed.printed, rounded to whole degrees",
              whole_c<ThermalChannel::bed>),
    row.shown("heaters.bed.true", number, "C", "real bed temperature, as its sensor feels it",
              true_c<HeaterId::bed>),
    row.handled("heaters.bed.target", number, "C", 0, 1000,
                "bed target; 0 is off; kept below the machine's own limit", target_get<HeaterId::bed>,
                target_set<HeaterId::bed>),
    row.shown("heaters.bed.on", boolean, "", "the bed has a target", heater_on<HeaterId::bed>),
    row.shown("heaters.bed.power", number, "%", "output of the bed's controller", power<HeaterId::bed>),
    row.shown("heaters.nozzle.printed", number, "C", "nozzle temperature as the board prints it",
              printed<ThermalChannel::t0>),
    row.shown("heaters.nozzle.whole", integer, "C", "heaters.nozzle.printed, rounded to whole degrees",
              whole_c<ThermalChannel::t0>),
    row.shown("heaters.nozzle.true", number, "C", "real nozzle temperature, as its sensor feels it",
              true_c<HeaterId::nozzle>),
    row.handled("heaters.nozzle.target", number, "C", 0, 1000,
                "nozzle target; 0 is off; kept below the machine's own limit", target_get<HeaterId::nozzle>,
                target_set<HeaterId::nozzle>),
    row.shown("heaters.nozzle.on", boolean, "", "the nozzle has a target", heater_on<HeaterId::nozzle>),
    row.shown("heaters.nozzle.power", number, "%", "output of the nozzle's controller",
              power<HeaterId::nozzle>),
    row.shown("heaters.t1.printed", number, "C", "what the input T1 shows, to which no sensor is wired",
              printed<ThermalChannel::t1>),
    row.shown("heaters.t2.printed", number, "C", "what the input T2 shows, to which no sensor is wired",
              printed<ThermalChannel::t2>),
    row.shown("heaters.moved", boolean, "",
              "the measurement before the last one found a printed temperature 1.0 or more away from the "
              "one reported last",
              [](const Printer& p) { return p.thermal.moved_since_report(); }),
    row.shown("heating.waiting", boolean, "", "the board waits for a temperature (M109, M190)",
              [](const Printer& p) { return p.wait.active(); }),
    row.shown("heating.waiting_for_bed", boolean, "", "what is, or was last, waited for is the bed",
              [](const Printer& p) { return p.wait.heater() == HeaterId::bed; }),

    row.shown("position.x", number, "mm", "X: destination of the last move accepted into the planner",
              position<Axis::x>),
    row.shown("position.y", number, "mm", "Y: destination of the last move accepted into the planner",
              position<Axis::y>),
    row.shown("position.z", number, "mm", "Z: destination of the last move accepted, without babystep",
              position<Axis::z>),
    row.shown("position.e", number, "mm", "extruder: destination of the last move accepted",
              position<Axis::e>),
    row.shown("motion.feed", number, "mm/s",
              "feed of the move being executed; keeps its last value when idle",
              [](const Printer& p) { return p.motion.feed_mm_s(); }),
    row.shown("motion.busy", boolean, "", "a move or procedure is under way",
              [](const Printer& p) { return p.motion.busy(); }),
    row.shown("motion.homing", boolean, "", "axes are being run into their end stops",
              [](const Printer& p) { return p.motion.homing(); }),
    row.shown("motion.homed", boolean, "", "X, Y and Z were homed since the motors were switched on",
              [](const Printer& p) { return p.motion.homed(); }),
    row.handled(
        "motion.relative", boolean, "", 0, 1, "moves are relative (G91) instead of absolute (G90)",
        [](const Printer& p) { return p.motion.relative(); },
        [](Printer& p, const Value& v) { p.motion.set_relative(v.number != 0); }),
    row.handled(
        "motors.enabled", boolean, "", 0, 1, "the stepper motors hold; switching them off forgets the homing",
        [](const Printer& p) { return p.motion.motors(); },
        [](Printer& p, const Value& v) { p.motion.set_motors(v.number != 0); }),
    row.handled(
        "babystep.z", number, "mm", -10, 10, "live Z offset (M290)",
        [](const Printer& p) { return p.motion.babystep_mm(); },
        [](Printer& p, const Value& v) {
            p.motion.set_babystep(v.number);
            p.events.raise(event("babystep.changed"));
        }),
    row.handled(
        "speed.percent", integer, "%", 10, 999, "print speed (M220)",
        [](const Printer& p) { return p.motion.speed_percent(); },
        [](Printer& p, const Value& v) {
            p.motion.set_speed_percent(static_cast<int>(std::lround(v.number)));
        }),

    row.plain("fans.part", integer, "%", 0, 100, "part cooling fan", FAUXBOARD_PLACE(fans.part_percent)),
    row.plain("fans.second", integer, "%", 0, 100, "second fan (M106 P2)",
              FAUXBOARD_PLACE(fans.second_percent)),
    row.handled(
        "fans.board", integer, "%", 0, 100,
        "fan of the control board: a fixed speed, or one of its own; set, it holds until that changes",
        [](const Printer& p) { return p.board_fan_percent(); },
        [](Printer& p, const Value& v) { p.set_board_fan(static_cast<int>(std::lround(v.number))); }),

    row.shown("mixer.packed", integer, "", "mixing ratio as the line packs it: A + 256 B + 65536 C, percents",
              [](const Printer& p) { return pack(p.mixer.ratio()); }),
    row.shown("mixer.a", integer, "%", "share of extruder 1", share<0>),
    row.shown("mixer.b", integer, "%", "share of extruder 2", share<1>),
    row.shown("mixer.c", integer, "%", "share of extruder 3", share<2>),
    row.shown("mixer.tool", integer, "", "tool chosen by T0 to T3",
              [](const Printer& p) { return p.mixer.tool(); }),
    row.shown("mixer.mode", integer, "", "0 off, 1 fixed ratio, 2 and 3 template",
              [](const Printer& p) { return p.mixer.mode(); }),
    row.shown("mixer.mode_shown", integer, "", "mode as L22 tells it: mode x 256",
              [](const Printer& p) { return p.mixer.mode() * 256; }),
    row.shown("mixer.template", integer, "", "template chosen by M2136, 0 none",
              [](const Printer& p) { return p.mixer.template_number(); }),
    row.shown("mixer.start", integer, "", "ratio at the start of the template, packed",
              [](const Printer& p) { return pack(p.mixer.start()); }),
    row.shown("mixer.end", integer, "", "ratio at the end of the template, packed",
              [](const Printer& p) { return pack(p.mixer.end()); }),
    row.shown("mixer.start_height", number, "mm", "height at which the template starts",
              [](const Printer& p) { return p.mixer.start_height_mm(); }),
    row.shown("mixer.end_height", number, "mm", "height at which the template ends",
              [](const Printer& p) { return p.mixer.end_height_mm(); }),

    row.stored("filament.detector", boolean, "", 0, 1, "the filament detector is switched on",
               FAUXBOARD_PLACE(filament.detector)),
    row.handled(
        "filament.present", boolean, "", 0, 1, "filament is in the detector",
        [](const Printer& p) { return p.filament.present; },
        [](Printer& p, const Value& v) { p.set_filament(v.number != 0); }),
    row.shown("filament.code", integer, "", "FT of L3: 255 detector off, 1 filament, 0 none",
              [](const Printer& p) { return p.filament_code(); }),
    row.shown("filament.running", boolean, "", "loading, unloading or cleaning is under way",
              [](const Printer& p) { return p.feeder.mode() != Feeder::Mode::idle; }),
};

}  // namespace

std::span<const behaviour::Field> machine_fields() {
    return table;
}

}  // namespace fauxboard::filament
