#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emulator/sliced/picture_runs.h"

namespace fauxboard::sliced {

/// A picture scanline by scanline. The several pictures of an anti-aliased layer become one: the grey of a
/// pixel is how many of them have it lit.
class Scanlines {
  public:
    /// All pictures of layer `n`, or the problem.
    static Outcome<Scanlines> of_layer(const SlicedFile& file, const ByteSource& source, std::uint32_t n);
    static Scanlines of_preview(const Preview& preview, const ByteSource& source);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }

    /// The next line into `line`, which holds width() values (grey, or 0xRRGGBB of a preview). False after
    /// the last, and when the picture is wrong: then problem() tells. After the last line ask once more to
    /// know that nothing followed.
    bool next(std::span<std::uint32_t> line);
    const std::string& problem() const { return problem_; }

  private:
    struct Plane {
        PictureRuns runs;
        Run run{};  ///< what is left of the last one
    };
    Scanlines(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}
    bool add(Plane& plane, std::span<std::uint32_t> line);

    std::uint32_t width_;
    std::uint32_t height_;
    std::uint32_t lines_ = 0;
    std::vector<Plane> planes_;
    std::string problem_;
};

}  // namespace fauxboard::sliced
