#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/dlp/stick.h"

namespace fauxboard::dlp {

/// The preview of one file at a time, unpacked: whoever draws it asks for it row by row.
class Previews {
  public:
    struct Pixels {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::vector<std::uint32_t> rgb;
    };

    /// Of the file at `path`; null when it has none, or it cannot be read. Valid until the next call.
    const Pixels* pixels(const Stick& stick, const std::string& path) const;
    /// The stick's files may be other ones from now on.
    void forget() const { path_.clear(); }

  private:
    static constexpr std::uint64_t most_pixels = 1U << 20;
    void read(const sliced::ByteSource& source) const;

    mutable std::string path_;
    mutable Pixels pixels_;
};

}  // namespace fauxboard::dlp
