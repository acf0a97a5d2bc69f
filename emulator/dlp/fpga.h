#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/dlp/panel_line.h"

namespace fauxboard::dlp {

/// Bits of the FPGA's command byte.
constexpr std::uint8_t scan_bit = 0x80;  ///< output to the panel
constexpr std::uint8_t read_bit = 0x40;  ///< what is put out comes from SDRAM
constexpr std::uint8_t command_of(unsigned bank, bool scan, bool read) {
    return static_cast<std::uint8_t>((scan ? scan_bit : 0) | (read ? read_bit : 0) | bank << 4);
}
constexpr unsigned bank_of(std::uint8_t command) {
    return command >> 4 & 3;
}

/// What goes wrong with the FPGA, as somebody wishes it.
struct FpgaTrouble {
    std::optional<unsigned> bad_line;  ///< packets of this line arrive damaged
    double bad_share = 0;              ///< of all packets, 0 to 1
    std::optional<bool> stuck_pin;     ///< the checksum pin says so always: true good
    bool wrong_read_back = false;
    bool sdram_stuck = false;           ///< now: nothing is stored, and what is shown is white
    std::optional<bool> unclean_reset;  ///< whether one goes wrong; else by chance
    double unclean_share = 1.0 / 7;     ///< that chance
};

/// The FPGA between the board's processor and the UV panel, as it is seen over SPI: four banks of SDRAM, a
/// command byte that can be read back, a pin that says whether the last packet's checksum was good.
///
/// Its reset line is an ordinary input. Pulled while a picture is read from SDRAM, it may leave the SDRAM
/// dead: packets are taken, nothing is stored, and the panel is all white until a clean reset.
class Fpga {
  public:
    explicit Fpga(std::uint64_t seed, std::uint8_t version = 2)
        : version_(version & 0x0F), random_(seed | 1) {}

    struct Counters {
        std::uint64_t packets = 0;
        std::uint64_t crc_errors = 0;
        std::uint64_t commands = 0;
        std::uint64_t strange = 0;  ///< transfers that mean nothing
    };

    /// One transfer with chip select low. `in` has the length of `out` and takes what came meanwhile.
    void transfer(std::span<const std::uint8_t> out, std::span<std::uint8_t> in);
    /// A packet of a line, as transfer() takes it.
    void packet(std::span<const std::uint8_t, packet_bytes> packet);
    /// True: the last packet was good. Pulled up, so true before the first.
    bool crc_pin() const { return trouble.stuck_pin.value_or(pin_); }
    void reset();

    std::uint8_t command() const { return command_; }
    std::uint8_t version() const { return version_; }
    bool white() const { return dead_ || trouble.sdram_stuck; }
    const Counters& counters() const { return counters_; }

    /// What a bank holds: 2560 lines of 192 bytes. Empty when nothing was ever stored: all dark.
    std::span<const std::uint8_t> line(unsigned bank, unsigned line) const;
    std::uint32_t lit_pixels(unsigned bank) const;
    /// MD5 of the 2560 packets that bring this picture into bank 0.
    const std::string& md5(unsigned bank) const;
    /// add_line() of all its lines.
    std::uint64_t sum(unsigned bank) const;

    FpgaTrouble trouble;

  private:
    /// Of a bank; told once and kept until it changes.
    struct Digest {
        std::optional<std::uint32_t> lit;
        std::string md5;
    };
    double random();
    bool damaged(unsigned line);

    std::array<std::vector<std::uint8_t>, bank_count> banks_;
    mutable std::array<Digest, bank_count> digests_;
    Counters counters_;
    std::uint8_t command_ = 0;
    std::uint8_t version_;
    bool pin_ = true;
    bool dead_ = false;
    std::uint64_t random_;
};

}  // namespace fauxboard::dlp
