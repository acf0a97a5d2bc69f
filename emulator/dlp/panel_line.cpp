#include "emulator/dlp/panel_line.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "emulator/dlp/crc16.h"

namespace fauxboard::dlp {
namespace {

constexpr std::uint8_t sdram_bit = 0x40;
constexpr std::size_t half_bytes = line_bytes / 2;
constexpr std::size_t lit_bytes = half_columns / 8;  ///< of a half; dead ones follow

/// Bits `begin` to `end` of a half.
void light_bits(std::uint8_t* half, std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t first = begin / 8;
    const std::uint32_t last = end / 8;
    const auto head = static_cast<std::uint8_t>(0xFF >> begin % 8);
    const auto tail = static_cast<std::uint8_t>(0xFF00 >> end % 8);
    if (first == last) {
        half[first] |= head & tail;
        return;
    }
    half[first] |= head;
    std::memset(half + first + 1, 0xFF, last - first - 1);
    if (tail != 0) {
        half[last] |= tail;
    }
}

}  // namespace

void light(PanelLine& line, std::uint32_t begin, std::uint32_t end) {
    if (begin < half_columns) {
        light_bits(line.data(), begin, std::min(end, half_columns));
    }
    if (end > half_columns) {
        light_bits(line.data() + half_bytes, std::max(begin, half_columns) - half_columns,
                   end - half_columns);
    }
}

bool lit(std::span<const std::uint8_t> line, std::uint32_t column) {
    const bool right = column >= half_columns;
    const std::uint32_t at = right ? column - half_columns : column;
    return (line[(right ? half_bytes : 0) + at / 8] >> (7 - at % 8) & 1) != 0;
}

std::uint32_t count_lit(std::span<const std::uint8_t> lines) {
    int count = 0;
    for (; !lines.empty(); lines = lines.subspan(half_bytes)) {
        std::size_t at = 0;
        for (; at + 8 <= lit_bytes; at += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, &lines[at], sizeof word);
            count += std::popcount(word);
        }
        for (; at < lit_bytes; ++at) {
            count += std::popcount(lines[at]);
        }
    }
    return static_cast<std::uint32_t>(count);
}

std::uint64_t add_line(std::uint64_t sum, std::span<const std::uint8_t> line) {
    constexpr std::uint64_t prime = 0x0000'0100'0000'01B3;
    for (std::size_t at = 0; at + 8 <= line.size(); at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, &line[at], sizeof word);
        sum = (sum ^ word) * prime + (sum >> 29);
    }
    return sum;
}

void seal(Packet& packet, unsigned bank, unsigned line) {
    packet[0] = static_cast<std::uint8_t>(sdram_bit | bank << 4 | line >> 8);
    packet[1] = static_cast<std::uint8_t>(line & 0xFF);
    const std::uint16_t crc = crc16(std::span(packet).first(packet_bytes - 2));
    packet[packet_bytes - 2] = static_cast<std::uint8_t>(crc >> 8);
    packet[packet_bytes - 1] = static_cast<std::uint8_t>(crc & 0xFF);
}

Packet make_packet(const PanelLine& data, unsigned bank, unsigned line) {
    Packet packet{};
    std::copy(data.begin(), data.end(), packet.begin() + 2);
    seal(packet, bank, line);
    return packet;
}

}  // namespace fauxboard::dlp
