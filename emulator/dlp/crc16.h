#pragma once

#include <cstdint>
#include <span>

namespace fauxboard::dlp {

/// The checksum of the panel's packets: polynomial 0x1021, from 0, not reflected. "123456789" is 0x31C3.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

}  // namespace fauxboard::dlp
