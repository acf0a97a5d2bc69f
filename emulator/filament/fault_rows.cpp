// What can go wrong with a printer that melts filament: a table, and the functions that break a part and mend
// it.

#include <array>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/kind.h"
#include "emulator/filament/printer.h"
#include "emulator/machine/fault_row.h"

namespace fauxboard::filament {
namespace {

using Values = const machine::FaultValues&;
using enum machine::FaultUnit;
using machine::fault_row;
using machine::FaultParameter;

constexpr std::array<std::string_view, 2> heaters{"nozzle", "bed"};
constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};

constexpr FaultParameter heater_parameter{"heater", choice, 0, 0, 1, "which heater", heaters};
constexpr std::array heater_only{heater_parameter};
constexpr std::array dead_parameters{
    heater_parameter, FaultParameter{"power", percent, 0, 0, 100, "what is left of the heater's power"}};
constexpr std::array loose_parameters{
    heater_parameter, FaultParameter{"contact", percent, 50, 0, 100,
                                     "how much of the heat above the room's the sensor still feels"}};
constexpr std::array stuck_parameters{
    heater_parameter,
    FaultParameter{"power", percent, 100, 1, 100, "how much of the heater's power is always on"}};
constexpr std::array tuning_parameters{
    heater_parameter,
    FaultParameter{"target", celsius, 200, 30, 300, "temperature that is tuned at; kept within limits"}};
constexpr std::array axis_only{FaultParameter{"axis", choice, 0, 0, 2, "which axis", axes}};
constexpr std::array jam_parameters{
    FaultParameter{"lost", percent, 100, 1, 100, "how much of what is extruded does not come out"}};
constexpr std::array cold_parameters{
    FaultParameter{"below", celsius, 300, 170, 500, "the nozzle is called too cold below this"}};

constexpr std::array filament_out_event{event("filament.out")};
constexpr std::array filament_too_cold_event{event("filament.too_cold")};
constexpr std::array heating_pid_question_event{event("heating.pid_question")};
constexpr std::array leveling_probe_alarm_event{event("leveling.probe_alarm")};
constexpr std::array motion_homing_failed_event{event("motion.homing_failed")};
constexpr std::array heater_events{event("heater.nozzle_abnormal"), event("heater.bed_abnormal")};

HeaterId heater(Values v) {
    return v[0] == 0 ? HeaterId::nozzle : HeaterId::bed;
}

template <class F>
void trouble(Printer& p, Values v, F change) {
    HeaterTrouble now = p.thermal.trouble(heater(v));
    change(now);
    p.thermal.set_trouble(heater(v), now);
}

void lose_current(Printer& p) {
    p.motion.faults().dead_motors = true;
    p.motors_off();
}

constexpr std::array table{
    fault_row<Printer>(
        "filament_out",
        "the filament runs out of the detector; while printing, an enabled detector pauses the job",
        filament_out_event, "filament.insert (\"filament in\")", {}, never,
        [](Printer& p, Values) { p.set_filament(false); }, [](Printer& p, Values) { p.set_filament(true); },
        [](const Printer& p, Values) { return p.filament.present; }),
    fault_row<Printer>(
        "jam",
        "the extruder turns and the filament stands still (filament.moved); a board notices only by a "
        "detector "
        "that feels motion",
        filament_out_event, "", jam_parameters, never,
        [](Printer& p, Values v) { p.filament_path.lost = v[0] / 100; },
        [](Printer& p, Values) { p.filament_path.lost = 0; }, nullptr),
    fault_row<Printer>(
        "thermistor_open",
        "a sensor's wire breaks: it reads what the profile says of an open one; too cold to be heated",
        heater_events, "", heater_only, never,
        [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.open = true; }); },
        [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.open = false; }); }, nullptr),
    fault_row<Printer>(
        "thermistor_short",
        "a sensor's wires touch: it reads what the profile says of a shorted one; too hot, heaters go off",
        heater_events, "", heater_only, never,
        [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.shorted = true; }); },
        [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.shorted = false; }); }, nullptr),
    fault_row<Printer>(
        "heater_dead",
        "a heater loses its power: found out by what should rise and does not, or falls below its target",
        heater_events, "", dead_parameters, never,
        [](Printer& p, Values v) { trouble(p, v, [&](HeaterTrouble& t) { t.strength = v[1] / 100; }); },
        [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.strength = 1; }); }, nullptr),
    fault_row<Printer>(
        "thermal_runaway",
        "a sensor slips out of what is heated: it reads too little, and the board heats all the more until "
        "it "
        "finds the reading away from its target for too long",
        heater_events, "", loose_parameters, never,
        [](Printer& p, Values v) { trouble(p, v, [&](HeaterTrouble& t) { t.contact = v[1] / 100; }); },
        [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.contact = 1; }); }, nullptr),
    fault_row<Printer>(
        "too_hot",
        "a heater's switch no longer opens: it heats whatever the board wants, until somebody sees to it",
        heater_events, "", stuck_parameters, never,
        [](Printer& p, Values v) { trouble(p, v, [&](HeaterTrouble& t) { t.stuck = v[1] / 100; }); },
        [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.stuck = 0; }); }, nullptr),
    fault_row<Printer>(
        "probe_alarm", "the pin of the 3D Touch is stuck and it blinks; nothing can be probed meanwhile",
        leveling_probe_alarm_event, "the alarm's release (M2120 P1 S2); a reset", {}, never,
        [](Printer& p, Values) {
            p.leveling.probe_alarm = true;
            p.events.raise(event("leveling.probe_alarm"));
        },
        [](Printer& p, Values) { p.leveling.probe_alarm = false; },
        [](const Printer& p, Values) { return !p.leveling.probe_alarm; }),
    fault_row<Printer>(
        "endstop_dead",
        "an end stop (Z: the probe) never triggers: homing goes the whole way of its axis and fails",
        motion_homing_failed_event, "", axis_only, never,
        [](Printer& p, Values v) { p.motion.faults().dead_endstops[static_cast<std::size_t>(v[0])] = true; },
        [](Printer& p, Values v) { p.motion.faults().dead_endstops[static_cast<std::size_t>(v[0])] = false; },
        nullptr),
    fault_row<Printer>(
        "cold_extrusion",
        "the nozzle counts as too cold for filament: loading is refused, and a print extrudes nothing",
        filament_too_cold_event, "", cold_parameters, never, [](Printer& p, Values v) { p.chill(v[0]); },
        [](Printer& p, Values) { p.chill(0); }, nullptr),
    fault_row<Printer>(
        "pid_question",
        "the board tunes the controller of a heater, and asks whether to end that; it is hot meanwhile",
        heating_pid_question_event, "heater.stop_waiting (M108); a reset", tuning_parameters, never,
        [](Printer& p, Values v) { p.start_tuning(heater(v), v[1]); },
        [](Printer& p, Values) { p.stop_tuning(); }, [](const Printer& p, Values) { return !p.tuning; }),
    fault_row<Printer>(
        "motor_off",
        "the motors lose their current: homing is forgotten and cannot be done, while the board goes on "
        "counting moves",
        {}, "", {}, never, [](Printer& p, Values) { lose_current(p); },
        [](Printer& p, Values) { p.motion.faults().dead_motors = false; }, nullptr),
};

}  // namespace

std::span<const machine::FaultInfo> own_faults() {
    return table;
}

}  // namespace fauxboard::filament
