#include "tests/support/resin_file.h"

#include <algorithm>
#include <bit>

namespace fauxboard::testing {
namespace {

/// The bytes so far; places are filled in as they become known.
class Bytes {
  public:
    std::uint32_t size() const { return static_cast<std::uint32_t>(bytes_.size()); }
    std::uint32_t room(std::size_t bytes) {
        const std::uint32_t at = size();
        bytes_.resize(bytes_.size() + bytes);
        return at;
    }
    void u8(std::uint32_t value) { bytes_.push_back(static_cast<char>(value & 0xFF)); }
    void u16(std::uint32_t value) { u8(value), u8(value >> 8); }
    void add(std::string_view text) { bytes_ += text; }
    void put(std::size_t at, std::uint32_t value) { poke(bytes_, at, value); }
    void put(std::size_t at, float value) { poke(bytes_, at, value); }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/// Calls out(value, length) for each run of equal values, none longer than `longest`.
template <class Value, class Out>
void runs(std::uint64_t pixels, std::uint32_t longest, Value&& value, Out&& out) {
    std::uint64_t begin = 0;
    while (begin < pixels) {
        const auto first = value(begin);
        std::uint64_t end = begin + 1;
        while (end < pixels && end - begin < longest && value(end) == first) {
            ++end;
        }
        out(first, static_cast<std::uint32_t>(end - begin));
        begin = end;
    }
}

void rle7_run(Bytes& out, std::uint32_t grey, std::uint32_t length) {
    if (length == 1) {
        out.u8(grey);
        return;
    }
    out.u8(grey | 0x80);
    if (length < 1U << 7) {
        out.u8(length);
    } else if (length < 1U << 14) {
        out.u8(0x80 | length >> 8), out.u8(length);
    } else if (length < 1U << 21) {
        out.u8(0xC0 | length >> 16), out.u8(length >> 8), out.u8(length);
    } else {
        out.u8(0xE0 | length >> 24), out.u8(length >> 16), out.u8(length >> 8), out.u8(length);
    }
}

void encipher(std::string& data, std::uint32_t key, std::uint32_t layer) {
    const std::uint32_t step = key * 0x2D83CDACU + 0xD8A83423U;
    std::uint32_t word = (layer * 0x1E1530CDU + 0xEC3D47CDU) * step;
    for (std::size_t i = 0; key != 0 && i < data.size(); ++i) {
        data[i] = static_cast<char>(static_cast<unsigned char>(data[i]) ^ ((word >> (i % 4 * 8)) & 0xFFU));
        if (i % 4 == 3) word += step;
    }
}

std::string encode(const ResinFile& wishes, std::uint32_t layer, std::uint32_t plane) {
    const std::uint64_t pixels = std::uint64_t{wishes.width} * wishes.height;
    const auto grey = [&](std::uint64_t i) {
        return std::uint32_t{wishes.picture(layer, static_cast<std::uint32_t>(i % wishes.width),
                                            static_cast<std::uint32_t>(i / wishes.width))};
    };
    Bytes out;
    if (wishes.kind == ResinFile::Kind::ctb) {
        runs(
            pixels, (1U << 28) - 1, [&](std::uint64_t i) { return grey(i) >> 1; },
            [&](std::uint32_t value, std::uint32_t length) { rle7_run(out, value, length); });
    } else {
        runs(
            pixels, 125, [&](std::uint64_t i) { return grey(i) * wishes.level_sets >= (plane + 1) * 255; },
            [&](bool lit, std::uint32_t length) { out.u8((lit ? 0x80U : 0U) | length); });
    }
    std::string data = out.take();
    encipher(data, wishes.kind == ResinFile::Kind::ctb ? wishes.key : 0, layer);
    return data;
}

/// Stripes: long runs, and single pixels of many colours in the first row.
void preview(Bytes& out, std::uint32_t record, std::uint32_t width, std::uint32_t height) {
    const auto colour = [&](std::uint64_t i) {
        const auto x = static_cast<std::uint32_t>(i % width);
        const auto y = static_cast<std::uint32_t>(i / width);
        return y == 0 ? x & 0x1FU : (y / 8 % 32) << 11 | (y % 4) << 6;
    };
    out.put(record, width);
    out.put(record + 4, height);
    out.put(record + 8, out.size());
    const std::uint32_t begin = out.size();
    runs(std::uint64_t{width} * height, 0x1000, colour, [&](std::uint32_t value, std::uint32_t length) {
        out.u16(value | (length > 1 ? 0x20U : 0U));
        if (length > 1) out.u16(0x3000 | (length - 1));
    });
    out.put(record + 12, out.size() - begin);
}

void header(Bytes& out, const ResinFile& wishes) {
    out.room(0x70);
    out.put(0x00, wishes.kind == ResinFile::Kind::ctb ? 0x12FD0086U : 0x12FD0019U);
    out.put(0x04, wishes.version);
    out.put(0x08, 68.04F);
    out.put(0x0C, 120.96F);
    out.put(0x10, 150.0F);
    out.put(0x1C, wishes.layer_height_mm * static_cast<float>(wishes.layers));
    out.put(0x20, wishes.layer_height_mm);
    out.put(0x24, wishes.exposure_s);
    out.put(0x28, wishes.bottom_exposure_s);
    out.put(0x2C, wishes.light_off_s);
    out.put(0x30, wishes.bottom_layers);
    out.put(0x34, wishes.width);
    out.put(0x38, wishes.height);
    out.put(0x44, wishes.layers);
    out.put(0x4C, 3600U);
    out.put(0x50, 1U);
    out.put(0x5C, wishes.level_sets);
    out.put(0x60, 0x00FF00FFU);
    out.put(0x64, wishes.key);
}

std::uint32_t first_extension(Bytes& out, const ResinFile& wishes) {
    const std::uint32_t at = out.room(60);
    out.put(0x54, at);
    out.put(0x58, 60U);
    const float values[] = {wishes.lift_mm + 2,
                            wishes.lift_mm_min - 30,
                            wishes.lift_mm,
                            wishes.lift_mm_min,
                            wishes.retract_mm_min,
                            12.5F,
                            13.75F,
                            0.5F,
                            2.0F,
                            wishes.light_off_s};
    for (std::size_t i = 0; i < std::size(values); ++i) {
        out.put(at + 4 * i, values[i]);
    }
    out.put(at + 0x28, wishes.bottom_layers);
    return at;
}

std::uint32_t second_extension(Bytes& out, const ResinFile& wishes) {
    const std::uint32_t at = out.room(76);
    out.put(0x68, at);
    out.put(0x6C, 76U);
    out.put(at + 0x1C, out.size());
    out.put(at + 0x20, static_cast<std::uint32_t>(wishes.machine.size()));
    out.put(at + 0x24, wishes.kind == ResinFile::Kind::ctb ? 0xFU : 0U);
    out.put(at + 0x2C, wishes.level_sets);
    out.put(at + 0x30, 0x01060501U);
    out.put(at + 0x34, 0x200U);
    out.add(wishes.machine);
    return at;
}

void record(Bytes& out, const ResinFile& wishes, std::uint32_t at, std::uint32_t n) {
    const bool bottom = n < wishes.bottom_layers;
    out.put(at, wishes.layer_height_mm * static_cast<float>(n + 1));
    out.put(at + 4, bottom ? wishes.bottom_exposure_s : wishes.exposure_s);
    out.put(at + 8, wishes.light_off_s);
    out.put(at + 0x18, wishes.version >= 3 ? 84U : 0U);
}

void layer(Bytes& out, const ResinFile& wishes, std::uint32_t at, std::uint32_t n, std::uint32_t plane) {
    const std::string data = encode(wishes, n, plane);
    const auto length = static_cast<std::uint32_t>(data.size());
    record(out, wishes, at, n);
    if (wishes.version >= 3) {
        const std::uint32_t block = out.room(84);
        record(out, wishes, block, n);
        out.put(block + 0x0C, block + 84);
        out.put(block + 0x10, length);
        out.put(block + 0x24, length + 84);
        out.put(block + 0x28, wishes.lift_mm + static_cast<float>(n));
        out.put(block + 0x2C, wishes.lift_mm_min);
        out.put(block + 0x38, wishes.retract_mm_min);
        out.put(block + 0x50, 255.0F);
    }
    out.put(at + 0x0C, out.size());
    out.put(at + 0x10, length);
    out.add(data);
}

}  // namespace

std::uint8_t ResinFile::box(std::uint32_t layer, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t left = 2 + layer % 3;
    if (x < left || y < 1 || y > 5) {
        return 0;
    }
    return x < left + 3 ? static_cast<std::uint8_t>(85 * (x - left)) : 255;
}

MadeResinFile make_resin_file(const ResinFile& wishes) {
    Bytes out;
    MadeResinFile made;
    header(out, wishes);
    if (wishes.first_extension) made.ext1 = first_extension(out, wishes);
    if (wishes.second_extension) made.ext2 = second_extension(out, wishes);
    if (wishes.previews) {
        made.large_preview = out.room(32);
        out.put(0x3C, made.large_preview);
        preview(out, made.large_preview, 40, 30);
        made.small_preview = out.room(32);
        out.put(0x48, made.small_preview);
        preview(out, made.small_preview, 20, 13);
    }
    made.layer_table = out.room(std::size_t{36} * wishes.layers * wishes.level_sets);
    out.put(0x40, made.layer_table);
    for (std::uint32_t plane = 0; plane < wishes.level_sets; ++plane) {
        for (std::uint32_t n = 0; n < wishes.layers; ++n) {
            const std::uint32_t at = made.layer_table + 36 * (n + plane * wishes.layers);
            const std::uint32_t before = out.size();
            layer(out, wishes, at, n, plane);
            if (plane == 0) {
                made.data_begins.push_back(before + (wishes.version >= 3 ? 84 : 0));
                made.layer_ends.push_back(out.size());
            }
        }
    }
    made.bytes = out.take();
    return made;
}

void poke(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) {
        bytes.at(at + i) = static_cast<char>(value >> (8 * i) & 0xFF);
    }
}

void poke(std::string& bytes, std::size_t at, float value) {
    poke(bytes, at, std::bit_cast<std::uint32_t>(value));
}

std::uint32_t peek(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) {
        value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    }
    return value;
}

std::size_t MemorySource::read(std::uint64_t offset, std::span<char> out) const {
    ++reads;
    biggest_read = std::max(biggest_read, out.size());
    if (offset >= bytes_.size()) {
        return 0;
    }
    const std::size_t count = bytes_.copy(out.data(), out.size(), static_cast<std::size_t>(offset));
    bytes_read += count;
    return count;
}

}  // namespace fauxboard::testing
