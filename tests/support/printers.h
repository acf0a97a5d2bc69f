#pragma once

#include "emulator/filament/printer.h"
#include "emulator/resin/printer.h"

namespace fauxboard::testing {

// A machine as that of its kind; throws std::bad_cast when it is of another one.

inline filament::Printer& filament_printer(machine::Machine& machine) {
    return dynamic_cast<filament::Printer&>(machine);
}
inline resin::Printer& resin_printer(machine::Machine& machine) {
    return dynamic_cast<resin::Printer&>(machine);
}

}  // namespace fauxboard::testing
