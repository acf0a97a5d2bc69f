// What the commands of a host, or of a file, do beside what their codes say.

#include <array>

#include "emulator/behaviour/action_rows.h"
#include "emulator/behaviour/action_tables.h"
#include "emulator/machine/event_rows.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum ArgType;

void look_up(ActionContext& c, Args a) {
    c.machine.storage.looked_up = c.machine.storage.long_path(a[0].text);
}

/// What a file or the network asked for has none anyway, and must not take that of the line's command.
void leave_unanswered(ActionContext& c, Args) {
    if (machine::Transfer::is_host_line(c.machine.transfer.asker)) {
        c.machine.host_side().leave_unanswered();
    }
}

constexpr std::array name_args{
    ArgInfo{"name", text, true, "of a file or folder, from the root of the disk on"}};

constexpr std::array table{
    ActionInfo{"code.run",
               "",
               "carries the command out as it is carried out where the profile has no rule for it",
               {},
               [](ActionContext& c, Args) {
                   machine::BegunCommand* const begun = c.machine.commands.begun;
                   if (begun == nullptr || !begun->run_code(true)) {
                       c.machine.events.raise(machine::event("host.unknown"));
                   }
               }},
    ActionInfo{"code.unknown",
               "",
               "the board was built without that command: host.unknown",
               {},
               [](ActionContext& c, Args) { c.machine.events.raise(machine::event("host.unknown")); }},
    ActionInfo{"code.unanswered", "", "the command gets no acknowledgement", {}, leave_unanswered},
    ActionInfo{"card.look_up", "", "finds the long path of a file or folder (M33): card.looked_up", name_args,
               look_up},
};

}  // namespace

std::span<const ActionInfo> host_actions() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
