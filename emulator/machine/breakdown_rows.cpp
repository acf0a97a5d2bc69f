// What can go wrong with a machine: a table, and the functions that break a part and mend it.

#include <array>

#include "emulator/machine/breakdowns.h"
#include "emulator/machine/printer.h"

namespace fauxboard::machine {
namespace {

using Values = const BreakdownValues&;
using enum BreakdownUnit;

constexpr std::array<std::string_view, 2> heaters{"nozzle", "bed"};
constexpr std::array<std::string_view, 2> disks{"sd", "udisk"};
constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};

constexpr BreakdownParameter heater_parameter{"heater", choice, 0, 0, 1, "which heater", heaters};
constexpr std::array heater_only{heater_parameter};
constexpr std::array dead_parameters{
    heater_parameter, BreakdownParameter{"power", percent, 0, 0, 100, "what is left of the heater's power"}};
constexpr std::array loose_parameters{
    heater_parameter, BreakdownParameter{"contact", percent, 50, 0, 100,
                                         "how much of the heat above the room's the sensor still feels"}};
constexpr std::array stuck_parameters{
    heater_parameter,
    BreakdownParameter{"power", percent, 100, 1, 100, "how much of the heater's power is always on"}};
constexpr std::array tuning_parameters{
    heater_parameter,
    BreakdownParameter{"target", celsius, 200, 30, 300, "temperature that is tuned at; kept within limits"}};
constexpr std::array disk_only{BreakdownParameter{"disk", choice, 0, 0, 1, "which disk", disks}};
constexpr std::array axis_only{BreakdownParameter{"axis", choice, 0, 0, 2, "which axis", axes}};
constexpr std::array jam_parameters{
    BreakdownParameter{"lost", percent, 100, 1, 100, "how much of what is extruded does not come out"}};
constexpr std::array cold_parameters{
    BreakdownParameter{"below", celsius, 300, 170, 500, "the nozzle is called too cold below this"}};

constexpr std::array<std::string_view, 2> ways{"piece", "answer"};
constexpr std::array lost_parameters{
    BreakdownParameter{"what", choice, 0, 0, 1,
                       "a piece of an upload, or what the board answers to it; a block of a download is both",
                       ways},
    BreakdownParameter{"share", percent, 10, 1, 100, "how many of them"}};
constexpr std::array share_only{BreakdownParameter{"share", percent, 10, 1, 100, "how many of them"}};

template <EventId... Ids>
constexpr std::array raises{Ids...};
constexpr const auto& heater_events = raises<EventId::heater_nozzle_abnormal, EventId::heater_bed_abnormal>;
constexpr const auto& missing_events = raises<EventId::file_missing, EventId::job_file_lost>;
constexpr const auto& unreadable_events = raises<EventId::file_unreadable, EventId::job_file_unreadable>;

HeaterId heater(Values v) {
    return v[0] == 0 ? HeaterId::nozzle : HeaterId::bed;
}
int disk(Values v) {
    return static_cast<int>(v[0]);
}

/// Changes what is wrong with the heater that the values name.
template <class F>
void trouble(Printer& p, Values v, F change) {
    HeaterTrouble now = p.thermal.trouble(heater(v));
    change(now);
    p.thermal.set_trouble(heater(v), now);
}

void file_trouble(Printer& p, Volume::Kind kind) {
    p.storage.set_file_trouble(kind);
}

double& lost_share(Printer& p, Values v) {
    Transfer::Trouble& trouble = p.transfer.trouble;
    return v[0] == 0 ? trouble.lost : trouble.answers_lost;
}

void ask_for_user(Printer& p, Values) {
    p.job.waits_for_user = true;
    if (p.job.status() == JobStatus::printing && !p.job.pausing()) {
        p.pause_job(false);
    }
    p.events.raise(EventId::job_waits_for_user);
}

void lose_current(Printer& p, Values) {
    p.motion.faults().dead_motors = true;
    p.motors_off();
}

constexpr std::array<BreakdownInfo, breakdown_count> table{{
    {BreakdownId::filament_out,
     "filament_out",
     "the filament runs out of the detector; while printing, an enabled detector pauses the job",
     raises<EventId::filament_out>,
     "filament.insert (\"filament in\")",
     {},
     never,
     [](Printer& p, Values) { p.set_filament(false); },
     [](Printer& p, Values) { p.set_filament(true); },
     [](const Printer& p, Values) { return p.filament.present; }},
    {BreakdownId::jam, "jam",
     "the extruder turns and the filament stands still (filament.moved); a board notices only by a detector "
     "that feels motion",
     raises<EventId::filament_out>, "", jam_parameters, never,
     [](Printer& p, Values v) { p.filament_path.lost = v[0] / 100; },
     [](Printer& p, Values) { p.filament_path.lost = 0; }, nullptr},
    {BreakdownId::card_removed, "card_removed", "a disk is pulled out; a job that prints from it pauses",
     raises<EventId::card_removed>, "card.insert, udisk.insert (\"card in\")", disk_only, never,
     [](Printer& p, Values v) { p.remove_card(disk(v)); },
     [](Printer& p, Values v) { p.insert_card(disk(v)); },
     [](const Printer& p, Values v) { return p.storage.usable(disk(v)); }},
    {BreakdownId::card_failed, "card_failed",
     "a disk stays in its slot and can no longer be read; a job that prints from it pauses",
     raises<EventId::card_failed>, "card.insert, udisk.insert (\"card in\")", disk_only, never,
     [](Printer& p, Values v) { p.fail_card(disk(v)); }, [](Printer& p, Values v) { p.insert_card(disk(v)); },
     [](const Printer& p, Values v) { return p.storage.usable(disk(v)); }},
    {BreakdownId::file_missing,
     "file_missing",
     "files are still listed, and are not there when they are selected or read on; a job that prints pauses",
     missing_events,
     "",
     {},
     never,
     [](Printer& p, Values) { file_trouble(p, Volume::Kind::missing); },
     [](Printer& p, Values) { file_trouble(p, Volume::Kind::file); },
     nullptr},
    {BreakdownId::file_unreadable,
     "file_unreadable",
     "files cannot be opened or read on; a job that prints pauses",
     unreadable_events,
     "",
     {},
     never,
     [](Printer& p, Values) { file_trouble(p, Volume::Kind::unreadable); },
     [](Printer& p, Values) { file_trouble(p, Volume::Kind::file); },
     nullptr},
    {BreakdownId::thermistor_open, "thermistor_open",
     "a sensor's wire breaks: it reads what the profile says of an open one; too cold to be heated",
     heater_events, "", heater_only, never,
     [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.open = true; }); },
     [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.open = false; }); }, nullptr},
    {BreakdownId::thermistor_short, "thermistor_short",
     "a sensor's wires touch: it reads what the profile says of a shorted one; too hot, heaters go off",
     heater_events, "", heater_only, never,
     [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.shorted = true; }); },
     [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.shorted = false; }); }, nullptr},
    {BreakdownId::heater_dead, "heater_dead",
     "a heater loses its power: found out by what should rise and does not, or falls below its target",
     heater_events, "", dead_parameters, never,
     [](Printer& p, Values v) { trouble(p, v, [&](HeaterTrouble& t) { t.strength = v[1] / 100; }); },
     [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.strength = 1; }); }, nullptr},
    {BreakdownId::thermal_runaway, "thermal_runaway",
     "a sensor slips out of what is heated: it reads too little, and the board heats all the more until it "
     "finds the reading away from its target for too long",
     heater_events, "", loose_parameters, never,
     [](Printer& p, Values v) { trouble(p, v, [&](HeaterTrouble& t) { t.contact = v[1] / 100; }); },
     [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.contact = 1; }); }, nullptr},
    {BreakdownId::too_hot, "too_hot",
     "a heater's switch no longer opens: it heats whatever the board wants, until somebody sees to it",
     heater_events, "", stuck_parameters, never,
     [](Printer& p, Values v) { trouble(p, v, [&](HeaterTrouble& t) { t.stuck = v[1] / 100; }); },
     [](Printer& p, Values v) { trouble(p, v, [](HeaterTrouble& t) { t.stuck = 0; }); }, nullptr},
    {BreakdownId::probe_alarm,
     "probe_alarm",
     "the pin of the 3D Touch is stuck and it blinks; nothing can be probed meanwhile",
     raises<EventId::leveling_probe_alarm>,
     "the alarm's release (M2120 P1 S2); a reset",
     {},
     never,
     [](Printer& p, Values) {
         p.leveling.probe_alarm = true;
         p.events.raise(EventId::leveling_probe_alarm);
     },
     [](Printer& p, Values) { p.leveling.probe_alarm = false; },
     [](const Printer& p, Values) { return !p.leveling.probe_alarm; }},
    {BreakdownId::endstop_dead, "endstop_dead",
     "an end stop (Z: the probe) never triggers: homing goes the whole way of its axis and fails",
     raises<EventId::motion_homing_failed>, "", axis_only, never,
     [](Printer& p, Values v) { p.motion.faults().dead_endstops[static_cast<std::size_t>(v[0])] = true; },
     [](Printer& p, Values v) { p.motion.faults().dead_endstops[static_cast<std::size_t>(v[0])] = false; },
     nullptr},
    {BreakdownId::cold_extrusion, "cold_extrusion",
     "the nozzle counts as too cold for filament: loading is refused, and a print extrudes nothing",
     raises<EventId::filament_too_cold>, "", cold_parameters, never,
     [](Printer& p, Values v) { p.chill(v[0]); }, [](Printer& p, Values) { p.chill(0); }, nullptr},
    {BreakdownId::refused,
     "refused",
     "the board takes itself for printing and refuses to select a file or to start one",
     raises<EventId::job_refused>,
     "a reset",
     {},
     never,
     [](Printer& p, Values) { p.refusing = true; },
     [](Printer& p, Values) { p.refusing = false; },
     [](const Printer& p, Values) { return !p.refusing; }},
    {BreakdownId::pid_question, "pid_question",
     "the board tunes the controller of a heater, and asks whether to end that; it is hot meanwhile",
     raises<EventId::heating_pid_question>, "heater.stop_waiting (M108); a reset", tuning_parameters, never,
     [](Printer& p, Values v) { p.start_tuning(heater(v), v[1]); },
     [](Printer& p, Values) { p.stop_tuning(); }, [](const Printer& p, Values) { return !p.tuning; }},
    {BreakdownId::wait_for_user,
     "wait_for_user",
     "the board waits for the user to continue; a job that prints pauses where it is",
     raises<EventId::job_waits_for_user>,
     "job.continue (M0, M108); a reset",
     {},
     never,
     ask_for_user,
     [](Printer& p, Values) { p.user_continues(); },
     [](const Printer& p, Values) { return !p.job.waits_for_user; }},
    {BreakdownId::motor_off,
     "motor_off",
     "the motors lose their current: homing is forgotten and cannot be done, while the board goes on "
     "counting moves",
     {},
     "",
     {},
     never,
     lose_current,
     [](Printer& p, Values) { p.motion.faults().dead_motors = false; },
     nullptr},
    {BreakdownId::hang,
     "hang",
     "the board's program stands still: it hears and says nothing, and its heaters stay as they are; its "
     "end, by \"for\" or by taking it away, is a reset, as by a watchdog",
     {},
     "board.reset (\"board reset\")",
     {},
     never,
     [](Printer& p, Values) { p.hang(true); },
     [](Printer& p, Values) { p.request_reset(); },
     [](const Printer& p, Values) { return !p.hung(); }},
    {BreakdownId::board_reset,
     "board_reset",
     "the board restarts; a job is lost",
     {},
     "",
     {},
     never,
     [](Printer& p, Values) { p.request_reset(); },
     nullptr,
     nullptr},
    {BreakdownId::brown_out,
     "brown_out",
     "the supply breaks down, for half a second unless \"for\" says otherwise; the board notices in time to "
     "keep its job, and then restarts",
     raises<EventId::power_lost>,
     "",
     {},
     SimTime{500'000},
     [](Printer& p, Values) {
         p.events.raise(EventId::power_lost);
         p.hang(false);
     },
     [](Printer& p, Values) { p.request_reset(); },
     [](const Printer& p, Values) { return !p.hung(); }},
    {BreakdownId::chunk_lost,
     "chunk_lost",
     "the network loses pieces of files, up or down, or the answers to them: their sender has to notice",
     {},
     "",
     lost_parameters,
     never,
     [](Printer& p, Values v) { lost_share(p, v) = v[1] / 100; },
     [](Printer& p, Values v) { lost_share(p, v) = 0; },
     nullptr},
    {BreakdownId::chunk_damaged,
     "chunk_damaged",
     "pieces of files arrive damaged: the board asks for one again (resend), a client has to find it out",
     {},
     "",
     share_only,
     never,
     [](Printer& p, Values v) { p.transfer.trouble.damaged = v[0] / 100; },
     [](Printer& p, Values) { p.transfer.trouble.damaged = 0; },
     nullptr},
    {BreakdownId::chunk_repeated,
     "chunk_repeated",
     "pieces of files arrive twice: the board does not write the second (resend), a client must not",
     {},
     "",
     share_only,
     never,
     [](Printer& p, Values v) { p.transfer.trouble.repeated = v[0] / 100; },
     [](Printer& p, Values) { p.transfer.trouble.repeated = 0; },
     nullptr},
}};

consteval bool ordered() {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (static_cast<std::size_t>(table[i].id) != i ||
            table[i].parameters.size() > BreakdownValues{}.size()) {
            return false;
        }
    }
    return true;
}
static_assert(ordered(), "the table stands in the order of BreakdownId, and all values fit");

}  // namespace

std::span<const BreakdownInfo> breakdowns() {
    return table;
}

}  // namespace fauxboard::machine
