#include "emulator/machine/host_side.h"

#include "emulator/machine/event_rows.h"

namespace fauxboard::machine {

void HostSide::power_on() {
    running_ = acknowledged_ = false;
    speaker = usb_port;
    lines = {};
    commands = 0;
    command_.clear();
}

void HostSide::begin(std::size_t from, std::string_view command, SimTime /*now*/) {
    command_.assign(command);
    speaker = from;
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
