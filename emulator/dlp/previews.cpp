#include "emulator/dlp/previews.h"

#include "emulator/sliced/scanlines.h"

namespace fauxboard::dlp {

void Previews::read(const sliced::ByteSource& source) const {
    const auto file = sliced::SlicedFile::open(source);
    if (!file) {
        return;
    }
    const auto& preview =
        file->header().large_preview ? file->header().large_preview : file->header().small_preview;
    if (!preview || std::uint64_t{preview->width} * preview->height > most_pixels) {
        return;
    }
    sliced::Scanlines rows = sliced::Scanlines::of_preview(*preview, source);
    std::vector<std::uint32_t> row(preview->width);
    while (rows.next(row)) {
        pixels_.rgb.insert(pixels_.rgb.end(), row.begin(), row.end());
    }
    pixels_.width = preview->width;
    pixels_.height = static_cast<std::uint32_t>(pixels_.rgb.size() / preview->width);
}

const Previews::Pixels* Previews::pixels(const Stick& stick, const std::string& path) const {
    if (path != path_) {
        path_ = path;
        pixels_ = {};
        if (const auto source = stick.open(path)) {
            read(*source);
        }
    }
    return pixels_.rgb.empty() ? nullptr : &pixels_;
}

}  // namespace fauxboard::dlp
