// .photons: big endian, no table of layers; each layer says how long it is. From a description, not checked
// against a real file: none was found.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "emulator/sliced/format_reader.h"

namespace fauxboard::sliced {
namespace {

constexpr std::string_view file_begin{"\x00\x00\x00\x02\x00\x31", 6};
constexpr std::uint32_t header_bytes = 98;
constexpr std::uint32_t layer_header_bytes = 28;
constexpr std::uint32_t length_overhead =
    4;  ///< of a picture's length in bytes, which tells more than there is
constexpr std::uint32_t most_layers = 200'000;
constexpr double seconds_per_min = 60;

std::uint32_t load_big_u32(std::span<const char> bytes, std::size_t at) {
    return std::uint32_t{static_cast<unsigned char>(bytes[at])} << 24 |
           std::uint32_t{static_cast<unsigned char>(bytes[at + 1])} << 16 |
           std::uint32_t{static_cast<unsigned char>(bytes[at + 2])} << 8 |
           static_cast<unsigned char>(bytes[at + 3]);
}

double load_big_f64(std::span<const char> bytes, std::size_t at) {
    return std::bit_cast<double>(std::uint64_t{load_big_u32(bytes, at)} << 32 | load_big_u32(bytes, at + 4));
}

/// A measure of the header, and what its unit is to be multiplied with.
struct Measure {
    std::size_t offset;
    std::string_view name;
    double highest;
    void (*take)(Header& header, double value);
};
void take_lift(Header& header, float Lift::*member, double value) {
    (*header.lift).*member = static_cast<float>(value);
}
constexpr std::array<Measure, 8> measures{{
    {14, "layer height in mm", max_mm,
     [](Header& h, double v) { h.layer_height_mm = static_cast<float>(v); }},
    {22, "exposure in seconds", max_seconds,
     [](Header& h, double v) { h.exposure_s = static_cast<float>(v); }},
    {30, "light-off time in seconds", max_seconds,
     [](Header& h, double v) { h.light_off_s = static_cast<float>(v); }},
    {38, "bottom exposure in seconds", max_seconds,
     [](Header& h, double v) { h.bottom_exposure_s = static_cast<float>(v); }},
    {50, "lift in mm", max_mm, [](Header& h, double v) { take_lift(h, &Lift::mm, v); }},
    {58, "lift's speed in mm/s", max_mm_min / seconds_per_min,
     [](Header& h, double v) { take_lift(h, &Lift::mm_min, v * seconds_per_min); }},
    {66, "retract speed in mm/s", max_mm_min / seconds_per_min,
     [](Header& h, double v) { take_lift(h, &Lift::retract_mm_min, v * seconds_per_min); }},
    {74, "resin in ml", 1e6, [](Header& h, double v) { h.resin_ml = static_cast<float>(v); }},
}};
constexpr std::size_t bottom_layers_at = 46;
constexpr std::size_t preview_width_at = 82;
constexpr std::size_t preview_height_at = 90;

/// The head of a layer's picture.
struct LayerHead {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint64_t data_offset = 0;
    std::uint32_t data_bytes = 0;
    std::uint64_t end() const { return data_offset + data_bytes; }
};

std::string read_head(const ByteSource& source, std::uint64_t offset, LayerHead& head) {
    const Region region{"layer's head", offset, layer_header_bytes};
    std::array<char, layer_header_bytes> bytes{};
    std::string problem = check_within(region, source.size());
    if (problem.empty()) problem = read_whole(source, region, bytes);
    if (!problem.empty()) {
        return problem;
    }
    head.width = load_big_u32(bytes, 12);
    head.height = load_big_u32(bytes, 16);
    const std::uint32_t bits = load_big_u32(bytes, 20);
    if (bits / 8 <= length_overhead) {
        return wrong_number("length of the layer's picture in bits", offset + 20, bits,
                            8 * (length_overhead + 1), 0xFFFF'FFFF);
    }
    head.data_offset = region.end();
    head.data_bytes = bits / 8 - length_overhead;
    return check_within({"picture", head.data_offset, head.data_bytes}, source.size());
}

class PhotonsReader : private PartReader {
  public:
    PhotonsReader(const ByteSource& source, Header& header, LayerIndex& index)
        : PartReader(source), header_(header), index_(index) {}

    std::string read() {
        const Region whole{"header", 0, header_bytes};
        if (take_region(whole) && PartReader::read(whole, bytes_) && read_measures() && read_preview()) {
            walk();
        }
        return problem();
    }

  private:
    bool read_measures() {
        header_.format = Format::photons;
        header_.version = load_big_u32(bytes_, 0);
        header_.individual = false;
        header_.lift.emplace();
        for (const Measure& measure : measures) {
            const double value = load_big_f64(bytes_, measure.offset);
            if (!(value >= 0 && value <= measure.highest)) {
                return ok(fmt::format("The {} (at 0x{:X}) is {:g}; it can be 0 to {:g}.", measure.name,
                                      measure.offset, value, measure.highest));
            }
            measure.take(header_, value);
        }
        header_.bottom_layers = load_big_u32(bytes_, bottom_layers_at);
        header_.bottom_lift = header_.lift;
        header_.bottom_light_off_s = header_.light_off_s;
        return true;
    }

    bool read_preview() {
        Preview preview{load_big_u32(bytes_, preview_width_at), load_big_u32(bytes_, preview_height_at),
                        header_bytes, 0, PreviewCoding::big_words};
        for (const auto& [side, at] :
             {std::pair{preview.width, preview_width_at}, std::pair{preview.height, preview_height_at}}) {
            if (side > SlicedFile::max_preview_side) {
                return ok(
                    wrong_number("preview's size in pixels", at, side, 0, SlicedFile::max_preview_side));
            }
        }
        preview.data_bytes = preview.width * preview.height * 2;
        if (preview.data_bytes != 0) {
            header_.large_preview = preview;
        }
        return take_region({"preview", header_bytes, preview.data_bytes});
    }

    /// From layer to layer, to know how many there are and where.
    bool walk() {
        const Region count{"number of layers",
                           header_bytes + (header_.large_preview ? header_.large_preview->data_bytes : 0U),
                           4};
        std::array<char, 4> bytes{};
        if (!take_region(count) || !PartReader::read(count, bytes)) {
            return false;
        }
        header_.layers = load_big_u32(bytes, 0);
        if (header_.layers == 0 || header_.layers > most_layers) {
            return ok(wrong_number("number of layers", count.offset, header_.layers, 1, most_layers));
        }
        header_.model_height_mm = header_.layer_height_mm * static_cast<float>(header_.layers);
        header_.layer_table = static_cast<std::uint32_t>(count.end());
        constexpr auto most = static_cast<std::uint32_t>(LayerIndex::most);
        index_.stride = (header_.layers + most - 1) / most;
        LayerHead head;
        head.data_offset = count.end();
        for (std::uint32_t n = 0; n < header_.layers; ++n) {
            const std::uint64_t offset = head.end();
            if (n % index_.stride == 0) {
                index_.offsets.push_back(offset);
            }
            if (!take_head(n, offset, head)) {
                return false;
            }
        }
        return true;
    }

    bool take_head(std::uint32_t n, std::uint64_t offset, LayerHead& head) {
        const std::string problem = read_head(source(), offset, head);
        if (!problem.empty()) {
            return ok(fmt::format("Layer {}: {}", n, problem));
        }
        if (n == 0) {
            header_.width = head.width;
            header_.height = head.height;
            const std::uint32_t longer = std::max(head.width, head.height);
            if (head.width == 0 || head.height == 0 || longer > SlicedFile::max_side) {
                return ok(
                    wrong_number("picture's size in pixels", offset + 12, longer, 1, SlicedFile::max_side));
            }
            return ok(check_pixels(header_, offset + 12));
        }
        return ok(head.width == header_.width && head.height == header_.height
                      ? ""
                      : fmt::format("Layer {} has {} x {} pixels, the first one {} x {}.", n, head.width,
                                    head.height, header_.width, header_.height));
    }

    Header& header_;
    LayerIndex& index_;
    std::array<char, header_bytes> bytes_{};
};

std::string read_layer(const ByteSource& source, const Header& header, const LayerIndex& index,
                       std::uint32_t n, std::uint32_t /*plane*/, Layer& layer) {
    LayerHead head;
    std::uint64_t offset = index.offsets[n / index.stride];
    for (std::uint32_t at = n / index.stride * index.stride; at <= n; ++at) {
        std::string problem = read_head(source, offset, head);
        if (!problem.empty()) {
            return problem;
        }
        offset = head.end();
    }
    if (head.end() > 0xFFFF'FFFF) {
        return "It lies beyond 4 GiB, where no stick of this kind has a file.";
    }
    layer.data_offset = static_cast<std::uint32_t>(head.data_offset);
    layer.data_bytes = head.data_bytes;
    layer.z_mm = static_cast<float>(n + 1) * header.layer_height_mm;
    layer.exposure_s = n < header.bottom_layers ? header.bottom_exposure_s : header.exposure_s;
    layer.light_off_s = header.light_off_s;
    layer.lift = header.lift;
    return {};
}

bool begins(std::string_view bytes) {
    return bytes.starts_with(file_begin);
}

std::string open(const ByteSource& source, Header& header, LayerIndex& index) {
    return PhotonsReader(source, header, index).read();
}

}  // namespace

const FormatReader photons_format{begins, open, read_layer};

}  // namespace fauxboard::sliced
