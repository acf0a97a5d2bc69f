#pragma once

#include <cstdint>
#include <string>

#include "emulator/sliced/byte_window.h"
#include "emulator/sliced/sliced_file.h"

namespace fauxboard::sliced {

/// Pixels of one value, row after row; a run may go on into the next row.
struct Run {
    std::uint32_t value = 0;  ///< grey 0 to 255; of a preview 0xRRGGBB
    std::uint32_t pixels = 0;
};

/// A picture as the runs that its data holds, one at a time. Its pixels are counted: exactly width times
/// height.
class PictureRuns {
  public:
    /// Picture `plane` of layer `n`: `layer` is what SlicedFile::layer gave for them.
    static PictureRuns of_layer(const SlicedFile& file, const ByteSource& source, std::uint32_t n,
                                const Layer& layer, std::uint32_t plane = 0);
    static PictureRuns of_preview(const Preview& preview, const ByteSource& source);

    /// The next run, of one pixel or more. False when the picture is whole, or wrong: then problem() tells.
    bool next(Run& run);
    /// A full sentence, or empty.
    const std::string& problem() const { return problem_; }
    std::uint64_t pixels_left() const { return left_; }

    /// Takes one run out of the window, or tells what is wrong. `pixels` may come out as 0.
    using Codec = std::string (*)(ByteWindow& window, Run& run);

  private:
    PictureRuns(ByteWindow window, Codec codec, std::uint64_t pixels)
        : window_(window), codec_(codec), pixels_(pixels), left_(pixels) {}
    bool fail(std::string problem);

    ByteWindow window_;
    Codec codec_;
    std::uint64_t pixels_;
    std::uint64_t left_;
    bool more_follow_ = false;  ///< the data of this picture does not end with it
    std::string problem_;
};

}  // namespace fauxboard::sliced
