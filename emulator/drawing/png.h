#pragma once

#include <string>

#include "emulator/drawing/canvas.h"

namespace fauxboard::drawing {

/// The picture as a PNG file, in memory.
std::string png_bytes(const Picture& picture);

}  // namespace fauxboard::drawing
