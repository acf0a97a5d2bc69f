#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/dlp/spi_tap.h"

namespace fauxboard::dlp {

// What passes on the wires to the UV panel as bytes: records one behind the other, in files and on lines;
// those of whoever answers have the same form. A head of 16 bytes, numbers highest byte first, then the data:
//
//     0      A5
//     1      'O' the board sends, 'I' it receives, 'P' checksum pin, 'R' reset line of the FPGA
//     2      whose chip select is low: 0 FPGA, 1 left controller, 2 right controller
//     3      level of a pin or line, 0 or 1; else 0
//     4-5    bytes of data
//     6-9    number of the transfer, from 1; what belongs to a transfer has its number
//     10-15  microseconds since power-on

enum class SpiKind : char { out = 'O', in = 'I', pin = 'P', reset = 'R' };

constexpr unsigned char spi_mark = 0xA5;
constexpr std::size_t spi_head_bytes = 16;
/// No transfer of the board is longer; a record that says so is none.
constexpr std::size_t spi_most_data = 1024;

struct SpiRecord {
    SpiKind kind = SpiKind::out;
    ChipSelect chip = ChipSelect::fpga;
    bool level = false;
    std::uint32_t number = 0;
    SimTime at{0};
    std::string data;
};

/// `record.data` of at most spi_most_data bytes.
std::string spi_bytes(const SpiRecord& record);

/// Whether bytes that begin so are records, as far as they go.
bool looks_like_spi(std::string_view begin);

/// Cuts records out of bytes as they come. What is none is left out, byte by byte, until one begins.
class SpiSplitter {
  public:
    /// Take what next() gives before more comes: what waits is kept.
    void feed(std::string_view bytes) { buffer_ += bytes; }
    std::optional<SpiRecord> next();
    std::uint64_t skipped() const { return skipped_; }
    /// Bytes of a record whose rest has not come.
    std::size_t waiting() const { return buffer_.size(); }

  private:
    std::string buffer_;
    std::uint64_t skipped_ = 0;
};

/// What a record means.
struct SpiWords {
    std::string what;    ///< "line", "command", "read back", "register", "pin", "reset", "unknown"
    std::string words;   ///< for a person: "bank 0, line 1280: 1000 lit, checksum good"
    bool wrong = false;  ///< its checksum is, or it means nothing
};
SpiWords words_of(const SpiRecord& record);

}  // namespace fauxboard::dlp
