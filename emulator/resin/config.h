#pragma once

#include <array>
#include <cstdint>

#include "emulator/machine/machine_config.h"

namespace fauxboard::resin {

/// What a profile says of a resin machine that none of its settings (M8xxx) says. Lengths in mm, times in s.
struct ResinConfig {
    double travel_mm = 160;        ///< way of the platform from its end stop to the other end
    double power_on_mm = 60;       ///< where it stands when the board is first switched on
    double homing_bounce_mm = 5;   ///< back from the end stop before the second, slow touch
    double pause_lift_mm = 30;     ///< how far a pause lifts the platform
    double pause_from_s = 3;       ///< a pause shows so long after it was asked for, at least
    double pause_to_s = 5;         ///< and at most
    double stick_visible_s = 2.5;  ///< from a stick's insertion until the board can read it
    int stir_cycles = 50;          ///< G29
    /// The words of the diagnostics file (M8093): temperature, other, memory, communication, indicator,
    /// driver, printer, LCD.
    std::array<std::uint32_t, 8> status{};
};

/// What a profile can say about a resin printer.
struct Config : machine::MachineConfig {
    ResinConfig resin;
};

}  // namespace fauxboard::resin
