#include "emulator/sliced/picture_runs.h"

#include <fmt/format.h>

#include <array>

namespace fauxboard::sliced {
namespace {

std::string cut_off() {
    return "its last run is cut off";
}

/// cbddlp: bit 7 is the pixel, bits 6 to 0 how many.
std::string rle1(ByteWindow& window, Run& run) {
    const auto byte = static_cast<std::uint32_t>(window.next());
    run.value = (byte & 0x80) != 0 ? 255 : 0;
    run.pixels = byte & 0x7F;
    return {};
}

/// photons: bit 0 is the pixel; bits 7 to 1, lowest first, are how many less one.
std::string rle_reversed(ByteWindow& window, Run& run) {
    const auto byte = static_cast<std::uint32_t>(window.next());
    run.value = (byte & 1) != 0 ? 255 : 0;
    run.pixels = 1;
    for (unsigned bit = 0; bit < 7; ++bit) {
        run.pixels += (byte >> (7 - bit) & 1) << bit;
    }
    return {};
}

/// How long the length of a run is in ctb: what its first byte looks like, and how many bytes follow.
struct LengthForm {
    std::uint32_t mask;
    std::uint32_t bits;
    int more;
};
constexpr std::array<LengthForm, 4> length_forms{
    {{0x80, 0x00, 0}, {0xC0, 0x80, 1}, {0xE0, 0xC0, 2}, {0xF0, 0xE0, 3}}};

/// ctb: bits 6 to 0 are the grey; with bit 7, a length of 7, 14, 21 or 28 bits follows, high byte first.
std::string rle7(ByteWindow& window, Run& run) {
    const auto byte = static_cast<std::uint32_t>(window.next());
    const std::uint32_t grey = byte & 0x7F;
    run.value = grey << 1 | grey >> 6;  // 127 is full light
    run.pixels = 1;
    if ((byte & 0x80) == 0) {
        return {};
    }
    const int first = window.next();
    if (first < 0) {
        return cut_off();
    }
    const auto lead = static_cast<std::uint32_t>(first);
    for (const LengthForm& form : length_forms) {
        if ((lead & form.mask) != form.bits) {
            continue;
        }
        run.pixels = lead & ~form.mask;
        for (int i = 0; i < form.more; ++i) {
            const int next = window.next();
            if (next < 0) {
                return cut_off();
            }
            run.pixels = run.pixels << 8 | static_cast<std::uint32_t>(next);
        }
        return {};
    }
    return fmt::format("its run length begins with 0x{:02X}, which has no meaning", lead);
}

int next_u16(ByteWindow& window) {
    const int low = window.next();
    const int high = window.next();
    return low < 0 || high < 0 ? -1 : low | high << 8;
}

/// Previews: five bits of red, five of green, one that says whether copies follow, five of blue.
std::string rle15(ByteWindow& window, Run& run) {
    const int word = next_u16(window);
    if (word < 0) {
        return cut_off();
    }
    const auto eight_bits = [word](int shift) {
        const auto five = static_cast<std::uint32_t>(word >> shift & 0x1F);
        return five << 3 | five >> 2;
    };
    run.value = eight_bits(11) << 16 | eight_bits(6) << 8 | eight_bits(0);
    run.pixels = 1;
    if ((word & 0x20) == 0) {
        return {};
    }
    const int copies = next_u16(window);
    if (copies < 0) {
        return cut_off();
    }
    if (copies >> 12 != 3) {
        return fmt::format("its number of copies is 0x{:04X}; it can be 0x3000 to 0x3FFF", copies);
    }
    run.pixels += static_cast<std::uint32_t>(copies & 0xFFF);
    return {};
}

/// Previews of a word a pixel: five bits of red, six of green, five of blue.
std::string one_word(int word, Run& run) {
    if (word < 0) {
        return cut_off();
    }
    const auto bits = static_cast<std::uint32_t>(word);
    const std::uint32_t red = bits >> 11;
    const std::uint32_t green = bits >> 5 & 0x3F;
    const std::uint32_t blue = bits & 0x1F;
    run.value = (red << 3 | red >> 2) << 16 | (green << 2 | green >> 4) << 8 | (blue << 3 | blue >> 2);
    run.pixels = 1;
    return {};
}
std::string rgb565(ByteWindow& window, Run& run) {
    return one_word(next_u16(window), run);
}
std::string rgb565_big(ByteWindow& window, Run& run) {
    const int word = next_u16(window);
    return one_word(word < 0 ? word : (word & 0xFF) << 8 | word >> 8, run);
}

constexpr std::array<PictureRuns::Codec, 4> layer_codecs{rle1, rle7, rle1, rle_reversed};  // by Format
constexpr std::array<PictureRuns::Codec, 3> preview_codecs{rle15, rgb565, rgb565_big};     // by PreviewCoding

}  // namespace

PictureRuns PictureRuns::of_layer(const SlicedFile& file, const ByteSource& source, std::uint32_t n,
                                  const Layer& layer, std::uint32_t plane) {
    const Header& header = file.header();
    const Cipher cipher = header.format == Format::ctb ? Cipher(header.key, n) : Cipher();
    PictureRuns runs({source, layer.data_offset, layer.data_bytes, cipher},
                     layer_codecs[static_cast<std::size_t>(header.format)], header.pixels());
    if (header.sets_in_one) {
        runs.more_follow_ = true;
        Run passed;
        for (std::uint32_t before = 0; before < plane && runs.problem_.empty(); ++before) {
            while (runs.next(passed)) {
            }
            runs.left_ = header.pixels();
        }
        runs.more_follow_ = plane + 1 < header.level_sets;
    }
    return runs;
}

PictureRuns PictureRuns::of_preview(const Preview& preview, const ByteSource& source) {
    return {{source, preview.data_offset, preview.data_bytes, Cipher()},
            preview_codecs[static_cast<std::size_t>(preview.coding)],
            std::uint64_t{preview.width} * preview.height};
}

bool PictureRuns::fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
}

bool PictureRuns::next(Run& run) {
    while (problem_.empty()) {
        if (left_ == 0) {
            return more_follow_ || window_.at_end()
                       ? false
                       : fail(fmt::format("The picture is whole at byte {} of its data, which goes on.",
                                          window_.taken()));
        }
        const std::uint64_t at = window_.taken();
        if (window_.at_end()) {
            return fail(fmt::format("The picture's data ends at byte {} with {} of {} pixels missing.", at,
                                    left_, pixels_));
        }
        const std::string wrong = codec_(window_, run);
        if (!wrong.empty()) {
            return fail(fmt::format("The picture is wrong at byte {} of its data: {}.", at, wrong));
        }
        if (run.pixels > left_) {
            return fail(fmt::format(
                "The picture overflows at byte {} of its data: a run of {} pixels, where {} of {} "
                "are missing.",
                at, run.pixels, left_, pixels_));
        }
        left_ -= run.pixels;
        if (run.pixels != 0) {
            return true;
        }
    }
    return false;
}

}  // namespace fauxboard::sliced
