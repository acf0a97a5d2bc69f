#include "emulator/sliced/fields.h"

#include <fmt/format.h>

namespace fauxboard::sliced {

std::string check_within(const Region& region, std::uint64_t file_bytes) {
    if (region.end() <= file_bytes) {
        return {};
    }
    return fmt::format("The {} would take bytes {} to {} of the file, which has only {}.", region.what,
                       region.offset, region.end(), file_bytes);
}

std::string check_apart(const Region& region, const Region& other) {
    if (!region.touches(other)) {
        return {};
    }
    return fmt::format("The {} (bytes {} to {}) lies over the {} (bytes {} to {}).", region.what,
                       region.offset, region.end(), other.what, other.offset, other.end());
}

std::string read_whole(const ByteSource& source, const Region& region, std::span<char> out) {
    const std::size_t got = source.read(region.offset, out);
    if (got == out.size()) {
        return {};
    }
    return fmt::format("The {} at byte {} cannot be read: {} of its {} bytes came.", region.what,
                       region.offset, got, out.size());
}

std::string wrong_number(std::string_view name, std::uint64_t at, std::uint64_t value, std::uint64_t lowest,
                         std::uint64_t highest) {
    const std::string range =
        lowest == highest ? fmt::format("only {}", lowest) : fmt::format("{} to {}", lowest, highest);
    return fmt::format("The {} (at 0x{:X}) is {}; it can be {}.", name, at, value, range);
}

std::string wrong_measure(std::string_view name, std::uint64_t at, float value, float lowest, float highest) {
    return fmt::format("The {} (at 0x{:X}) is {:g}; it can be {:g} to {:g}.", name, at, value, lowest,
                       highest);
}

}  // namespace fauxboard::sliced
