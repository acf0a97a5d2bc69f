#include "emulator/sliced/sample.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace fauxboard::sliced {
namespace {

constexpr std::uint32_t magic = 0x12FD'0019;
constexpr std::uint32_t header_bytes = 0x70;
constexpr std::uint32_t extension_bytes = 60;
constexpr std::uint32_t record_bytes = 36;
constexpr std::uint32_t smallest_side = 16;
constexpr std::uint32_t biggest_side = 4096;
constexpr std::uint32_t margin = 4;         ///< dark rows and columns around the bar
constexpr std::uint32_t longest_run = 125;  ///< as slicers write it
constexpr std::uint32_t full_light = 255;

void put(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) {
        bytes[at + i] = static_cast<char>(value >> (8 * i) & 0xFF);
    }
}
void put(std::string& bytes, std::size_t at, float value) {
    put(bytes, at, std::bit_cast<std::uint32_t>(value));
}

void put_runs(std::string& out, bool lit, std::uint32_t pixels) {
    for (; pixels > 0; pixels -= std::min(pixels, longest_run)) {
        out += static_cast<char>((lit ? 0x80U : 0U) | std::min(pixels, longest_run));
    }
}

/// Runs of a byte each: bit 7 the pixel, the others how many. Dark to the bar's first row, and between its
/// rows.
std::string picture(std::uint32_t width, std::uint32_t height) {
    std::string out;
    std::uint32_t dark = width * margin + margin;
    for (std::uint32_t row = 2 * margin; row < height; ++row) {
        put_runs(out, false, dark);
        put_runs(out, true, width - 2 * margin);
        dark = 2 * margin;
    }
    put_runs(out, false, width * margin + margin);
    return out;
}

void put_header(std::string& file, const Sample& wishes, std::uint32_t layers, std::uint32_t table) {
    put(file, 0x00, magic);
    put(file, 0x04, 2U);
    put(file, 0x08, 68.04F), put(file, 0x0C, 120.96F), put(file, 0x10, 150.0F);
    put(file, 0x1C, wishes.layer_height_mm * static_cast<float>(layers));
    put(file, 0x20, wishes.layer_height_mm);
    put(file, 0x24, wishes.exposure_s), put(file, 0x28, wishes.exposure_s), put(file, 0x2C, 1.0F);
    put(file, 0x34, wishes.width), put(file, 0x38, wishes.height);
    put(file, 0x40, table), put(file, 0x44, layers);
    put(file, 0x50, 1U);
    put(file, 0x54, header_bytes), put(file, 0x58, extension_bytes);
    put(file, 0x5C, 1U);
    put(file, 0x60, full_light | full_light << 16U);
    const std::size_t lifts = header_bytes;
    put(file, lifts + 0x00, wishes.lift_mm), put(file, lifts + 0x04, wishes.lift_mm_min);
    put(file, lifts + 0x08, wishes.lift_mm), put(file, lifts + 0x0C, wishes.lift_mm_min);
    put(file, lifts + 0x10, wishes.lift_mm_min);
    put(file, lifts + 0x20, 1.0F), put(file, lifts + 0x24, 1.0F);
}

}  // namespace

std::string make_sample(const Sample& asked) {
    Sample wishes = asked;
    wishes.width = std::clamp(asked.width, smallest_side, biggest_side);
    wishes.height = std::clamp(asked.height, smallest_side, biggest_side);
    const std::uint32_t layers = std::clamp(wishes.layers, 1U, Sample::most_layers);
    constexpr std::uint32_t table = header_bytes + extension_bytes;
    const std::string light = picture(wishes.width, wishes.height);
    const auto light_bytes = static_cast<std::uint32_t>(light.size());
    const std::uint32_t pictures = table + layers * record_bytes;
    std::string file(pictures, '\0');
    put_header(file, wishes, layers, table);
    for (std::uint32_t n = 0; n < layers; ++n) {
        const std::size_t record = table + n * record_bytes;
        put(file, record, wishes.layer_height_mm * static_cast<float>(n + 1));
        put(file, record + 0x04, wishes.exposure_s);
        put(file, record + 0x08, 1.0F);
        put(file, record + 0x0C, pictures + n * light_bytes);
        put(file, record + 0x10, light_bytes);
        file += light;
    }
    return file;
}

}  // namespace fauxboard::sliced
