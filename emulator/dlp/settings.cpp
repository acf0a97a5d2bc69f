#include "emulator/dlp/settings.h"

namespace fauxboard::dlp {

Settings default_settings(Firmware firmware) {
    Settings settings;
    if (firmware == Firmware::v008) {
        settings.motor.hold_time_ms = 30'000;
        settings.motor.off_time_ms = 1'800'000;
        settings.general.screensaver_ms = 600'000;
    }
    return settings;
}

}  // namespace fauxboard::dlp
