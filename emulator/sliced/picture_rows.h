#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emulator/sliced/picture_runs.h"

namespace fauxboard::sliced {

/// A picture row by row. The several pictures of an anti-aliased layer become one: the grey of a pixel is how
/// many of them have it lit.
class PictureRows {
  public:
    /// All pictures of layer `n`, or the problem.
    static Outcome<PictureRows> of_layer(const SlicedFile& file, const ByteSource& source, std::uint32_t n);
    static PictureRows of_preview(const Preview& preview, const ByteSource& source);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }

    /// The next row into `row`, which holds width() values (grey, or 0xRRGGBB of a preview). False after the
    /// last, and when the picture is wrong: then problem() tells. After the last row ask once more to know
    /// that nothing followed.
    bool next(std::span<std::uint32_t> row);
    const std::string& problem() const { return problem_; }

  private:
    struct Plane {
        PictureRuns runs;
        Run run{};  ///< what is left of the last one
    };
    PictureRows(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}
    bool add(Plane& plane, std::span<std::uint32_t> row);

    std::uint32_t width_;
    std::uint32_t height_;
    std::uint32_t rows_ = 0;
    std::vector<Plane> planes_;
    std::string problem_;
};

}  // namespace fauxboard::sliced
