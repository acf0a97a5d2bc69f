#pragma once

namespace fauxboard::filament {

/// A straight way that a tool has gone, mm in the coordinates of the bed.
struct Travel {
    double from_x = 0;
    double from_y = 0;
    double to_x = 0;
    double to_y = 0;
    double z = 0;
    bool draws = false;  ///< leaves material behind
};

}  // namespace fauxboard::filament
