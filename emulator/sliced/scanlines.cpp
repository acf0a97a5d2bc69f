#include "emulator/sliced/scanlines.h"

#include <algorithm>

namespace fauxboard::sliced {

Outcome<Scanlines> Scanlines::of_layer(const SlicedFile& file, const ByteSource& source, std::uint32_t n) {
    Scanlines lines(file.header().width, file.header().height);
    for (std::uint32_t plane = 0; plane < file.header().level_sets; ++plane) {
        const Outcome<Layer> layer = file.layer(source, n, plane);
        if (!layer) {
            return Outcome<Scanlines>::failure(layer.problem());
        }
        lines.planes_.push_back({PictureRuns::of_layer(file, source, n, *layer, plane)});
    }
    return lines;
}

Scanlines Scanlines::of_preview(const Preview& preview, const ByteSource& source) {
    Scanlines lines(preview.width, preview.height);
    lines.planes_.push_back({PictureRuns::of_preview(preview, source)});
    return lines;
}

bool Scanlines::add(Plane& plane, std::span<std::uint32_t> line) {
    while (!line.empty()) {
        if (plane.run.pixels == 0 && !plane.runs.next(plane.run)) {
            return false;
        }
        const std::size_t count = std::min<std::size_t>(plane.run.pixels, line.size());
        for (std::uint32_t& pixel : line.first(count)) {
            pixel += plane.run.value;
        }
        plane.run.pixels -= static_cast<std::uint32_t>(count);
        line = line.subspan(count);
    }
    return true;
}

bool Scanlines::next(std::span<std::uint32_t> line) {
    if (!problem_.empty()) {
        return false;
    }
    const bool after_last = lines_ == height_;
    line = after_last ? line.first(0) : line.first(width_);
    std::fill(line.begin(), line.end(), 0);
    for (Plane& plane : planes_) {
        Run none;
        if (after_last ? !plane.runs.next(none) && !plane.runs.problem().empty() : !add(plane, line)) {
            problem_ = plane.runs.problem();
            return false;
        }
    }
    if (after_last) {
        return false;
    }
    ++lines_;
    if (planes_.size() > 1) {
        for (std::uint32_t& pixel : line) {
            pixel /= static_cast<std::uint32_t>(planes_.size());
        }
    }
    return true;
}

}  // namespace fauxboard::sliced
