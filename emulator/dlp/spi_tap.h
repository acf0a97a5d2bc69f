#pragma once

#include <cstdint>
#include <span>

#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

/// Register of a controller that holds its id; the answer to its reading has it in bytes 2 and 3, low byte
/// first.
constexpr std::uint8_t id_register = 0xB0;

/// Whom a transfer is for: whose chip select is low.
enum class ChipSelect : std::uint8_t { fpga = 0, left = 1, right = 2 };

/// The wires between the board's processor and what makes the picture, for somebody who listens, or who is
/// at their other end instead of the FPGA that is made up here.
class SpiTap {
  public:
    virtual ~SpiTap() = default;
    /// One transfer with chip select low: what the processor sends, and what comes back meanwhile: from what
    /// is made up here, unless somebody puts something else there.
    virtual void transfer(SimTime now, ChipSelect chip, std::span<const std::uint8_t> out,
                          std::span<std::uint8_t> in) = 0;
    /// The board looks at the checksum pin, which the FPGA made up here drives `good` or bad. What the board
    /// sees.
    virtual bool pin(SimTime now, bool good) = 0;
    /// The reset line of the FPGA.
    virtual void reset(SimTime now, bool low) = 0;
};

}  // namespace fauxboard::dlp
