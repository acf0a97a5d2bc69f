#include "tests/support/marked_file.h"

#include <bit>

namespace fauxboard::testing {
namespace {

void add(std::string& bytes, std::uint32_t value) {
    bytes.append(4, '\0');
    poke(bytes, bytes.size() - 4, value);
}
void add(std::string& bytes, float value) {
    add(bytes, std::bit_cast<std::uint32_t>(value));
}
void add_mark(std::string& bytes, std::string_view mark) {
    bytes += mark;
    bytes.append(12 - mark.size(), '\0');
}

void add_big(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(value >> shift & 0xFF);
    }
}
void add_big(std::string& bytes, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    add_big(bytes, static_cast<std::uint32_t>(bits >> 32));
    add_big(bytes, static_cast<std::uint32_t>(bits));
}

/// The runs of a plane, no longer than `longest`, written by write(lit, pixels).
template <class Write>
void runs(const ResinFile& wishes, std::uint32_t layer, std::uint32_t plane, std::uint32_t longest,
          Write write) {
    std::uint32_t count = 0;
    bool now = false;
    for (std::uint32_t y = 0; y < wishes.height; ++y) {
        for (std::uint32_t x = 0; x < wishes.width; ++x) {
            const bool lit = lit_in_plane(wishes, layer, plane, x, y);
            if (count != 0 && (lit != now || count == longest)) {
                write(now, count);
                count = 0;
            }
            now = lit;
            ++count;
        }
    }
    write(now, count);
}

constexpr float seconds_per_min = 60;
constexpr std::uint32_t preview_width = 4;
constexpr std::uint32_t preview_height = 3;

void add_info(std::string& bytes, const ResinFile& wishes, bool individual) {
    add_mark(bytes, "HEADER");
    add(bytes, 80U);
    add(bytes, 47.25F), add(bytes, wishes.layer_height_mm), add(bytes, wishes.exposure_s);
    add(bytes, wishes.light_off_s), add(bytes, wishes.bottom_exposure_s);
    add(bytes, static_cast<float>(wishes.bottom_layers)), add(bytes, wishes.lift_mm);
    add(bytes, wishes.lift_mm_min / seconds_per_min), add(bytes, wishes.retract_mm_min / seconds_per_min);
    add(bytes, 12.34F), add(bytes, wishes.level_sets), add(bytes, wishes.width), add(bytes, wishes.height);
    add(bytes, 13.5F), add(bytes, 1.5F), add(bytes, 36U), add(bytes, individual ? 1U : 0U);
    add(bytes, 0U), add(bytes, 0U), add(bytes, 0U);
}

void add_preview(std::string& bytes) {
    add_mark(bytes, "PREVIEW");
    add(bytes, preview_width * preview_height * 2 + 12);
    add(bytes, preview_width), add(bytes, 42U), add(bytes, preview_height);
    for (std::uint32_t i = 0; i < preview_width * preview_height; ++i) {
        bytes += i % 2 == 0 ? std::string("\x00\xF8", 2) : std::string("\x1F\x00", 2);  // red, blue
    }
}

}  // namespace

bool lit_in_plane(const ResinFile& wishes, std::uint32_t layer, std::uint32_t plane, std::uint32_t x,
                  std::uint32_t y) {
    return wishes.picture(layer, x, y) * wishes.level_sets >= 255 * (plane + 1);
}

MadePws make_pws(const ResinFile& wishes, bool individual) {
    MadePws made;
    std::string& bytes = made.bytes;
    add_mark(bytes, "ANYCUBIC");
    add(bytes, 1U), add(bytes, 4U);
    bytes.append(48 - bytes.size(), '\0');
    made.info = 48;
    add_info(bytes, wishes, individual);
    if (wishes.previews) {
        made.preview = static_cast<std::uint32_t>(bytes.size());
        add_preview(bytes);
    }
    made.table = static_cast<std::uint32_t>(bytes.size());
    add_mark(bytes, "LAYERDEF");
    add(bytes, 4 + 32 * wishes.layers), add(bytes, wishes.layers);
    bytes.append(std::size_t{32} * wishes.layers, '\0');
    poke(bytes, 20, made.info), poke(bytes, 28, made.preview), poke(bytes, 36, made.table);
    for (std::uint32_t n = 0; n < wishes.layers; ++n) {
        const std::size_t record = made.table + 20 + std::size_t{32} * n;
        made.data_begins.push_back(static_cast<std::uint32_t>(bytes.size()));
        for (std::uint32_t plane = 0; plane < wishes.level_sets; ++plane) {
            runs(wishes, n, plane, 125, [&](bool lit, std::uint32_t count) {
                bytes += static_cast<char>((lit ? 0x80U : 0U) | count);
            });
        }
        poke(bytes, record, made.data_begins.back());
        poke(bytes, record + 4, static_cast<std::uint32_t>(bytes.size()) - made.data_begins.back());
        poke(bytes, record + 8, wishes.lift_mm + static_cast<float>(n));
        poke(bytes, record + 12, wishes.lift_mm_min / seconds_per_min * 2);
        poke(bytes, record + 16, 10.0F);
        poke(bytes, record + 20, wishes.layer_height_mm);
    }
    return made;
}

MadePhotons make_photons(const ResinFile& wishes) {
    MadePhotons made;
    std::string& bytes = made.bytes;
    add_big(bytes, 2U);
    bytes += '\0';
    bytes += '\x31';
    for (const float value : {0.04725F, wishes.layer_height_mm, wishes.exposure_s, wishes.light_off_s,
                              wishes.bottom_exposure_s}) {
        add_big(bytes, static_cast<double>(value));
    }
    add_big(bytes, wishes.bottom_layers);
    for (const float value : {wishes.lift_mm, wishes.lift_mm_min / seconds_per_min,
                              wishes.retract_mm_min / seconds_per_min, 12.34F}) {
        add_big(bytes, static_cast<double>(value));
    }
    add_big(bytes, preview_width), add_big(bytes, 42U), add_big(bytes, preview_height), add_big(bytes, 10U);
    for (std::uint32_t i = 0; i < preview_width * preview_height; ++i) {
        bytes += std::string("\xF8\x00", 2);
    }
    made.layer_count = static_cast<std::uint32_t>(bytes.size());
    add_big(bytes, wishes.layers);
    for (std::uint32_t n = 0; n < wishes.layers; ++n) {
        std::string data;
        runs(wishes, n, 0, 128, [&](bool lit, std::uint32_t count) {
            std::uint32_t byte = lit ? 1 : 0;
            for (std::uint32_t bit = 0; bit < 7; ++bit) {
                byte |= ((count - 1) >> bit & 1) << (7 - bit);
            }
            data += static_cast<char>(byte);
        });
        made.heads.push_back(static_cast<std::uint32_t>(bytes.size()));
        add_big(bytes, 44'944U), add_big(bytes, 0U), add_big(bytes, 0U);
        add_big(bytes, wishes.width), add_big(bytes, wishes.height);
        add_big(bytes, static_cast<std::uint32_t>((data.size() + 4) * 8)), add_big(bytes, 2'684'702'720U);
        bytes += data;
    }
    return made;
}

}  // namespace fauxboard::testing
