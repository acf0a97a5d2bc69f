// Manual leveling, stepper drivers, the job that a power loss cut off.

#include <array>

#include "emulator/behaviour/action_rows.h"
#include "emulator/filament/printer.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

using behaviour::ActionContext;
using behaviour::ActionInfo;
using behaviour::ArgInfo;
using behaviour::Args;
using behaviour::own;
using behaviour::refuse;
using behaviour::Value;
using behaviour::whole;
using enum behaviour::ArgType;

void leveling_adjust(Printer& p, ActionContext&, Args a) {
    behaviour::set_field(p, *behaviour::find_field("leveling.manual_z"),
                         Value::of(p.leveling.manual_z_mm + a[0].number));
    MoveRequest request;
    request.values[2] = a[0].number;
    request.force_relative = true;
    request.limits = false;  // the page exists to find out where the bed is
    p.motion.move(request, p.now(), p.events);
}

void leveling_enter(Printer& p, ActionContext& c, Args) {
    p.leveling.manual = true;
    p.leveling.manual_z_mm = p.config().manual_level_start_mm;
    if (!p.run("level_start")) {
        refuse(c, "manual leveling cannot move: no procedure level_start, or the motion queue is full");
    }
}

void stepper_select(Printer& p, ActionContext& c, Args a) {
    const auto motor = whole(a[0], 0, 3);
    if (!motor) {
        refuse(c, "no such stepper driver; expected 0 to 3");
        return;
    }
    p.steppers.selected = *motor;
}

constexpr std::array adjust_args{ArgInfo{"mm", number, true, "up is positive", "mm"}};
constexpr std::array motor_args{ArgInfo{"motor", number, true, "0 to 3"}};

constexpr std::array table{
    ActionInfo{"leveling.enter",
               "",
               "opens manual leveling: runs the procedure level_start",
               {},
               own<leveling_enter>},
    ActionInfo{"leveling.adjust", "", "moves Z and the leveling height", adjust_args, own<leveling_adjust>},
    ActionInfo{"job.end",
               "",
               "the job, whatever its state, is at its end, moves and waits are broken off; heaters stay as "
               "they are. job.close makes the board idle",
               {},
               own<[](Printer& p, ActionContext&, Args) { p.end_job(); }>},
    ActionInfo{
        "job.recover",
        "",
        "takes up the job that a power loss cut off: heats, homes X and Y, goes on where it was; raises "
        "file.missing when its file is gone",
        {},
        own<[](Printer& p, ActionContext&, Args) { p.recovery.begin(); }>},
    ActionInfo{"job.forget",
               "",
               "drops the job that a power loss cut off",
               {},
               own<[](Printer& p, ActionContext&, Args) {
                   if (p.recovery.saved() != nullptr) {
                       p.recovery.drop();
                   }
               }>},
    ActionInfo{"stepper.select", "", "chooses the closed-loop driver that the stepper fields speak of",
               motor_args, own<stepper_select>},
};

}  // namespace

std::span<const behaviour::ActionInfo> device_actions() {
    return table;
}

}  // namespace fauxboard::filament
