#include "emulator/script/steps.h"

#include <algorithm>
#include <vector>

namespace fauxboard::script {

std::span<const StepKind> step_kinds() {
    static const std::vector<StepKind> table = [] {
        std::vector<StepKind> all;
        for (const auto part : {rows::act_steps(), rows::display_steps(), rows::watch_steps(),
                                rows::block_steps(), rows::upload_steps()}) {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }();
    return table;
}

const StepKind* find_step_kind(std::string_view name) {
    const auto kinds = step_kinds();
    const auto hit =
        std::find_if(kinds.begin(), kinds.end(), [&](const StepKind& kind) { return kind.name == name; });
    return hit == kinds.end() ? nullptr : &*hit;
}

Json describe_scenarios() {
    Json steps = Json::array();
    for (const StepKind& kind : step_kinds()) {
        Json keys = Json::array();
        for (const KeyInfo& key : kind.keys) {
            keys.push_back({{"name", key.name}, {"type", key.type}, {"help", key.help}});
        }
        steps.push_back({{"name", kind.name},
                         {"type", kind.type},
                         {"help", kind.help},
                         {"example", kind.example},
                         {"keys", std::move(keys)}});
    }
    Json triggers = Json::array();
    for (const TriggerInfo& trigger : trigger_kinds()) {
        triggers.push_back({{"name", trigger.name}, {"type", trigger.type}, {"help", trigger.help}});
    }
    return {{"steps", std::move(steps)}, {"triggers", std::move(triggers)}};
}

}  // namespace fauxboard::script
