#include "emulator/dlp/uv_panel.h"

#include <algorithm>
#include <array>

namespace fauxboard::dlp {
namespace {

constexpr std::uint16_t controller_id = 0x2828;
constexpr unsigned clean_bank = 2;

// What the controllers are told: display on and off, sleep out and in, and their own configuration.
constexpr std::uint8_t display_off = 0x28;
constexpr std::uint8_t display_on = 0x29;
constexpr std::uint8_t sleep_in = 0x10;
constexpr std::uint8_t sleep_out = 0x11;
constexpr std::uint8_t configuration = 0xB7;
constexpr std::uint16_t configuration_asleep = 0x0004;
constexpr std::uint16_t configuration_awake = 0x030B;

bool dark(const Packet& packet) {
    return std::all_of(packet.begin() + 2, packet.end() - 2, [](std::uint8_t byte) { return byte == 0; });
}

}  // namespace

void UvPanel::cut_power() {
    const FpgaTrouble trouble = fpga_.trouble;
    fpga_ = Fpga(fpga_.counters().packets * 2 + 1, fpga_.version());
    fpga_.trouble = trouble;
    counters_ = {};
    last_open_ = awake_ = powered_ = false;
}

std::uint16_t UvPanel::controller(ChipSelect chip, std::uint8_t reg, std::uint16_t value, SimTime now) {
    const std::array<std::uint8_t, 4> out{reg, static_cast<std::uint8_t>(value & 0xFF),
                                          static_cast<std::uint8_t>(value >> 8), 0};
    std::array<std::uint8_t, 4> in{};
    if (reg == id_register && !id_missing) {
        in[2] = controller_id & 0xFF;
        in[3] = controller_id >> 8;
    }
    if (tap != nullptr) {
        tap->transfer(now, chip, out, in);
    }
    return static_cast<std::uint16_t>(in[3] << 8 | in[2]);
}

void UvPanel::controllers(std::uint8_t reg, std::uint16_t value, SimTime now) {
    for (const ChipSelect chip : {ChipSelect::left, ChipSelect::right}) {
        static_cast<void>(controller(chip, reg, value, now));
    }
}

/// Both are asked, also when the first has none.
bool UvPanel::both_have_ids(SimTime now) {
    const bool left = controller(ChipSelect::left, id_register, 0, now) == controller_id;
    const bool right = controller(ChipSelect::right, id_register, 0, now) == controller_id;
    return left && right;
}

/// A transfer with the FPGA, of which others may know.
void UvPanel::transfer(std::span<const std::uint8_t> out, std::span<std::uint8_t> in, SimTime now) {
    fpga_.transfer(out, in);
    if (tap != nullptr) {
        tap->transfer(now, ChipSelect::fpga, out, in);
    }
}

void UvPanel::packet(SimTime now) {
    fpga_.packet(last_);
    if (tap != nullptr) {
        tap->transfer(now, ChipSelect::fpga, last_, {});
    }
}

bool UvPanel::set_up(bool clean, SimTime now) {
    if (clean && !reset_rudely) {
        command(clean_bank, false, false, now);
    }
    awake_ = false;
    if (tap != nullptr) {
        tap->reset(now, true);
    }
    fpga_.reset();
    powered_ = true;
    now += ms(855);
    if (tap != nullptr) {
        tap->reset(now, false);
    }
    if (!both_have_ids(now)) {
        powered_ = false;
        return false;
    }
    command(0, true, false, now);
    now += ms(50);
    sleep(now);
    command(0, false, false, now);
    return true;
}

void UvPanel::wake(SimTime now) {
    controllers(display_on, 0, now);
    controllers(sleep_out, 0, now);
    controllers(configuration, configuration_awake, now);
    awake_ = powered_;
}

void UvPanel::sleep(SimTime now) {
    controllers(display_off, 0, now);
    controllers(sleep_in, 0, now);
    controllers(configuration, configuration_asleep, now);
    awake_ = false;
}

void UvPanel::power_off(SimTime now) {
    sleep(now);
    powered_ = false;
}

void UvPanel::command(unsigned bank, bool scan, bool read, SimTime now) {
    const std::array<std::uint8_t, 3> write{0, 0, command_of(bank, scan, read)};
    const std::array<std::uint8_t, 3> ask{0x80, 0xFF, 0xFF};
    for (int tries = 0; tries < most_tries; ++tries) {
        std::array<std::uint8_t, 3> in{};
        transfer(write, in, now);
        transfer(ask, in, now);
        if ((in[2] & 0xF0) == write[2]) {
            return;
        }
    }
    ++counters_.failed_commands;  // the board goes on all the same
}

void UvPanel::begin_picture(unsigned bank) {
    bank_ = bank;
    bad_lines_ = 0;
    last_open_ = false;
}

/// What the pin says of the packet before; up to five more tries when it was bad.
void UvPanel::check_line(SimTime now) {
    const auto good = [&] { return tap != nullptr ? tap->pin(now, fpga_.crc_pin()) : fpga_.crc_pin(); };
    if (!last_open_) {
        return;
    }
    last_open_ = false;
    for (int tries = 0; tries < most_tries; ++tries) {
        if (good()) {
            return;
        }
        ++counters_.resends;
        ++(dark(last_) ? counters_.fill_retries : counters_.data_retries);
        packet(now);
    }
    if (!good()) {
        ++counters_.failed_lines;
        ++bad_lines_;
    }
}

void UvPanel::send_line(Packet& data, unsigned line, SimTime now) {
    check_line(now);
    seal(data, bank_, line);
    last_ = data;
    packet(now);
    last_open_ = true;
}

unsigned UvPanel::end_picture(SimTime now) {
    check_line(now);
    return bad_lines_;
}

std::uint32_t UvPanel::lit() const {
    if (white()) {
        return panel_columns * panel_lines;
    }
    return showing() ? fpga_.lit_pixels(bank_of(fpga_.command())) : 0;
}

}  // namespace fauxboard::dlp
