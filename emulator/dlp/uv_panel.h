#pragma once

#include <cstdint>
#include <functional>

#include "emulator/dlp/fpga.h"
#include "emulator/dlp/spi_tap.h"
#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

/// The UV panel with its two controllers (SSD2828) and its FPGA, and what the board's program does with
/// them.
class UvPanel {
  public:
    explicit UvPanel(std::uint64_t seed, std::uint8_t fpga_version) : fpga_(seed, fpga_version) {}

    /// The supply went: SDRAM and controllers start anew.
    void cut_power();
    /// Sets everything up, in the board's order. Unless `clean`, the FPGA is not told to be quiet first.
    /// False when a controller does not answer with its id.
    bool set_up(bool clean, SimTime now);
    /// How long that takes.
    static constexpr SimTime set_up_time = ms(1050);
    void wake(SimTime now);
    void sleep(SimTime now);
    void power_off(SimTime now);

    /// Writes the command byte, up to five times until it reads back.
    void command(unsigned bank, bool scan, bool read, SimTime now);

    /// Packets of one picture, with what the board does about bad ones.
    void begin_picture(unsigned bank);
    void send_line(Packet& data, unsigned line, SimTime now);
    /// The last line is checked, too. Lines of the picture that the FPGA never took.
    unsigned end_picture(SimTime now);

    struct Counters {
        std::uint64_t resends = 0;
        std::uint64_t data_retries = 0;  ///< resends of lines with light
        std::uint64_t fill_retries = 0;  ///< and of dark ones
        std::uint64_t failed_lines = 0;
        std::uint64_t failed_commands = 0;
    };
    const Counters& counters() const { return counters_; }

    Fpga& fpga() { return fpga_; }
    const Fpga& fpga() const { return fpga_; }
    bool awake() const { return awake_; }
    bool powered() const { return powered_; }
    /// A picture is put out and lets light through.
    bool showing() const {
        return awake_ && powered_ && (fpga_.command() & (scan_bit | read_bit)) == (scan_bit | read_bit);
    }
    bool white() const { return awake_ && powered_ && (fpga_.command() & scan_bit) != 0 && fpga_.white(); }
    /// Lit pixels that can be seen.
    std::uint32_t lit() const;

    bool id_missing = false;
    bool reset_rudely = false;  ///< the FPGA is never told to be quiet before a reset
    SpiTap* tap = nullptr;

  private:
    static constexpr int most_tries = 5;
    void check_line(SimTime now);
    void transfer(std::span<const std::uint8_t> out, std::span<std::uint8_t> in, SimTime now);
    /// Sends the packet at hand.
    void packet(SimTime now);
    /// A register of one controller; what it answers.
    std::uint16_t controller(ChipSelect chip, std::uint8_t reg, std::uint16_t value, SimTime now);
    /// The same of both, whatever they answer.
    void controllers(std::uint8_t reg, std::uint16_t value, SimTime now);
    bool both_have_ids(SimTime now);

    Fpga fpga_;
    Counters counters_;
    Packet last_{};  ///< the packet that the pin speaks of
    bool last_open_ = false;
    unsigned bank_ = 0;
    unsigned bad_lines_ = 0;
    bool awake_ = false;
    bool powered_ = false;
};

}  // namespace fauxboard::dlp
