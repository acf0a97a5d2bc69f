#include "emulator/dlp/crc16.h"

#include <array>
#include <cstddef>

namespace fauxboard::dlp {
namespace {

constexpr unsigned polynomial = 0x1021;
constexpr std::size_t slices = 8;
using Table = std::array<std::uint16_t, 256>;

/// Row k: what a byte adds that k more bytes follow. Eight bytes are so looked up side by side.
constexpr std::array<Table, slices> tables = [] {
    std::array<Table, slices> rows{};
    for (unsigned byte = 0; byte < 256; ++byte) {
        unsigned crc = byte << 8;
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc & 0x8000) != 0 ? crc << 1 ^ polynomial : crc << 1;
        }
        rows[0][byte] = static_cast<std::uint16_t>(crc);
    }
    for (std::size_t k = 1; k < slices; ++k) {
        for (unsigned byte = 0; byte < 256; ++byte) {
            const unsigned before = rows[k - 1][byte];
            rows[k][byte] = static_cast<std::uint16_t>(before << 8 ^ rows[0][before >> 8]);
        }
    }
    return rows;
}();

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
    unsigned crc = 0;
    while (bytes.size() >= slices) {
        crc = static_cast<unsigned>(tables[7][bytes[0] ^ crc >> 8] ^ tables[6][bytes[1] ^ (crc & 0xFF)] ^
                                    tables[5][bytes[2]] ^ tables[4][bytes[3]] ^ tables[3][bytes[4]] ^
                                    tables[2][bytes[5]] ^ tables[1][bytes[6]] ^ tables[0][bytes[7]]);
        bytes = bytes.subspan(slices);
    }
    for (const std::uint8_t byte : bytes) {
        crc = (crc << 8 & 0xFFFF) ^ tables[0][(crc >> 8 ^ byte) & 0xFF];
    }
    return static_cast<std::uint16_t>(crc);
}

}  // namespace fauxboard::dlp
