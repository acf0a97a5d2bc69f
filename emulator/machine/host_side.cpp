#include "emulator/machine/host_side.h"

#include "emulator/machine/event_rows.h"

namespace fauxboard::machine {
namespace {

constexpr std::size_t shown_bytes = 96;

}  // namespace

void HostSide::power_on() {
    running_ = acknowledged_ = false;
    last_line = 0;
    resends = commands = 0;
    command_.clear();
}

void HostSide::begin(std::string_view command, SimTime /*now*/) {
    command_.assign(command.substr(0, shown_bytes));
    running_ = true;
    acknowledged_ = false;
    ++commands;
}

void HostSide::over() {
    running_ = false;
    if (!acknowledged_) {
        events_.raise(event("host.done"));
    }
}

}  // namespace fauxboard::machine
