#include "emulator/behaviour/actions.h"

#include <unordered_map>
#include <vector>

#include "emulator/behaviour/action_rows.h"
#include "emulator/behaviour/action_tables.h"
#include "emulator/behaviour/kind.h"

namespace fauxboard::behaviour {
namespace {

const std::vector<ActionInfo>& all() {
    static const std::vector<ActionInfo> table = [] {
        std::vector<ActionInfo> list{
            {"set",
             "",
             "puts values into fields or variables, within their bounds: {\"set\": {\"addons.sound\": "
             "\"{S}\"}}; "
             "a parameter that is not on the line sets nothing",
             {},
             nullptr},
            {"add",
             "",
             "adds to numeric fields or variables: {\"add\": {\"settings.double_z.z0\": \"{S}\"}}",
             {},
             nullptr},
        };
        const auto append = [&](std::span<const ActionInfo> part) {
            list.insert(list.end(), part.begin(), part.end());
        };
        append(rows::device_actions());
        append(rows::host_actions());
        append(rows::fault_actions());
        append(rows::transfer_actions());
        for (const KindRow* kind : kinds()) {
            append(kind->actions());
        }
        return list;
    }();
    return table;
}

}  // namespace

std::span<const ActionInfo> actions() {
    return all();
}

const ActionInfo* find_action(std::string_view name) {
    static const std::unordered_map<std::string_view, const ActionInfo*> index = [] {
        std::unordered_map<std::string_view, const ActionInfo*> map;
        for (const ActionInfo& action : all()) {
            map.emplace(action.name, &action);
        }
        return map;
    }();
    const auto hit = index.find(name);
    return hit == index.end() ? nullptr : hit->second;
}

void refuse_kind(ActionContext& c, const machine::Kind& wanted) {
    refuse(c, "only a machine of the kind " + std::string(wanted.name) +
                  " can do that; this one is of the kind " + std::string(c.machine.kind().name));
}

const ActionInfo* find_world_action(std::string_view phrase) {
    for (const ActionInfo& action : all()) {
        if (!action.phrase.empty() && action.phrase == phrase) {
            return &action;
        }
    }
    const ActionInfo* action = find_action(phrase);
    return action != nullptr && action->run != nullptr ? action : nullptr;
}

}  // namespace fauxboard::behaviour
