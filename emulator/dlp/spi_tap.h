#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

/// Whom a transfer is for: whose chip select is low.
enum class ChipSelect : std::uint8_t { fpga = 0, left = 1, right = 2 };

/// The wires between the board's processor and what makes the picture, for somebody who listens, or who is
/// at their other end instead of the FPGA that is made up here.
class SpiTap {
  public:
    virtual ~SpiTap() = default;
    /// One transfer with chip select low: what the processor sent, and what came back meanwhile.
    virtual void transfer(SimTime now, ChipSelect chip, std::span<const std::uint8_t> out,
                          std::span<const std::uint8_t> in) = 0;
    /// The reset line of the FPGA.
    virtual void reset(SimTime now, bool low) = 0;
    /// What somebody at the other end says of the checksum pin and of the byte read back; nothing: they are
    /// those of the FPGA made up here.
    virtual std::optional<bool> pin() const { return std::nullopt; }
    virtual std::optional<std::uint8_t> read_back() const { return std::nullopt; }
};

}  // namespace fauxboard::dlp
