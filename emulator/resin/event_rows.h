#pragma once

#include "emulator/machine/event_rows.h"

namespace fauxboard::resin {

/// What may happen to a resin printer, beside what may happen to every machine.
inline constexpr auto own_events = std::to_array<machine::EventInfo>({
    {"board.reboot_due", "the time that board.reboot was given has passed"},
});

/// The event that has this name, an own one or one of all machines.
consteval machine::EventId event(std::string_view name) {
    return machine::event_in(name, own_events, machine::common_events);
}

}  // namespace fauxboard::resin
