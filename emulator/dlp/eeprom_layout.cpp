#include "emulator/dlp/eeprom_layout.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <type_traits>

namespace fauxboard::dlp {
namespace {

constexpr std::size_t sum_bytes = 2;
constexpr std::uint32_t version_001 = 1;
constexpr std::uint32_t version_008 = 8;
/// The first version that had the sum before the rest.
constexpr std::uint32_t first_with_sum_first = 2;

/// Writes a block's values one after the other.
class Writer {
  public:
    template <class T>
    void value(const T& slot) {
        constexpr std::size_t size = sizeof(T);
        std::array<std::uint8_t, size> raw{};
        std::memcpy(raw.data(), &slot, size);
        bytes.insert(bytes.end(), raw.begin(), raw.end());
    }
    std::vector<std::uint8_t> bytes;
};
static_assert(std::endian::native == std::endian::little, "values are copied as they stand");

/// Reads them in the same order.
class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    template <class T>
    void value(T& slot) {
        std::memcpy(&slot, bytes_.data(), sizeof(T));
        bytes_ = bytes_.subspan(sizeof(T));
    }

  private:
    std::span<const std::uint8_t> bytes_;
};

/// Values of the planner that stand in the motor's block and that nothing changes.
struct PlannerConstants {
    float max_feedrate = planner_limit;
    float max_acceleration = planner_limit;
    float min_feedrate = 0.01F;
    float min_travel_feedrate = 0.01F;
    float jerk = 0.05F;
};

template <class Io, class Motor>
void motor_values(Io& io, Motor& m) {
    PlannerConstants planner;
    io.value(m.invert_dir), io.value(m.home_direction);
    io.value(m.home_pos_mm), io.value(m.min_pos_mm), io.value(m.max_pos_mm);
    io.value(m.min_endstop_inverting), io.value(m.max_endstop_inverting), io.value(m.steps_per_mm);
    io.value(planner.max_feedrate), io.value(planner.max_acceleration), io.value(planner.min_feedrate);
    io.value(planner.min_travel_feedrate), io.value(planner.jerk);
    io.value(m.acceleration), io.value(m.feedrate);
    io.value(m.travel_acceleration), io.value(m.travel_feedrate);
    io.value(m.homing_feedrate_fast), io.value(m.homing_feedrate_slow);
    io.value(m.current_vref), io.value(m.current_hold_vref);
    io.value(m.hold_time_ms), io.value(m.off_time_ms);
}

template <class Io, class General>
void general_values(Io& io, General& g, Firmware firmware) {
    io.value(g.language), io.value(g.zero_pos_mm), io.value(g.pause_lift_mm);
    io.value(g.buzzer), io.value(g.buzzer_touch_ms), io.value(g.buzzer_msg_ms);
    io.value(g.screensaver_ms), io.value(g.screensaver_type), io.value(g.rotate_display);
    if (firmware == Firmware::v008) {
        // Their order is not known; this one is chosen.
        io.value(g.end_lift_mm), io.value(g.external_clock);
        for (auto& coefficient : g.touch) {
            io.value(coefficient);
        }
        io.value(g.fan_mode), io.value(g.calibrate_lift_mm), io.value(g.decrease_steps);
    }
}

template <class Io, class Counters>
void counter_values(Io& io, Counters& c, Firmware firmware) {
    io.value(c.led_s), io.value(c.display_s), io.value(c.fan_s), io.value(c.print_s);
    if (firmware == Firmware::v008) {
        io.value(c.on_s);
    }
}

template <class Io, class AnyKept>
void block_values(Io& io, Block block, AnyKept& kept, Firmware firmware) {
    switch (block) {
        case Block::motor:
            return motor_values(io, kept.settings.motor);
        case Block::general:
            return general_values(io, kept.settings.general, firmware);
        case Block::counters:
            return counter_values(io, kept.counters, firmware);
    }
}

std::size_t version_bytes(Block block) {
    return block == Block::counters ? 4 : 2;
}

std::size_t size_of(Block block, Firmware firmware) {
    Writer writer;
    const Kept kept;
    block_values(writer, block, kept, firmware);
    return sum_bytes + version_bytes(block) + writer.bytes.size();
}

std::uint16_t sum_of(std::span<const std::uint8_t> bytes) {
    return static_cast<std::uint16_t>(std::accumulate(bytes.begin(), bytes.end(), 0U));
}

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t size) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data(), size);
    return value;
}

/// A block as it stands in the chip, by the layout of a program.
struct View {
    View(Block block, std::span<const std::uint8_t, eeprom_bytes> chip, Firmware firmware)
        : all(chip.subspan(address_of(block), size_of(block, firmware))),
          body(firmware == Firmware::v008 ? all.subspan(sum_bytes) : all.first(all.size() - sum_bytes)),
          sum(static_cast<std::uint16_t>(
              number_at(firmware == Firmware::v008 ? all : all.last(sum_bytes), sum_bytes))),
          version(number_at(body, version_bytes(block))),
          values(body.subspan(version_bytes(block))) {}
    bool sum_good() const { return sum == sum_of(body); }

    std::span<const std::uint8_t> all;
    std::span<const std::uint8_t> body;
    std::uint16_t sum;
    std::uint32_t version;
    std::span<const std::uint8_t> values;
};

void take_values(Block block, const View& view, Firmware firmware, Kept& kept) {
    Reader reader(view.values);
    block_values(reader, block, kept, firmware);
}

/// What a chip may bring that no program of the board ever wrote: the planner must live with it.
void mend(Settings& settings) {
    const Settings fallback;
    MotorSettings& m = settings.motor;
    const auto mend_one = [](float& slot, float other, bool positive) {
        if (!std::isfinite(slot) || (positive && slot <= 0)) {
            slot = other;
        }
    };
    mend_one(m.steps_per_mm, fallback.motor.steps_per_mm, true);
    mend_one(m.acceleration, fallback.motor.acceleration, true);
    mend_one(m.feedrate, fallback.motor.feedrate, true);
    mend_one(m.travel_acceleration, fallback.motor.travel_acceleration, true);
    mend_one(m.travel_feedrate, fallback.motor.travel_feedrate, true);
    mend_one(m.homing_feedrate_fast, fallback.motor.homing_feedrate_fast, true);
    mend_one(m.homing_feedrate_slow, fallback.motor.homing_feedrate_slow, true);
    mend_one(settings.general.zero_pos_mm, 0, false);
    mend_one(settings.general.pause_lift_mm, fallback.general.pause_lift_mm, false);
    mend_one(settings.general.end_lift_mm, fallback.general.end_lift_mm, false);
    for (std::size_t i = 0; i < no_calibration.size(); ++i) {
        mend_one(settings.general.touch[i], no_calibration[i], false);
    }
}

/// What a program that takes over an older block sets, and its own defaults do not.
void fill_in(Kept& kept) {
    kept.settings.general.fan_mode = 1;
    kept.settings.general.calibrate_lift_mm = 100;
    kept.settings.general.decrease_steps = 10;
}

BlockState take_008(Block block, std::span<const std::uint8_t, eeprom_bytes> chip, Kept& kept) {
    const View own(block, chip, Firmware::v008);
    if (own.version == version_008 && own.sum_good()) {
        take_values(block, own, Firmware::v008, kept);
        return BlockState::good;
    }
    const View first(block, chip, Firmware::v001);
    const bool of_first = first.version == version_001 && first.sum_good();
    const bool between = own.version >= first_with_sum_first && own.version < version_008;
    if (!of_first && !between) {
        return BlockState::broken;
    }
    take_values(block, of_first ? first : own, of_first ? Firmware::v001 : Firmware::v008, kept);
    if (block == Block::general) {
        fill_in(kept);
    }
    return BlockState::migrated;
}

}  // namespace

Kept default_kept(Firmware firmware) {
    return {default_settings(firmware), {}};
}

std::vector<std::uint8_t> block_bytes(Block block, const Kept& kept, Firmware firmware) {
    Writer body;
    const std::uint32_t version = firmware == Firmware::v008 ? version_008 : version_001;
    if (block == Block::counters) {
        body.value(version);
    } else {
        body.value(static_cast<std::uint16_t>(version));
    }
    block_values(body, block, kept, firmware);
    Writer sum;
    sum.value(sum_of(body.bytes));
    std::vector<std::uint8_t> out = std::move(body.bytes);
    out.insert(firmware == Firmware::v008 ? out.begin() : out.end(), sum.bytes.begin(), sum.bytes.end());
    return out;
}

BlockState take_block(Block block, std::span<const std::uint8_t, eeprom_bytes> chip, Firmware firmware,
                      Kept& kept) {
    BlockState state = BlockState::broken;
    if (firmware == Firmware::v008) {
        state = take_008(block, chip, kept);
    } else if (const View view(block, chip, firmware); view.version == version_001 && view.sum_good()) {
        take_values(block, view, firmware, kept);
        state = BlockState::good;
    }
    if (state == BlockState::broken) {
        const Kept defaults = default_kept(firmware);
        const std::vector<std::uint8_t> fresh = block_bytes(block, defaults, firmware);
        const std::size_t head = version_bytes(block) + (firmware == Firmware::v008 ? sum_bytes : 0);
        Reader reader(std::span<const std::uint8_t>(fresh).subspan(head));
        block_values(reader, block, kept, firmware);
    }
    mend(kept.settings);
    return state;
}

}  // namespace fauxboard::dlp
