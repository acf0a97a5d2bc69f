#pragma once

namespace fauxboard::dlp {

/// The screw with its platform, as it was built.
struct PlatformConfig {
    double travel_mm = 190;    ///< from the lower switch to the upper one
    double start_mm = 100;     ///< over the lower switch, where the platform stands when the world begins
    double overtravel_mm = 2;  ///< beyond a switch, until it cannot go on
};

}  // namespace fauxboard::dlp
