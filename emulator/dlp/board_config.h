#pragma once

#include <cstdint>
#include <optional>

#include "emulator/dlp/calendar.h"
#include "emulator/dlp/platform_config.h"
#include "emulator/dlp/quirks.h"
#include "emulator/dlp/settings.h"

namespace fauxboard::dlp {

/// What a profile says of the board and of the machine around it.
struct BoardConfig {
    Firmware firmware = Firmware::v001;
    PlatformConfig platform;
    Quirks quirks;
    std::uint8_t fpga_version = 2;
    bool lists_ctb = false;
    std::optional<Moment> clock;  ///< when the world begins; nothing: the clock was never set
};

}  // namespace fauxboard::dlp
