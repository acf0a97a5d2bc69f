#include "emulator/resin/kind.h"

#include <utility>

#include "emulator/resin/event_rows.h"
#include "emulator/resin/printer.h"

namespace fauxboard::resin {
namespace {

std::unique_ptr<machine::Machine> make(std::shared_ptr<const machine::MachineConfig> config,
                                       const machine::Services& services, std::uint64_t seed) {
    return std::make_unique<Printer>(std::static_pointer_cast<const Config>(std::move(config)), services,
                                     seed);
}

}  // namespace

constinit const machine::Kind own_kind{"resin", "hardens resin: a platform, a light, settings by M8xxx",
                                       own_events, machine::no_faults, make};

}  // namespace fauxboard::resin
