#include "emulator/dlp/eeprom_layout.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

using namespace fauxboard::dlp;

namespace {

std::string hex(std::span<const std::uint8_t> bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes) {
        text += fmt::format("{:02x}", byte);
    }
    return text;
}

EepromBytes chip_of(const Kept& kept, Firmware firmware) {
    EepromBytes chip;
    chip.fill(0xFF);
    for (const Block block : all_blocks) {
        const auto bytes = block_bytes(block, kept, firmware);
        std::copy(bytes.begin(), bytes.end(), chip.begin() + address_of(block));
    }
    return chip;
}

Kept odd_values() {
    Kept kept;
    kept.settings.motor.steps_per_mm = 3200;
    kept.settings.motor.home_direction = 1;
    kept.settings.general.pause_lift_mm = 25.5F;
    kept.settings.general.language = 1;
    kept.counters = {57'599, 0, 133'200, 133'200, 0};
    return kept;
}

}  // namespace

TEST_CASE("EEPROM: what a board writes that has its defaults") {
    const Kept kept = default_kept(Firmware::v001);
    CHECK(
        hex(block_bytes(Block::motor, kept, Firmware::v001)) ==
        "010001ff00000000000040c00000344301010000c8440000c8420000c8420ad7233c0ad7233ccdcc4c3d3333333f0000a040"
        "0000a0410000a0410000c0400000803f00004844000096431027000060ea00005b12");
    CHECK(hex(block_bytes(Block::general, kept, Firmware::v001)) ==
          "0100000000000000002042013200200360ea000001000402");
    CHECK(hex(block_bytes(Block::counters, kept, Firmware::v001)) ==
          "01000000000000000000000000000000000000000100");
    const Kept later = default_kept(Firmware::v008);
    const auto sum = [&](Block block) { return hex(block_bytes(block, later, Firmware::v008)).substr(0, 4); };
    CHECK(sum(Block::motor) == "5812");
    CHECK(sum(Block::general) == "9103");
    CHECK(sum(Block::counters) == "0800");
    CHECK(block_bytes(Block::motor, later, Firmware::v008).size() == 84);
    CHECK(block_bytes(Block::general, later, Firmware::v008).size() == 62);
    CHECK(block_bytes(Block::counters, later, Firmware::v008).size() == 26);
}

TEST_CASE("EEPROM: a pause lift of 25.5 mm stands at 0x107, the sum at 0x116") {
    Kept kept = default_kept(Firmware::v001);
    kept.settings.general.pause_lift_mm = 25.5F;
    const EepromBytes chip = chip_of(kept, Firmware::v001);
    CHECK(hex(std::span(chip).subspan(0x107, 4)) == "0000cc41");
    CHECK(hex(std::span(chip).subspan(0x116, 2)) == "af02");
}

TEST_CASE("EEPROM: what was written is read, by the program that wrote it") {
    for (const Firmware firmware : {Firmware::v001, Firmware::v008}) {
        Kept kept = odd_values();
        if (firmware == Firmware::v008) {
            kept.settings.general.fan_mode = 2;
            kept.settings.general.touch[3] = 0.25F;
            kept.counters.on_s = 99;
        }
        const EepromBytes chip = chip_of(kept, firmware);
        Kept read;
        for (const Block block : all_blocks) {
            CHECK(take_block(block, chip, firmware, read) == BlockState::good);
        }
        CHECK(read == kept);
    }
}

TEST_CASE("EEPROM: a block that is broken has its defaults, and the others are as they were") {
    const Kept kept = odd_values();
    for (std::size_t at = 0; at < 84; ++at) {
        EepromBytes chip = chip_of(kept, Firmware::v001);
        chip[at] ^= 0x10;
        Kept read;
        CHECK(take_block(Block::motor, chip, Firmware::v001, read) == BlockState::broken);
        CHECK(take_block(Block::general, chip, Firmware::v001, read) == BlockState::good);
        CHECK(read.settings.motor == MotorSettings{});
        CHECK(read.settings.general == kept.settings.general);
    }
    for (const std::uint8_t byte : {std::uint8_t{0x00}, std::uint8_t{0xFF}}) {
        EepromBytes chip;
        chip.fill(byte);
        for (const Firmware firmware : {Firmware::v001, Firmware::v008}) {
            Kept read = odd_values();
            for (const Block block : all_blocks) {
                CHECK(take_block(block, chip, firmware, read) == BlockState::broken);
            }
            CHECK(read == default_kept(firmware));
        }
    }
}

TEST_CASE("EEPROM: the sum does not see two bytes that changed places") {
    EepromBytes chip = chip_of(odd_values(), Firmware::v001);
    std::swap(chip[0x107 + 2], chip[0x107 + 3]);
    Kept read;
    CHECK(take_block(Block::general, chip, Firmware::v001, read) == BlockState::good);
    CHECK(read.settings.general.pause_lift_mm != 25.5F);
}

TEST_CASE("EEPROM: 0.08 takes over what 0.01 wrote; 0.01 does not know what 0.08 wrote") {
    const Kept kept = odd_values();
    Kept read;
    const EepromBytes old = chip_of(kept, Firmware::v001);
    for (const Block block : all_blocks) {
        CHECK(take_block(block, old, Firmware::v008, read) == BlockState::migrated);
    }
    CHECK(read.settings.motor == kept.settings.motor);
    CHECK(read.settings.general.pause_lift_mm == 25.5F);
    CHECK(read.settings.general.fan_mode == 1);
    CHECK(read.settings.general.calibrate_lift_mm == 100);
    CHECK(read.settings.general.decrease_steps == 10);
    CHECK(read.counters.led_s == 57'599);

    const EepromBytes later = chip_of(kept, Firmware::v008);
    for (const Block block : all_blocks) {
        CHECK(take_block(block, later, Firmware::v001, read) == BlockState::broken);
    }

    // Between the two: the sum is not looked at.
    EepromBytes between = later;
    between[0x102] = 7;
    CHECK(take_block(Block::general, between, Firmware::v008, read) == BlockState::migrated);
    CHECK(read.settings.general.pause_lift_mm == 25.5F);
}

TEST_CASE("EEPROM: a chip may hold numbers that are none") {
    Kept kept = odd_values();
    kept.settings.motor.acceleration = std::numeric_limits<float>::quiet_NaN();
    kept.settings.motor.steps_per_mm = 0;
    kept.settings.general.zero_pos_mm = std::numeric_limits<float>::infinity();
    const EepromBytes chip = chip_of(kept, Firmware::v001);
    Kept read;
    CHECK(take_block(Block::motor, chip, Firmware::v001, read) == BlockState::good);
    CHECK(take_block(Block::general, chip, Firmware::v001, read) == BlockState::good);
    CHECK(read.settings.motor.acceleration == 0.7F);
    CHECK(read.settings.motor.steps_per_mm == 1600);
    CHECK(read.settings.general.zero_pos_mm == 0);
}
