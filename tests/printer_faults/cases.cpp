#include "tests/printer_faults/cases.h"

namespace fauxboard::testing {
namespace {

// Before: what is under way at 300 s.

void print(Rig& rig) {
    rig.do_it({{"op", "world"}, {"do", "filament in"}});
    rig.press("M23 long.gcode");
    rig.press("M24");
}
void heat_nozzle(Rig& rig) {
    rig.press("M104 S200");
}
void heat_bed(Rig& rig) {
    rig.press("M140 S60");
}
void load_filament(Rig& rig) {
    heat_nozzle(rig);
    rig.run_until(250);
    rig.press("M2105 S2");
}
void home(Rig& rig) {
    rig.press("G28");
}
void print_from_host(Rig& rig) {
    rig.host("M104 S200");
    rig.run_until(299);
    rig.host("G1 X10");
}
void select(Rig& rig) {
    rig.press("M23 long.gcode");
}

// While it is in force.

void a_while(Rig& rig) {
    rig.run_for(30);
}
void long_while(Rig& rig) {
    rig.run_for(200);
}
void heat_again(Rig& rig) {
    rig.press("M104 S200");
    rig.run_for(30);
}
void choose_file(Rig& rig) {
    rig.run_for(1);
    rig.press("M23 long.gcode");
    rig.run_for(1);
}
void start_file(Rig& rig) {
    rig.press("M24");
    rig.run_for(1);
}
void press_load(Rig& rig) {
    rig.press("M2105 S2");
    rig.run_for(2);
}
void press_home(Rig& rig) {
    rig.press("G28");
    rig.run_for(200);
}
void press_home_z(Rig& rig) {
    rig.press("G28 Z0");
    rig.run_for(200);
}

// The way back.

void card_in(Rig& rig) {
    rig.do_it({{"op", "world"}, {"do", "card in"}});
    rig.run_for(2);
}
void filament_in_and_resume(Rig& rig) {
    rig.do_it({{"op", "world"}, {"do", "filament in"}});
    rig.press("M24");
    rig.run_for(20);
}
void card_in_and_resume(Rig& rig) {
    card_in(rig);
    rig.press("M24");
    rig.run_for(20);
}
void mend_and_resume(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    rig.press("M24");
    rig.run_for(20);
}
void mend_and_heat(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    rig.press("M104 S200");
    rig.run_for(120);
}
void mend_and_cool(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    rig.run_for(600);
    rig.press("M140 S60");
    rig.run_for(10);
}
void mend_and_home(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    rig.press("G28");
    rig.run_for(60);
}
void mend_and_load(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    rig.press("M2105 S2");
    rig.run_for(5);
}
void mend_and_choose(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    choose_file(rig);
}
void mend_and_start(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    start_file(rig);
}
void mend_and_boot(Rig& rig) {
    rig.do_it({{"op", "faults.clear"}});
    rig.run_for(4);
}
void release_alarm(Rig& rig) {
    rig.press("M2120 P1 S2");
    rig.press("G28");
    rig.run_for(60);
}
void stop_tuning(Rig& rig) {
    rig.press("M108");
    rig.run_for(2);
}
void user_continues(Rig& rig) {
    rig.press("M0");
    rig.run_for(2);
}
void resume(Rig& rig) {
    rig.press("M24");
    rig.run_for(2);
}

const Fields printing{{"job.status", 1}};
const Fields paused{{"job.status", 2}, {"motion.busy", 0}, {"heaters.nozzle.target", 200}};
const Fields stopped{{"job.status", 0}, {"heaters.nozzle.target", 0}, {"heaters.bed.target", 0}};
const Fields boots{{"board.hung", 0}, {"job.status", 0}, {"heaters.nozzle.target", 0}};

/// `more` behind `fields`.
Fields with(Fields fields, const Fields& more) {
    fields.insert(fields.end(), more.begin(), more.end());
    return fields;
}

std::vector<FaultCase> filament_and_card() {
    return {
        {"filament out, idle",
         "filament_out",
         nullptr,
         a_while,
         {},
         {"L18"},
         {},
         {{"filament.code", 0}},
         nullptr,
         {},
         {{"filament.code", 1}}},
        {"filament out, printing",
         "filament_out",
         print,
         a_while,
         {"L18 P26 S0", "L3 PS:2"},
         {},
         0,
         paused,
         filament_in_and_resume,
         {"L3 PS:1"},
         with(printing, {{"filament.code", 1}})},
        {"jam: the board notices nothing",
         "jam",
         print,
         a_while,
         {},
         {"L18", "L3 PS:2"},
         {},
         with(printing, {{"faults.jam", 1}}),
         nullptr,
         {},
         printing},
        {"card removed, idle",
         "card_removed",
         nullptr,
         a_while,
         {"L18 P26 S1", "L2 "},
         {},
         1,
         {{"card.code", 1}, {"card.usable", 0}},
         card_in,
         {"L2 ", "L7 begin file list:0"},
         {{"card.code", 0}}},
        {"card removed, printing",
         "card_removed",
         print,
         a_while,
         {"L18 P26 S1", "L3 PS:2"},
         {},
         1,
         with(paused, {{"card.code", 1}}),
         card_in_and_resume,
         {"L2 ", "L3 PS:1"},
         printing},
        {"card broken, printing",
         "card_failed",
         print,
         a_while,
         {"L2 ", "L3 PS:2"},
         {},
         {},
         with(paused, {{"card.code", 2}}),
         card_in_and_resume,
         {"L2 ", "L3 PS:1"},
         printing},
        {"file missing, when it is selected",
         "file_missing",
         nullptr,
         choose_file,
         {"L18 P26 S3"},
         {"L14 file select"},
         3,
         {{"job.selected", 0}},
         mend_and_choose,
         {"raw:N-0 L14 file select succeed!:long.gcode"},
         {{"job.selected", 1}}},
        {"file missing, printing",
         "file_missing",
         print,
         a_while,
         {"L18 P26 S3", "L3 PS:2"},
         {},
         3,
         paused,
         mend_and_resume,
         {"L3 PS:1"},
         printing},
        {"file unreadable, when it is selected",
         "file_unreadable",
         nullptr,
         choose_file,
         {"L18 P26 S10"},
         {},
         10,
         {{"job.selected", 0}},
         mend_and_choose,
         {"raw:N-0 L14 file select"},
         {{"job.selected", 1}}},
        {"file unreadable, printing",
         "file_unreadable",
         print,
         a_while,
         {"L18 P26 S10", "L3 PS:2"},
         {},
         10,
         paused,
         mend_and_resume,
         {"L3 PS:1"},
         printing},
    };
}

std::vector<FaultCase> heaters() {
    return {
        {"open thermistor, off: nothing to notice",
         "thermistor_open",
         nullptr,
         a_while,
         {"L2 "},
         {"L18"},
         {},
         {{"heaters.nozzle.printed", 0}},
         nullptr,
         {},
         {{"faults.thermistor_open", 0}}},
        {"open thermistor, heated",
         "thermistor_open",
         heat_nozzle,
         a_while,
         {"L18 P26 S4", "L2 "},
         {},
         4,
         {{"heaters.nozzle.printed", 0}, {"heaters.nozzle.target", 0}},
         mend_and_heat,
         {"L2 "},
         {{"heaters.nozzle.target", 200}}},
        {"open thermistor of the bed, printing",
         "thermistor_open:heater=bed",
         print,
         a_while,
         {"raw:Stop Print", "L18 P26 S7", "L3 PS:0"},
         {},
         7,
         stopped,
         nullptr,
         {},
         stopped},
        {"shorted thermistor, off",
         "thermistor_short",
         nullptr,
         a_while,
         {"L18 P26 S4", "L2 "},
         {},
         4,
         {{"heaters.nozzle.printed", 300}},
         mend_and_heat,
         {"L2 "},
         {{"heaters.nozzle.target", 200}}},
        {"shorted thermistor of the bed",
         "thermistor_short:heater=bed",
         nullptr,
         a_while,
         {"L18 P26 S5"},
         {},
         5,
         {{"heaters.bed.printed", 300}},
         nullptr,
         {},
         {{"faults.thermistor_short", 0}}},
        {"shorted thermistor, a host prints",
         "thermistor_short",
         print_from_host,
         nullptr,
         {"L18 P26 S8"},
         {},
         8,
         {{"heaters.nozzle.target", 0}},
         nullptr,
         {},
         {}},
        {"shorted thermistor of the bed, a host prints",
         "thermistor_short:heater=bed",
         print_from_host,
         nullptr,
         {"L18 P26 S9"},
         {},
         9,
         {{"heaters.nozzle.target", 0}},
         nullptr,
         {},
         {}},
        {"dead heater, heating up",
         "heater_dead",
         nullptr,
         heat_again,
         {"L18 P26 S4", "L2 "},
         {},
         4,
         {{"heaters.nozzle.target", 0}},
         mend_and_heat,
         {},
         {{"heaters.nozzle.target", 200}}},
        {"dead heater, printing",
         "heater_dead",
         print,
         long_while,
         {"L18 P26 S6", "L3 PS:0"},
         {},
         6,
         stopped,
         nullptr,
         {},
         stopped},
        {"dead bed, held",
         "heater_dead:heater=bed",
         heat_bed,
         [](Rig& rig) { rig.run_for(900); },
         {"L18 P26 S5"},
         {},
         5,
         {{"heaters.bed.target", 0}},
         nullptr,
         {},
         {}},
        {"runaway, printing",
         "thermal_runaway",
         print,
         long_while,
         {"raw:Stop Print", "L18 P26 S6", "L3 PS:0"},
         {},
         6,
         stopped,
         nullptr,
         {},
         stopped},
        {"runaway of the bed",
         "thermal_runaway:heater=bed,contact=60",
         heat_bed,
         long_while,
         {"L18 P26 S5"},
         {},
         5,
         {{"heaters.bed.target", 0}},
         nullptr,
         {},
         {}},
        {"nozzle too hot: off, and still heating",
         "too_hot",
         nullptr,
         [](Rig& rig) { rig.run_for(400); },
         {"L18 P26 S4"},
         {},
         4,
         {{"heaters.nozzle.power", 0}},
         nullptr,
         {},
         {}},
        {"nozzle too hot, printing",
         "too_hot",
         print,
         long_while,
         {"L18 P26 S6", "L3 PS:0"},
         {},
         6,
         stopped,
         nullptr,
         {},
         stopped},
        {"bed too hot",
         "too_hot:heater=bed",
         nullptr,
         [](Rig& rig) { rig.run_for(3600); },
         {"L18 P26 S5"},
         {},
         5,
         {{"heaters.bed.power", 0}},
         mend_and_cool,
         {"L2 "},
         {{"heaters.nozzle.target", 0}}},
    };
}

std::vector<FaultCase> motion() {
    return {
        {"3D Touch alarm",
         "probe_alarm",
         nullptr,
         a_while,
         {"L18 P26 S11"},
         {},
         11,
         {{"leveling.probe_alarm", 1}},
         release_alarm,
         {"L12 P0 S0"},
         {{"motion.homed", 1}}},
        {"3D Touch alarm, homing",
         "probe_alarm",
         nullptr,
         press_home,
         {"L18 P26 S11", "L18 P26 S11"},
         {"L12 P0 S0"},
         11,
         {{"motion.homed", 0}, {"motion.busy", 0}},
         release_alarm,
         {"L12 P0 S0"},
         {{"motion.homed", 1}}},
        {"end stop of X never triggers",
         "endstop_dead",
         nullptr,
         press_home,
         {"L12 P0 S0", "L14 Homing failed", "L1 "},
         {},
         {},
         {{"motion.homed", 0}, {"motion.busy", 0}},
         mend_and_home,
         {"L12 P0 S0", "L1 "},
         {{"motion.homed", 1}}},
        {"probe never triggers",
         "endstop_dead:axis=z",
         home,
         press_home_z,
         {"L14 Homing failed"},
         {},
         {},
         {{"motion.homed", 0}},
         mend_and_home,
         {"L12 P0 S0"},
         {{"motion.homed", 1}}},
        {"cold extrusion, loading",
         "cold_extrusion",
         load_filament,
         a_while,
         {"L18 P26 S12", "L12 P0 S0"},
         {},
         12,
         {{"filament.running", 0}},
         mend_and_load,
         {"L12 P0 S2", "L1 "},
         {{"filament.running", 1}}},
        {"cold extrusion, load pressed",
         "cold_extrusion",
         heat_nozzle,
         press_load,
         {"L18 P26 S12"},
         {},
         12,
         {{"filament.running", 0}},
         mend_and_load,
         {"L12 P0 S2"},
         {{"filament.running", 1}}},
        {"motors off: homing is lost and cannot be done",
         "motor_off",
         home,
         press_home,
         {"L3 PS:0 VL:0 MT:0", "L14 Homing failed"},
         {},
         {},
         {{"motors.enabled", 0}, {"motion.homed", 0}},
         mend_and_home,
         {"L12 P0 S0"},
         {{"motors.enabled", 1}, {"motion.homed", 1}}},
        {"motors off, printing: the board prints on",
         "motor_off",
         print,
         a_while,
         {"L3 PS:1 VL:0 MT:0"},
         {"L18"},
         {},
         {{"motors.enabled", 0}, {"job.status", 1}},
         nullptr,
         {},
         {{"motors.enabled", 1}}},
    };
}

std::vector<FaultCase> board() {
    return {
        {"refused, when a file is selected",
         "refused",
         nullptr,
         choose_file,
         {"L18 P26 S13"},
         {},
         13,
         {{"job.selected", 0}},
         mend_and_choose,
         {"raw:N-0 L14 file select"},
         {{"job.selected", 1}}},
        {"refused, when a file is started",
         "refused",
         select,
         start_file,
         {"L18 P26 S13"},
         {"raw:Start Print"},
         13,
         {{"job.status", 0}},
         mend_and_start,
         {"raw:Start Print"},
         printing},
        {"end the tuning?",
         "pid_question",
         nullptr,
         nullptr,
         {"L18 P26 S14"},
         {},
         14,
         {{"heating.tuning", 1}, {"heaters.nozzle.target", 200}},
         stop_tuning,
         {"L3 PS:0"},
         {{"heating.tuning", 0}, {"heaters.nozzle.target", 0}}},
        {"wait for user, idle",
         "wait_for_user",
         nullptr,
         nullptr,
         {"L18 P26 S15"},
         {},
         15,
         {{"job.waits_for_user", 1}},
         user_continues,
         {},
         {{"job.waits_for_user", 0}}},
        {"wait for user, printing",
         "wait_for_user",
         print,
         a_while,
         {"L18 P26 S15", "L3 PS:2"},
         {},
         15,
         {{"job.waits_for_user", 1}, {"job.status", 2}},
         resume,
         {"L3 PS:1"},
         with(printing, {{"job.waits_for_user", 0}})},
        {"hang, printing: neither heard nor said anything",
         "hang",
         print,
         a_while,
         {},
         {"L", "raw:"},
         {},
         {{"board.hung", 1}},
         mend_and_boot,
         {"L3 PS:0", "L9 ", "L7 begin"},
         boots},
        {"hang with a watchdog",
         "hang:for=8s",
         heat_nozzle,
         a_while,
         {"L3 PS:0", "L9 DN:"},
         {},
         {},
         boots,
         nullptr,
         {},
         boots},
        {"reset, printing",
         "board_reset",
         print,
         a_while,
         {"L3 PS:0", "L9 DN:", "L16 P0 15"},
         {},
         {},
         boots,
         nullptr,
         {},
         boots},
        {"brown-out, idle",
         "brown_out",
         nullptr,
         a_while,
         {"L3 PS:0", "L9 DN:"},
         {"L16"},
         {},
         boots,
         nullptr,
         {},
         boots},
        {"brown-out, printing: the job is offered again",
         "brown_out:for=3s",
         print,
         a_while,
         {"L3 PS:0", "L9 DN:", "L16 P0 15"},
         {},
         {},
         with(boots, {{"power_loss.saved_job", 1}}),
         nullptr,
         {},
         boots},
    };
}

/// These boards take no files over a network: a print knows nothing of it.
std::vector<FaultCase> network() {
    std::vector<FaultCase> rows;
    for (const char* spec : {"chunk_lost:share=100", "chunk_damaged:share=100", "chunk_repeated:share=100"}) {
        FaultCase row;
        row.title = "a network that nobody uses";
        row.spec = spec;
        row.before = print;
        row.during = a_while;
        row.said = {"L3 PS:1"};
        row.state = {{"job.status", 1}};
        row.state_back = {{"job.status", 1}};
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace

std::span<const FaultCase> fault_cases() {
    static const std::vector<FaultCase> all = [] {
        std::vector<FaultCase> rows;
        for (const auto& part : {filament_and_card(), heaters(), motion(), board(), network()}) {
            rows.insert(rows.end(), part.begin(), part.end());
        }
        return rows;
    }();
    return all;
}

}  // namespace fauxboard::testing
