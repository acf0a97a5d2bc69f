#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "emulator/dlp/settings.h"

namespace fauxboard::dlp {

/// The chip: an AT24C16. Fresh from the factory each byte is 0xFF.
constexpr std::size_t eeprom_bytes = 2048;
using EepromBytes = std::array<std::uint8_t, eeprom_bytes>;

enum class Block : std::uint8_t { motor, general, counters };
constexpr std::array<Block, 3> all_blocks{Block::motor, Block::general, Block::counters};
constexpr std::uint16_t address_of(Block block) {
    return static_cast<std::uint16_t>(0x100 * static_cast<unsigned>(block));
}

/// All that the board keeps.
struct Kept {
    Settings settings;
    WorkCounters counters;

    bool operator==(const Kept&) const = default;
};
Kept default_kept(Firmware firmware);

/// A block as this program's board writes it: packed, little endian, with its version and the 16-bit sum of
/// its other bytes. 0.01 has the sum last (84, 24 and 22 bytes), 0.08 first (84, 62 and 26).
std::vector<std::uint8_t> block_bytes(Block block, const Kept& kept, Firmware firmware);

/// What the board found in a block when it started.
enum class BlockState : std::uint8_t {
    good,
    migrated,  ///< of an older program: taken over, and written anew
    broken     ///< wrong sum, or a version that this program does not know: defaults, written anew
};

/// Takes one block out of the chip, each for itself. Where it is broken, `kept` has the defaults.
BlockState take_block(Block block, std::span<const std::uint8_t, eeprom_bytes> chip, Firmware firmware,
                      Kept& kept);

}  // namespace fauxboard::dlp
