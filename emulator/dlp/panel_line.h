#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fauxboard::dlp {

// The UV panel: two halves side by side, each with a controller of its own and dead pixels at its edge.
constexpr std::uint32_t panel_columns = 1440;
constexpr std::uint32_t panel_lines = 2560;
constexpr std::uint32_t half_columns = panel_columns / 2;
constexpr std::uint32_t dead_columns = 48;  ///< behind each half
constexpr std::size_t line_bytes = 192;     ///< 720 pixels, 48 dead, 720 pixels, 48 dead; highest bit first
constexpr std::size_t bank_bytes = line_bytes * panel_lines;
constexpr std::size_t bank_count = 4;

using PanelLine = std::array<std::uint8_t, line_bytes>;

/// Lights pixels `begin` to `end` (not included) of the line, within one half or across both.
void light(PanelLine& line, std::uint32_t begin, std::uint32_t end);
/// Whether a pixel of a line is lit; dead ones do not count as pixels.
bool lit(std::span<const std::uint8_t> line, std::uint32_t column);
/// Lit pixels of whole lines, dead ones left out.
std::uint32_t count_lit(std::span<const std::uint8_t> lines);

/// A sum over lines in their order, quick to make.
std::uint64_t add_line(std::uint64_t sum, std::span<const std::uint8_t> line);

/// A line on its way to the panel.
constexpr std::size_t packet_bytes = line_bytes + 4;
using Packet = std::array<std::uint8_t, packet_bytes>;
/// Fills in what stands around the 192 bytes at `packet[2]`: bank 0 to 3 and line 0 to 2559, checksum.
void seal(Packet& packet, unsigned bank, unsigned line);
Packet make_packet(const PanelLine& data, unsigned bank, unsigned line);

/// The pixels of a line without the dead ones behind each half, 180 bytes.
inline void take_pixels(std::span<const std::uint8_t> line, std::span<unsigned char> row) {
    constexpr std::size_t half = half_columns / 8;
    std::copy_n(line.begin(), half, row.begin());
    std::copy_n(line.begin() + line_bytes / 2, half, row.begin() + half);
}

}  // namespace fauxboard::dlp
