#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

/// What must never happen to a machine with this board, counted since power-on, so that a scenario can hold
/// it over a whole print.
struct Watch {
    std::uint64_t lit_moving = 0;  ///< moments in which the lamp was on, not by hand, and the platform moved
    std::uint64_t into_model = 0;  ///< and in which the platform was lower than what it had printed
    std::uint64_t wrong_pictures = 0;  ///< pictures displayed that are not the file's
    std::uint64_t lit_at_end = 0;      ///< ends of prints with the lamp on
    double exposure_error_ms = 0;      ///< most that an exposure was longer or shorter than the file says

    std::uint64_t broken() const {
        return lit_moving + into_model + wrong_pictures + lit_at_end + (exposure_error_ms > 1 ? 1U : 0U);
    }

    /// Told at every moment at which something happens. `lamp`: on, but for the UV test's. `mm`: the
    /// platform, as the board counts it.
    void look(bool lamp, bool moving, bool printing, double mm) {
        constexpr double tolerance_mm = 1e-4;
        lit_moving += lamp && moving ? 1U : 0U;
        if (!printing) {
            printed_ = false;
            return;
        }
        if (lamp) {
            lowest_mm_ = mm;
            printed_ = true;
        } else if (printed_ && mm < lowest_mm_ - tolerance_mm) {
            ++into_model;
        }
    }
    void exposed(SimTime lit, double wanted_s) {
        exposure_error_ms = std::max(exposure_error_ms, std::abs(to_seconds(lit) - wanted_s) * 1000);
    }

  private:
    bool printed_ = false;  ///< something is, and the platform must not go below it
    double lowest_mm_ = 0;
};

}  // namespace fauxboard::dlp
