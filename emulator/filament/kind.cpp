#include "emulator/filament/kind.h"

#include <utility>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/printer.h"

namespace fauxboard::filament {
namespace {

std::unique_ptr<machine::Machine> make(std::shared_ptr<const machine::MachineConfig> config,
                                       const machine::Services& services, std::uint64_t seed) {
    return std::make_unique<Printer>(std::static_pointer_cast<const Config>(std::move(config)), services,
                                     seed);
}

}  // namespace

constinit const machine::Kind own_kind{"filament",
                                       "melts filament: heaters, motion, planner, mixing extruders, G-code",
                                       own_events, own_faults, make};

}  // namespace fauxboard::filament
