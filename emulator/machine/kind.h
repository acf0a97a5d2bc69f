#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "emulator/machine/events.h"
#include "emulator/machine/faults.h"

namespace fauxboard::machine {

class Machine;
struct MachineConfig;
struct Services;

/// A kind of machine: what makes one, and what may happen to it or go wrong with it beside what every machine
/// has. What profiles say of it stands in behaviour::KindRow.
struct Kind {
    std::string_view name;  ///< as profiles write it
    std::string_view help;  ///< a line for the reference
    std::span<const EventInfo> events;
    std::span<const FaultInfo> (*faults)();
    /// `config` is of the type that behaviour::KindRow::config gave.
    std::unique_ptr<Machine> (*make)(std::shared_ptr<const MachineConfig> config, const Services& services,
                                     std::uint64_t seed);
};

/// Every kind of this program, in the order of the table of kinds; the first is that of a profile that says
/// nothing. The table is made by CMake out of its fauxboard_kind() rows.
std::span<const Kind* const> kinds();

}  // namespace fauxboard::machine
