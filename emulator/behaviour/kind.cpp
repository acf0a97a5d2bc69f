#include "emulator/behaviour/kind.h"

#include <algorithm>
#include <vector>

#include "emulator/behaviour/nearest.h"

namespace fauxboard::behaviour {

const KindRow& kind_of(const Json& machine, const std::string& pointer, Findings& findings) {
    const auto all = kinds();
    const auto named = [&](std::string_view name) {
        return std::find_if(all.begin(), all.end(),
                            [&](const KindRow* row) { return row->machine.name == name; });
    };
    if (!machine.is_object()) {
        return *all.front();
    }
    if (const auto said = machine.find("kind"); said != machine.end()) {
        const std::string name = said->is_string() ? said->get<std::string>() : std::string();
        if (const auto hit = named(name); hit != all.end()) {
            return **hit;
        }
        std::vector<std::string_view> names;
        std::string list;
        for (const KindRow* row : all) {
            names.push_back(row->machine.name);
            list += (list.empty() ? "" : ", ") + std::string(row->machine.name);
        }
        findings.add(pointer + "/kind", found(*said) + "; expected a kind of machine: " + list,
                     std::string(nearest(name, names)));
    }
    for (const KindRow* row : all) {
        if (row != all.front() && machine.contains(row->machine.name)) {
            return *row;
        }
    }
    return *all.front();
}

}  // namespace fauxboard::behaviour
