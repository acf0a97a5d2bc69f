#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace fauxboard::tools {

/// What a PNG is to show, row after row.
struct PngPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool colour = false;  ///< three bytes a pixel (red, green, blue), else one of grey
    bool bits = false;    ///< eight pixels a byte, the highest bit first: dark or light
    /// Fills the next row; false ends the picture there.
    std::function<bool(std::span<unsigned char> row)> next_row;
};

/// Writes the picture; true when it is whole. False when next_row() gave up: then there is no file.
/// Throws link::HostError when the file cannot be written.
bool write_png(const std::string& path, const PngPicture& picture);

}  // namespace fauxboard::tools
