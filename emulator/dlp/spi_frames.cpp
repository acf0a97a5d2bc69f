#include "emulator/dlp/spi_frames.h"

#include <algorithm>
#include <array>
#include <span>

#include "emulator/dlp/crc16.h"
#include "emulator/dlp/fpga.h"

namespace fauxboard::dlp {
namespace {

constexpr std::size_t command_bytes = 3;
constexpr std::uint8_t sdram_mark = 0x40;
constexpr std::uint8_t read_mark = 0x80;

std::uint8_t byte_at(std::string_view bytes, std::size_t at) {
    return static_cast<std::uint8_t>(bytes[at]);
}

/// `size` bytes, the highest first.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
        number = number << 8 | byte_at(bytes, at + i);
    }
    return number;
}

void put(std::string& out, std::uint64_t number, std::size_t size) {
    for (std::size_t i = size; i-- > 0;) {
        out += static_cast<char>(number >> 8 * i & 0xFF);
    }
}

bool is_kind(std::uint8_t byte) {
    constexpr std::string_view kinds = "OIPR";
    return kinds.find(static_cast<char>(byte)) != std::string_view::npos;
}

/// Whether a head stands here, as far as there are bytes.
bool fits_head(std::string_view bytes) {
    const auto may = [&](std::size_t at, auto fits) {
        return at >= bytes.size() || fits(byte_at(bytes, at));
    };
    return may(0, [](unsigned byte) { return byte == spi_mark; }) && may(1, is_kind) &&
           may(2, [](unsigned byte) { return byte <= 2; }) &&
           may(3, [](unsigned byte) { return byte <= 1; }) &&
           (bytes.size() < 6 || number_at(bytes, 4, 2) <= spi_most_data);
}

std::string hex(std::uint64_t number, std::size_t digits) {
    std::string text(digits, '0');
    for (std::size_t i = digits; i-- > 0; number >>= 4) {
        text[i] = "0123456789ABCDEF"[number & 0xF];
    }
    return text;
}

std::string command_words(std::uint8_t byte) {
    return "bank " + std::to_string(bank_of(byte)) + ", scan " + ((byte & scan_bit) != 0 ? "on" : "off") +
           ", SDRAM " + ((byte & read_bit) != 0 ? "on" : "off");
}

SpiWords line_words(std::string_view data) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(data.data());
    const std::span packet(bytes, packet_bytes);
    const auto line = (packet[0] & 0x0FU) << 8 | packet[1];
    const auto given = static_cast<std::uint16_t>(number_at(data, packet_bytes - 2, 2));
    const std::uint16_t right = crc16(packet.first<packet_bytes - 2>());
    const bool wrong = given != right || line >= panel_lines;
    return {"line",
            "bank " + std::to_string(bank_of(packet[0])) + ", line " + std::to_string(line) + ": " +
                std::to_string(count_lit(packet.subspan<2, line_bytes>())) + " lit, checksum " +
                hex(given, 4) + (given == right ? " good" : " wrong, " + hex(right, 4) + " would be right") +
                (line < panel_lines ? "" : "; there is no such line"),
            wrong};
}

SpiWords fpga_words(std::string_view data) {
    if (data.size() == packet_bytes && (byte_at(data, 0) & (read_mark | sdram_mark)) == sdram_mark) {
        return line_words(data);
    }
    if (data.size() == command_bytes && byte_at(data, 0) == 0) {
        return {"command", hex(byte_at(data, 2), 2) + ": " + command_words(byte_at(data, 2)), false};
    }
    if (data.size() == command_bytes && byte_at(data, 0) == read_mark) {
        return {"read back", "which command?", false};
    }
    return {"unknown", std::to_string(data.size()) + " bytes that mean nothing", true};
}

SpiWords controller_words(std::string_view data) {
    struct Register {
        std::uint8_t number;
        std::string_view words;
    };
    constexpr std::array<Register, 6> registers{{{0x10, "sleep in"},
                                                 {0x11, "sleep out"},
                                                 {0x28, "display off"},
                                                 {0x29, "display on"},
                                                 {id_register, "read the id"},
                                                 {0xB7, "configuration"}}};
    if (data.size() < command_bytes) {
        return {"unknown", std::to_string(data.size()) + " bytes that mean nothing", true};
    }
    const std::uint8_t number = byte_at(data, 0);
    const auto* const known = std::find_if(registers.begin(), registers.end(),
                                           [number](const Register& each) { return each.number == number; });
    const std::string value = hex(byte_at(data, 2) * 256U + byte_at(data, 1), 4);
    return {
        "register",
        hex(number, 2) + " = " + value + (known == registers.end() ? "" : ": " + std::string(known->words)),
        known == registers.end()};
}

SpiWords answer_words(const SpiRecord& record) {
    if (record.chip != ChipSelect::fpga) {
        return {"register",
                "id " + (record.data.size() < 4
                             ? "?"
                             : hex(byte_at(record.data, 3) * 256U + byte_at(record.data, 2), 4)),
                false};
    }
    if (record.data.size() != command_bytes) {
        return {"unknown", std::to_string(record.data.size()) + " bytes that mean nothing", true};
    }
    const std::uint8_t byte = byte_at(record.data, 2);
    return {"read back",
            hex(byte, 2) + ": " + command_words(byte) + ", version " + std::to_string(byte & 0xF), false};
}

}  // namespace

std::string spi_bytes(const SpiRecord& record) {
    std::string out;
    out.reserve(spi_head_bytes + record.data.size());
    put(out, spi_mark, 1);
    out += static_cast<char>(record.kind);
    put(out, static_cast<std::uint64_t>(record.chip), 1);
    put(out, record.level ? 1 : 0, 1);
    put(out, record.data.size(), 2);
    put(out, record.number, 4);
    put(out, static_cast<std::uint64_t>(record.at.count()), 6);
    out += record.data;
    return out;
}

bool looks_like_spi(std::string_view begin) {
    return begin.size() >= spi_head_bytes && fits_head(begin);
}

std::optional<SpiRecord> SpiSplitter::next() {
    std::size_t at = 0;
    while (at < buffer_.size() && !fits_head(std::string_view(buffer_).substr(at))) {
        ++at;
    }
    skipped_ += at;
    buffer_.erase(0, at);
    if (buffer_.size() < spi_head_bytes) {
        return std::nullopt;
    }
    const auto size = static_cast<std::size_t>(number_at(buffer_, 4, 2));
    if (buffer_.size() < spi_head_bytes + size) {
        return std::nullopt;
    }
    SpiRecord record{static_cast<SpiKind>(buffer_[1]),
                     static_cast<ChipSelect>(buffer_[2]),
                     buffer_[3] != 0,
                     static_cast<std::uint32_t>(number_at(buffer_, 6, 4)),
                     SimTime{static_cast<std::int64_t>(number_at(buffer_, 10, 6))},
                     buffer_.substr(spi_head_bytes, size)};
    buffer_.erase(0, spi_head_bytes + size);
    return record;
}

SpiWords words_of(const SpiRecord& record) {
    switch (record.kind) {
        case SpiKind::pin:
            return {"pin", record.level ? "checksum good" : "checksum bad", !record.level};
        case SpiKind::reset:
            return {"reset", record.level ? "released" : "pulled low", false};
        case SpiKind::in:
            return answer_words(record);
        default:
            break;
    }
    return record.chip == ChipSelect::fpga ? fpga_words(record.data) : controller_words(record.data);
}

}  // namespace fauxboard::dlp
