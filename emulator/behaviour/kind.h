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

/// The kind that a profile's `machine` is of: `kind` says it; else the one that has a section of its name;
/// else the first. A name that no kind has is added to the findings.
const KindRow& kind_of(const Json& machine, const std::string& pointer, Findings& findings);

}  // namespace fauxboard::behaviour
