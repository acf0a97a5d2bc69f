#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/sliced/byte_source.h"

namespace fauxboard::testing {

/// How a made-up sliced file of a resin printer is to be. Written from the description of the format, apart
/// from the reader.
struct ResinFile {
    enum class Kind : std::uint8_t { cbddlp, ctb };
    /// Grey 0 to 255 of a pixel.
    using Picture = std::function<std::uint8_t(std::uint32_t layer, std::uint32_t x, std::uint32_t y)>;

    Kind kind = Kind::ctb;
    std::uint32_t version = 3;
    std::uint32_t width = 16;
    std::uint32_t height = 8;
    std::uint32_t layers = 4;
    std::uint32_t bottom_layers = 2;
    std::uint32_t level_sets = 1;  ///< cbddlp: plane p is lit where the grey is at least (p + 1) / level_sets
    std::uint32_t key = 0;         ///< ctb
    bool first_extension = true;
    bool second_extension = true;
    bool previews = true;
    std::string machine = "Made-up LCD";
    float layer_height_mm = 0.05F;
    float exposure_s = 8;
    float bottom_exposure_s = 60;
    float light_off_s = 1;
    float lift_mm = 6;  ///< of layer n in version 3: this plus n
    float lift_mm_min = 90;
    float retract_mm_min = 150;
    Picture picture = box;

    /// A frame of light that moves with the layers, with soft edges.
    static std::uint8_t box(std::uint32_t layer, std::uint32_t x, std::uint32_t y);
};

struct MadeResinFile {
    std::string bytes;
    std::vector<std::uint32_t> layer_ends;  ///< of the first picture of each layer
    std::vector<std::uint32_t> data_begins;
    std::uint32_t layer_table = 0;
    std::uint32_t ext1 = 0;
    std::uint32_t ext2 = 0;
    std::uint32_t large_preview = 0;
    std::uint32_t small_preview = 0;
};

MadeResinFile make_resin_file(const ResinFile& wishes);

/// Writes over, or reads, four bytes of a made file.
void poke(std::string& bytes, std::size_t at, std::uint32_t value);
void poke(std::string& bytes, std::size_t at, float value);
std::uint32_t peek(std::string_view bytes, std::size_t at);

/// A file in memory, which counts what is asked of it.
class MemorySource final : public sliced::ByteSource {
  public:
    explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}
    std::uint64_t size() const override { return said_size_ == 0 ? bytes_.size() : said_size_; }
    std::size_t read(std::uint64_t offset, std::span<char> out) const override;
    /// A file that says it is bigger than what it gives: it shrank meanwhile.
    void say_size(std::uint64_t bytes) { said_size_ = bytes; }

    mutable std::uint64_t reads = 0;
    mutable std::uint64_t bytes_read = 0;
    mutable std::size_t biggest_read = 0;

  private:
    std::string_view bytes_;
    std::uint64_t said_size_ = 0;
};

}  // namespace fauxboard::testing
