#include "emulator/dlp/kind.h"

#include <utility>

#include "emulator/dlp/event_rows.h"
#include "emulator/dlp/printer.h"

namespace fauxboard::dlp {
namespace {

std::unique_ptr<machine::Machine> make(std::shared_ptr<const machine::MachineConfig> config,
                                       const machine::Services& services, std::uint64_t seed) {
    return std::make_unique<Printer>(std::static_pointer_cast<const Config>(std::move(config)), services,
                                     seed);
}

}  // namespace

constinit const machine::Kind own_kind{
    "dlp", "the MKS DLP board: a platform, a UV lamp, a UV panel behind an FPGA, and a screen of its own",
    own_events, own_faults, make};

}  // namespace fauxboard::dlp
