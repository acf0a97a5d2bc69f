// Heaters, motion, mixing, filament, fans.

#include <array>
#include <cmath>

#include "emulator/behaviour/action_rows.h"
#include "emulator/filament/printer.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

using behaviour::ActionContext;
using behaviour::ActionInfo;
using behaviour::ArgInfo;
using behaviour::Args;
using behaviour::flag;
using behaviour::given;
using behaviour::Level;
using behaviour::number_or;
using behaviour::own;
using behaviour::refuse;
using behaviour::Value;
using behaviour::whole;
using enum behaviour::ArgType;

std::optional<HeaterId> heater(ActionContext& c, const Value& name) {
    if (name.text == "nozzle") {
        return HeaterId::nozzle;
    }
    if (name.text == "bed") {
        return HeaterId::bed;
    }
    refuse(c, "unknown heater \"" + std::string(name.text) + "\"; expected nozzle or bed");
    return std::nullopt;
}

void heater_target(Printer& p, ActionContext& c, Args a) {
    const auto id = heater(c, a[0]);
    if (id && p.thermal.set_target(*id, a[1].number)) {
        c.notices.notice(behaviour::Level::info, "target of the " + std::string(a[0].text) +
                                                     " beyond what the machine allows; taken as " +
                                                     std::to_string(std::lround(p.thermal.target_c(*id))) +
                                                     " C");
    }
}

void heater_wait(Printer& p, ActionContext& c, Args a) {
    const auto id = heater(c, a[0]);
    if (id && p.thermal.heating(*id) && !p.thermal.reached(*id)) {
        p.wait.start(*id, p.now(), p.events);
    }
}

void heaters_off(Printer& p, ActionContext&, Args) {
    p.thermal.set_target(HeaterId::nozzle, 0);
    p.thermal.set_target(HeaterId::bed, 0);
}

void motion_home(Printer& p, ActionContext& c, Args a) {
    const unsigned mask = (flag(a[0]) ? 1U : 0U) | (flag(a[1]) ? 2U : 0U) | (flag(a[2]) ? 4U : 0U);
    if (!p.home(mask)) {
        refuse(c, "homing not started: the motion queue is full, or the profile has no such procedure");
    }
}

void motion_run(Printer& p, ActionContext& c, Args a) {
    if (!p.run(a[0].text)) {
        refuse(c,
               "procedure " + std::string(a[0].text) + " not started: unknown, or the motion queue is full");
    }
}

void motion_move(Printer& p, ActionContext& c, Args a) {
    MoveRequest request;
    for (std::size_t i = 0; i < axis_count; ++i) {
        request.values[i] = given(a[i]);
    }
    request.feed_mm_min = given(a[4]);
    request.force_relative = flag(a[5]);
    request.limits = a[6].none() || flag(a[6]);
    request.feed_passes = request.force_relative && a[0].none() && a[1].none() && a[2].none();
    if (flag(a[7]) && request.values[3]) {
        request.values[3] = -*request.values[3];
    }
    switch (p.motion.move(request, p.now(), p.events)) {
        case MoveOutcome::accepted:
            break;
        case MoveOutcome::clamped:
            c.notices.notice(Level::info, "move kept inside the build volume");
            break;
        case MoveOutcome::queue_full:
            refuse(c, "move lost: the motion queue is full");
            break;
    }
}

void motion_set_position(Printer& p, ActionContext&, Args a) {
    p.motion.set_position({given(a[0]), given(a[1]), given(a[2]), given(a[3])});
}

void motors_enable(Printer& p, ActionContext&, Args) {
    p.motion.set_motors(true);
}
void motors_disable(Printer& p, ActionContext&, Args) {
    p.motors_off();
}

void fan_pwm(Printer& p, ActionContext& c, Args a) {
    const auto fan = whole(a[0], 0, 2);
    const BoardFanConfig& board = p.config().board_fan;
    double pwm = std::fmin(std::fmax(a[1].number, 0), 255);
    if (!fan || *fan == 1) {
        refuse(c, "no such fan; expected 0 (part cooling) or 2");
        return;
    }
    if (*fan == 0 && pwm >= 1) {
        pwm = std::fmax(pwm, board.least_pwm);
    }
    const int percent = static_cast<int>(std::lround(pwm * 100 / 255));
    (*fan == 0 ? p.fans.part_percent : p.fans.second_percent) = percent;
    if (*fan == 2 && board.automatic) {
        p.set_board_fan(percent);
    }
}

void ratio_check(ActionContext& c, bool taken) {
    if (!taken) {
        refuse(c, "mixing value out of range; the mixer stays as it is");
    }
}

void mixer_weights(Printer& p, ActionContext& c, Args a) {
    ratio_check(c, p.mixer.set_weights(number_or(a[0], 0), number_or(a[1], 0), number_or(a[2], 0)));
}
void mixer_packed(Printer& p, ActionContext& c, Args a) {
    ratio_check(c, p.mixer.set_packed(a[0].number));
}
void mixer_share(Printer& p, ActionContext& c, Args a) {
    ratio_check(c, p.mixer.set_share(whole(a[0], 0, 2).value_or(-1), a[1].number));
}
void mixer_tool(Printer& p, ActionContext& c, Args a) {
    ratio_check(c, p.mixer.select_tool(whole(a[0], 0, 3).value_or(-1)));
}
void mixer_mode(Printer& p, ActionContext& c, Args a) {
    ratio_check(c, p.mixer.set_mode(whole(a[0], 0, 3).value_or(-1)));
}
void mixer_template(Printer& p, ActionContext& c, Args a) {
    ratio_check(c, p.mixer.select_template(whole(a[0], 1, 14).value_or(0)));
}
void mixer_range(Printer& p, ActionContext& c, Args a) {
    Mixer& mixer = p.mixer;
    ratio_check(c, a[0].none() || mixer.set_start(a[0].number));
    ratio_check(c, a[1].none() || mixer.set_end(a[1].number));
    ratio_check(c, a[2].none() || mixer.set_start_height(a[2].number));
    ratio_check(c, a[3].none() || mixer.set_end_height(a[3].number));
}

constexpr std::array heater_target_args{ArgInfo{"heater", text, true, "nozzle or bed"},
                                        ArgInfo{"c", number, true, "target, C; 0 is off", "C"}};
constexpr std::array heater_args{ArgInfo{"heater", text, true, "nozzle or bed"}};
constexpr std::array home_args{ArgInfo{"x", boolean, false, "home X"}, ArgInfo{"y", boolean, false, "home Y"},
                               ArgInfo{"z", boolean, false, "home Z; none of the three means all"}};
std::optional<std::vector<std::string_view>> procedure_names(const machine::MachineConfig& machine) {
    const auto* config = dynamic_cast<const Config*>(&machine);
    if (config == nullptr) {
        return std::nullopt;
    }
    std::vector<std::string_view> names;
    for (const auto& [name, steps] : config->motion.procedures) {
        names.emplace_back(name);
    }
    return names;
}
constexpr behaviour::KnownNames procedures{"motion procedure", procedure_names};

constexpr std::array run_args{
    ArgInfo{"procedure", text, true, "a name in the profile's machine.motion.procedures", {}, &procedures}};
constexpr std::array move_args{
    ArgInfo{"x", number, false, "mm", "mm"},
    ArgInfo{"y", number, false, "mm", "mm"},
    ArgInfo{"z", number, false, "mm", "mm"},
    ArgInfo{"e", number, false, "mm", "mm"},
    ArgInfo{"f", number, false,
            "feed, mm/min; stays in force, but for filament alone that is moved by a distance", "mm/min"},
    ArgInfo{"relative", boolean, false, "by these distances, whatever G90 and G91 say"},
    ArgInfo{"limits", boolean, false, "keep inside the build volume (default)"},
    ArgInfo{"back", boolean, false, "e is pulled back: what is written for it counts with its sign turned"}};
constexpr std::array position_args{
    ArgInfo{"x", number, false, "mm", "mm"}, ArgInfo{"y", number, false, "mm", "mm"},
    ArgInfo{"z", number, false, "mm", "mm"}, ArgInfo{"e", number, false, "mm", "mm"}};
constexpr std::array fan_args{ArgInfo{"fan", number, true, "0 part cooling, 2 second fan"},
                              ArgInfo{"value", number, true, "0 to 255"}};
constexpr std::array weights_args{ArgInfo{"a", number, false, "weight of extruder 1"},
                                  ArgInfo{"b", number, false, "weight of extruder 2"},
                                  ArgInfo{"c", number, false, "weight of extruder 3"}};
constexpr std::array packed_args{
    ArgInfo{"ratio", number, true, "A + 256 B + 65536 C, percents that add up to 100"}};
constexpr std::array share_args{ArgInfo{"channel", number, true, "0 to 2"},
                                ArgInfo{"percent", number, true, "0 to 100", "%"}};
constexpr std::array tool_args{ArgInfo{"tool", number, true, "0 to 3"}};
constexpr std::array mode_args{ArgInfo{"mode", number, true, "0 off, 1 fixed ratio, 2 and 3 template"}};
constexpr std::array template_args{ArgInfo{"template", number, true, "1 to 8 fixed, 9 to 14 custom"}};
constexpr std::array range_args{ArgInfo{"start", number, false, "packed ratio at the start"},
                                ArgInfo{"end", number, false, "packed ratio at the end"},
                                ArgInfo{"start_height", number, false, "mm", "mm"},
                                ArgInfo{"end_height", number, false, "mm", "mm"}};

constexpr std::array table{
    ActionInfo{"heater.target", "", "sets a target; beyond the machine's limits it is clamped and said",
               heater_target_args, own<heater_target>},
    ActionInfo{"heater.wait", "", "stops the schedule until the heater is there (M109, M190)", heater_args,
               own<heater_wait>},
    ActionInfo{"heater.stop_waiting",
               "",
               "breaks a wait, or the tuning of a controller, off (M108)",
               {},
               own<[](Printer& p, ActionContext&, Args) {
                   p.wait.cancel(p.events);
                   p.stop_tuning();
               }>},
    ActionInfo{"heater.all_off", "", "both targets to 0", {}, own<heaters_off>},
    ActionInfo{"heaters.reported",
               "",
               "the temperatures were told: heaters.moved starts anew from these",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.thermal.mark_reported(); }>},
    ActionInfo{"motion.home", "", "homes the axes named; takes the time of the moves", home_args,
               own<motion_home>},
    ActionInfo{"motion.run", "", "runs a motion procedure of the profile", run_args, own<motion_run>},
    ActionInfo{"motion.move", "", "a G0/G1 move", move_args, own<motion_move>},
    ActionInfo{"motion.set_position", "", "calls the present place so (G92)", position_args,
               own<motion_set_position>},
    ActionInfo{"motion.abort",
               "",
               "drops the moves that wait and stops the one under way",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.motion.abort(); }>},
    ActionInfo{"motors.enable", "", "motors on", {}, own<motors_enable>},
    ActionInfo{
        "motors.disable", "motors off", "motors off; the homing is forgotten", {}, own<motors_disable>},
    ActionInfo{"fan.pwm", "", "sets a fan, kept within 0 to 255, shown as percent", fan_args, own<fan_pwm>},
    ActionInfo{"mixer.weights", "", "mixing weights of any scale, normalised to percents (M165)",
               weights_args, own<mixer_weights>},
    ActionInfo{"mixer.packed", "", "mixing ratio as the line packs it", packed_args, own<mixer_packed>},
    ActionInfo{"mixer.share", "", "share of one channel; the others keep their proportion", share_args,
               own<mixer_share>},
    ActionInfo{"mixer.tool", "", "tool with its ratio (T0 to T3)", tool_args, own<mixer_tool>},
    ActionInfo{"mixer.mode", "", "mixing mode (M2138)", mode_args, own<mixer_mode>},
    ActionInfo{"mixer.template", "", "mixing template (M2136)", template_args, own<mixer_template>},
    ActionInfo{"mixer.range", "", "ratios and heights between which a template mixes (M2137)", range_args,
               own<mixer_range>},
    ActionInfo{"filament.load",
               "",
               "feeds filament until stopped",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.feed(Feeder::Mode::load); }>},
    ActionInfo{"filament.unload",
               "",
               "pulls filament until stopped",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.feed(Feeder::Mode::unload); }>},
    ActionInfo{"filament.clean",
               "",
               "cycles the extruders until stopped",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.feed(Feeder::Mode::clean); }>},
    ActionInfo{"filament.once",
               "",
               "feeds or retracts 10 mm",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.feed_once(); }>},
    ActionInfo{"filament.stop",
               "",
               "stops loading, unloading or cleaning after the piece under way",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.feeder.stop(p.now(), p.events); }>},
    ActionInfo{"filament.insert",
               "filament in",
               "filament is put into the detector",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.set_filament(true); }>},
    ActionInfo{"filament.remove",
               "filament out",
               "filament is taken out of the detector",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.set_filament(false); }>},
};

}  // namespace

std::span<const behaviour::ActionInfo> machine_actions() {
    return table;
}

}  // namespace fauxboard::filament
