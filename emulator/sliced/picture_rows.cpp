#include "emulator/sliced/picture_rows.h"

#include <algorithm>

namespace fauxboard::sliced {

Outcome<PictureRows> PictureRows::of_layer(const SlicedFile& file, const ByteSource& source,
                                           std::uint32_t n) {
    PictureRows rows(file.header().width, file.header().height);
    for (std::uint32_t plane = 0; plane < file.header().level_sets; ++plane) {
        const Outcome<Layer> layer = file.layer(source, n, plane);
        if (!layer) {
            return Outcome<PictureRows>::failure(layer.problem());
        }
        rows.planes_.push_back({PictureRuns::of_layer(file, source, n, *layer, plane)});
    }
    return rows;
}

PictureRows PictureRows::of_preview(const Preview& preview, const ByteSource& source) {
    PictureRows rows(preview.width, preview.height);
    rows.planes_.push_back({PictureRuns::of_preview(preview, source)});
    return rows;
}

bool PictureRows::add(Plane& plane, std::span<std::uint32_t> row) {
    while (!row.empty()) {
        if (plane.run.pixels == 0 && !plane.runs.next(plane.run)) {
            return false;
        }
        const std::size_t count = std::min<std::size_t>(plane.run.pixels, row.size());
        for (std::uint32_t& pixel : row.first(count)) {
            pixel += plane.run.value;
        }
        plane.run.pixels -= static_cast<std::uint32_t>(count);
        row = row.subspan(count);
    }
    return true;
}

bool PictureRows::next(std::span<std::uint32_t> row) {
    if (!problem_.empty()) {
        return false;
    }
    const bool after_last = rows_ == height_;
    row = after_last ? row.first(0) : row.first(width_);
    std::fill(row.begin(), row.end(), 0);
    for (Plane& plane : planes_) {
        Run none;
        if (after_last ? !plane.runs.next(none) && !plane.runs.problem().empty() : !add(plane, row)) {
            problem_ = plane.runs.problem();
            return false;
        }
    }
    if (after_last) {
        return false;
    }
    ++rows_;
    if (planes_.size() > 1) {
        for (std::uint32_t& pixel : row) {
            pixel /= static_cast<std::uint32_t>(planes_.size());
        }
    }
    return true;
}

}  // namespace fauxboard::sliced
