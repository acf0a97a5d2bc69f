#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/sliced/byte_source.h"
#include "emulator/sliced/outcome.h"

namespace fauxboard::sliced {

/// .photon files are cbddlp under another name.
enum class Format : std::uint8_t { cbddlp, ctb, pws, photons };
std::string_view to_string(Format format);

/// How the platform frees itself from the film and comes back.
struct Lift {
    float mm = 0;
    float mm_min = 0;
    float retract_mm_min = 0;

    bool operator==(const Lift&) const = default;
};

/// How a preview stands in the file: runs of 15 bits of colour, or words of 16 bits, in the one or the other
/// order of bytes.
enum class PreviewCoding : std::uint8_t { runs, words, big_words };

/// A picture for the board's screen.
struct Preview {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t data_offset = 0;
    std::uint32_t data_bytes = 0;
    PreviewCoding coding = PreviewCoding::runs;
};

/// What the file says of itself, checked. Lengths in mm, times in s.
struct Header {
    Format format = Format::cbddlp;
    std::uint32_t version = 0;
    std::array<float, 3> bed_mm{};
    float model_height_mm = 0;
    float layer_height_mm = 0;
    float exposure_s = 0;
    float bottom_exposure_s = 0;
    float light_off_s = 0;
    std::uint32_t bottom_layers = 0;
    std::uint32_t width = 0;  ///< pixels of the LCD
    std::uint32_t height = 0;
    std::uint32_t layer_table = 0;  ///< offset
    std::uint32_t layers = 0;       ///< at least 1
    std::uint32_t print_time_s = 0;
    bool mirrored = false;
    std::uint32_t level_sets = 1;  ///< pictures per layer; more than one for anti-aliasing, in cbddlp and pws
    /// The pictures of a layer follow one another in one piece of data, and only reading one tells where the
    /// next begins (pws).
    bool sets_in_one = false;
    /// Layers have times and lifts of their own, and they rule.
    bool individual = true;
    std::uint16_t pwm = 255;  ///< 255 is full light
    std::uint16_t bottom_pwm = 255;
    std::uint32_t key = 0;  ///< of the cipher over the pictures; 0 when there is none

    // From the first extension; none in files of version 1.
    std::optional<Lift> lift;
    std::optional<Lift> bottom_lift;
    float bottom_light_off_s = 0;
    float resin_ml = 0;
    float resin_g = 0;
    float cost = 0;

    // From the second extension.
    std::string machine;  ///< name; bytes of the file, at most `max_machine_name`
    std::uint32_t anti_aliasing = 0;
    std::uint32_t slicer_version = 0;  ///< bytes, lowest first: patch, minor, major, release

    std::optional<Preview> large_preview;
    std::optional<Preview> small_preview;

    std::uint64_t pixels() const { return std::uint64_t{width} * height; }
};

/// What rules one layer of the print; not the header does.
struct Layer {
    float z_mm = 0;
    float exposure_s = 0;
    float light_off_s = 0;
    /// From the layer's own block (version 3), else the header's for a bottom or a normal layer. Nothing when
    /// the file does not say: then the machine's own holds.
    std::optional<Lift> lift;
    std::uint32_t data_offset = 0;
    std::uint32_t data_bytes = 0;

    /// Where its picture ends in the file: what boards report as their place in the print.
    std::uint64_t end() const { return std::uint64_t{data_offset} + data_bytes; }
};

/// Where every `stride`-th layer of a file without a table begins; empty where there is a table.
struct LayerIndex {
    static constexpr std::size_t most = 1024;
    std::uint32_t stride = 1;
    std::vector<std::uint64_t> offsets;
};

struct FormatReader;

/// A sliced file of a resin printer: .cbddlp and .photon (versions 1 to 3), .ctb (1 to 5), .pws, .photons.
/// Keeps the header and, where the file has no table of layers, some of their places: each layer is read
/// when it is asked for, from the source given then. A plain value; holds no file open.
class SlicedFile {
  public:
    static constexpr std::uint32_t record_bytes = 36;  ///< of a layer in the table of .cbddlp and .ctb
    static constexpr std::uint32_t max_side = 32768;   ///< pixels; the biggest LCD has 15120 x 6230
    static constexpr std::uint32_t max_pixels = 1U << 27;
    static constexpr std::uint32_t max_level_sets = 16;  ///< pictures of a layer
    static constexpr std::uint32_t max_machine_name = 256;
    static constexpr std::uint32_t max_preview_side = 4096;

    /// Reads and checks header, extensions and preview records. The problem says which field, at which
    /// offset, what it holds and what is possible.
    static Outcome<SlicedFile> open(const ByteSource& source);

    const Header& header() const { return header_; }

    /// The record of layer `n`, from 0, checked as the header is. `plane` chooses among the pictures of an
    /// anti-aliased layer; their times are those of plane 0.
    Outcome<Layer> layer(const ByteSource& source, std::uint32_t n, std::uint32_t plane = 0) const;

    /// layer(n).end(), or the problem.
    Outcome<std::uint64_t> layer_end(const ByteSource& source, std::uint32_t n) const;

  private:
    SlicedFile() = default;
    Header header_;
    LayerIndex index_;
    const FormatReader* reader_ = nullptr;
};

}  // namespace fauxboard::sliced
