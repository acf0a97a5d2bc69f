#pragma once

#include <memory>
#include <span>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/lists.h"
#include "emulator/behaviour/reader.h"
#include "emulator/machine/kind.h"
#include "emulator/machine/machine_config.h"

namespace fauxboard::behaviour {

/// What a kind of machine brings to profiles, beside what its machine brings.
struct KindRow {
    const machine::Kind& machine;
    std::span<const Field> (*fields)();
    std::span<const ActionInfo> (*actions)();
    /// A configuration of the kind's own type, all of it at its defaults.
    std::shared_ptr<machine::MachineConfig> (*config)();
    /// Reads the kind's own keys of a profile's `machine`; `config` is what the function above made.
    void (*load)(ObjectReader& reader, Findings& findings, machine::MachineConfig& config);
    /// What the screen of its board may list and show; null: nothing.
    std::span<const List> (*lists)() = nullptr;
    std::span<const Picture> (*pictures)() = nullptr;
};

/// One for each of machine::kinds(), in that order.
std::span<const KindRow* const> kinds();

/// What a profile's `machine` says; `node` is null when it says nothing.
///
/// The kind is what `kind` says; else the one that has a section of its name; else the first. Keys of other
/// kinds are checked and have no effect: a base may have them.
struct LoadedMachine {
    const machine::Kind* kind;
    std::shared_ptr<machine::MachineConfig> config;
};
LoadedMachine load_machine(const Json* node, const std::string& pointer, Findings& findings);

}  // namespace fauxboard::behaviour
