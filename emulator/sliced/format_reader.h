#pragma once

// What the readers of the single formats share. Private to sliced/.

#include <string>
#include <string_view>
#include <vector>

#include "emulator/sliced/fields.h"
#include "emulator/sliced/sliced_file.h"

namespace fauxboard::sliced {

/// One family of formats.
struct FormatReader {
    /// Whether a file that begins so (up to 16 bytes) is one.
    bool (*begins)(std::string_view bytes);
    /// Reads and checks all but the layers. The problem, or empty.
    std::string (*open)(const ByteSource& source, Header& header, LayerIndex& index);
    /// The record of layer `n`, which is one of the file's. The problem, or empty.
    std::string (*layer)(const ByteSource& source, const Header& header, const LayerIndex& index,
                         std::uint32_t n, std::uint32_t plane, Layer& layer);
};

extern const FormatReader chitu_format;
extern const FormatReader pws_format;
extern const FormatReader photons_format;

/// Reads the parts of a file one after the other, and stops at the first problem.
class PartReader {
  public:
    explicit PartReader(const ByteSource& source) : source_(source) {}

    bool ok(std::string problem) {
        problem_ = std::move(problem);
        return problem_.empty();
    }
    /// Nothing of a file may stand twice on the same bytes: a table that points at itself is found so.
    bool take_region(const Region& region) {
        if (!ok(check_within(region, source_.size()))) {
            return false;
        }
        for (const Region& other : taken_) {
            if (!ok(check_apart(region, other))) {
                return false;
            }
        }
        taken_.push_back(region);
        return true;
    }
    bool read(const Region& region, std::span<char> out) { return ok(read_whole(source_, region, out)); }
    const ByteSource& source() const { return source_; }
    const std::string& problem() const { return problem_; }

  private:
    const ByteSource& source_;
    std::vector<Region> taken_;
    std::string problem_;
};

/// Empty, or what is wrong with a picture of that many pixels.
std::string check_pixels(const Header& header, std::uint64_t at);

}  // namespace fauxboard::sliced
