#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "emulator/sliced/byte_source.h"

namespace fauxboard::sliced {

/// Little endian, as everything in these files.
constexpr std::uint16_t load_u16(std::span<const char> bytes, std::size_t at) {
    return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[at]) |
                                      static_cast<unsigned char>(bytes[at + 1]) << 8);
}
constexpr std::uint32_t load_u32(std::span<const char> bytes, std::size_t at) {
    return load_u16(bytes, at) | std::uint32_t{load_u16(bytes, at + 2)} << 16;
}
constexpr float load_f32(std::span<const char> bytes, std::size_t at) {
    return std::bit_cast<float>(load_u32(bytes, at));
}

/// A stretch of the file that belongs to one thing.
struct Region {
    std::string_view what;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;

    std::uint64_t end() const { return offset + bytes; }
    bool touches(const Region& other) const {
        return bytes != 0 && other.bytes != 0 && offset < other.end() && other.offset < end();
    }
};

/// "the layer table at 0x40 would take bytes 112 to 5000, but the file ends at 4000"; empty when it fits.
std::string check_within(const Region& region, std::uint64_t file_bytes);
/// Empty when the two have no byte in common.
std::string check_apart(const Region& region, const Region& other);
/// Fills `out` from `region.offset` on. The problem, when the file gives less.
std::string read_whole(const ByteSource& source, const Region& region, std::span<char> out);

/// A whole number of a record: where it stands and what it may be.
template <class Record>
struct U32Field {
    std::size_t offset;
    std::string_view name;
    std::uint32_t Record::*member;
    std::uint32_t lowest = 0;
    std::uint32_t highest = 0xFFFF'FFFF;
};

/// A measure of a record; never NaN or infinite.
template <class Record>
struct F32Field {
    std::size_t offset;
    std::string_view name;
    float Record::*member;
    float lowest = 0;
    float highest = 0;
};

std::string wrong_number(std::string_view name, std::uint64_t at, std::uint64_t value, std::uint64_t lowest,
                         std::uint64_t highest);
std::string wrong_measure(std::string_view name, std::uint64_t at, float value, float lowest, float highest);

/// Takes the fields out of a record that begins at `base` of the file. The first problem, or empty.
template <class Record, std::size_t N>
std::string take(const U32Field<Record> (&fields)[N], std::span<const char> bytes, std::uint64_t base,
                 Record& record) {
    for (const auto& field : fields) {
        const std::uint32_t value = load_u32(bytes, field.offset);
        if (value < field.lowest || value > field.highest) {
            return wrong_number(field.name, base + field.offset, value, field.lowest, field.highest);
        }
        record.*field.member = value;
    }
    return {};
}
template <class Record, std::size_t N>
std::string take(const F32Field<Record> (&fields)[N], std::span<const char> bytes, std::uint64_t base,
                 Record& record) {
    for (const auto& field : fields) {
        const float value = load_f32(bytes, field.offset);
        if (!(value >= field.lowest && value <= field.highest)) {  // so NaN is wrong too
            return wrong_measure(field.name, base + field.offset, value, field.lowest, field.highest);
        }
        record.*field.member = value;
    }
    return {};
}

// What no machine of this kind goes beyond.
constexpr float max_mm = 10'000;
constexpr float max_seconds = 86'400;
constexpr float max_mm_min = 100'000;

}  // namespace fauxboard::sliced
