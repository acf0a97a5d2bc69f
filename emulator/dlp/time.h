#pragma once

#include <cstdint>

#include "emulator/machine/sim_time.h"

namespace fauxboard::dlp {

using machine::from_seconds;
using machine::never;
using machine::SimTime;
using machine::to_seconds;

constexpr SimTime ms(std::int64_t count) {
    return SimTime{count * 1000};
}

}  // namespace fauxboard::dlp
