#include "emulator/behaviour/kind.h"

#include <algorithm>
#include <vector>

#include "emulator/behaviour/machine_loader.h"
#include "emulator/behaviour/nearest.h"

namespace fauxboard::behaviour {

namespace {

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

}  // namespace

LoadedMachine load_machine(const Json* node, const std::string& pointer, Findings& findings) {
    if (node == nullptr) {
        return {&kinds().front()->machine, kinds().front()->config()};
    }
    const KindRow& kind = kind_of(*node, pointer, findings);
    const LoadedMachine loaded{&kind.machine, kind.config()};
    ObjectReader reader(*node, pointer, findings);
    reader.get("kind");  // looked at already
    load_common(reader, findings, *loaded.config);
    for (const KindRow* each : kinds()) {
        each->load(reader, findings, each == &kind ? *loaded.config : *each->config());
    }
    reader.finish();
    return loaded;
}

}  // namespace fauxboard::behaviour
