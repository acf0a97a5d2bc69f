#include "emulator/sliced/sliced_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "emulator/sliced/fields.h"

namespace fauxboard::sliced {
namespace {

// Layouts: see the README of this folder.
constexpr std::uint32_t magic_cbddlp = 0x12FD'0019;
constexpr std::uint32_t magic_ctb = 0x12FD'0086;
constexpr std::uint32_t ext1_bytes = 60;
constexpr std::uint32_t ext2_bytes = 76;
constexpr std::uint32_t preview_bytes = 32;
constexpr std::uint32_t max_ext_bytes = 65'536;
/// Before each picture in version 3; the record's field 0x18 says so.
constexpr std::uint32_t layer_block_bytes = 84;

constexpr U32Field<Header> header_numbers[] = {
    {0x04, "version", &Header::version, 1, 3},
    {0x30, "number of bottom layers", &Header::bottom_layers},
    {0x34, "picture's width in pixels", &Header::width, 1, SlicedFile::max_side},
    {0x38, "picture's height in pixels", &Header::height, 1, SlicedFile::max_side},
    {0x40, "offset of the layer table", &Header::layer_table, SlicedFile::header_bytes},
    {0x44, "number of layers", &Header::layers, 1},
    {0x4C, "print time in seconds", &Header::print_time_s},
    {0x64, "key of the cipher", &Header::key},
};
constexpr F32Field<Header> header_measures[] = {
    {0x1C, "model's height in mm", &Header::model_height_mm, 0, max_mm},
    {0x20, "layer height in mm", &Header::layer_height_mm, 0, max_mm},
    {0x24, "exposure in seconds", &Header::exposure_s, 0, max_seconds},
    {0x28, "bottom exposure in seconds", &Header::bottom_exposure_s, 0, max_seconds},
    {0x2C, "light-off time in seconds", &Header::light_off_s, 0, max_seconds},
};
constexpr std::size_t bed_at = 0x08;
constexpr std::size_t large_preview_at = 0x3C;
constexpr std::size_t small_preview_at = 0x48;
constexpr std::size_t projection_at = 0x50;
constexpr std::size_t ext1_at = 0x54;
constexpr std::size_t level_sets_at = 0x5C;
constexpr std::size_t pwm_at = 0x60;
constexpr std::size_t bottom_pwm_at = 0x62;
constexpr std::size_t ext2_at = 0x68;

/// The first extension, as it stands in the file.
struct Ext1 {
    float bottom_mm = 0;
    float bottom_mm_min = 0;
    float mm = 0;
    float mm_min = 0;
    float retract_mm_min = 0;
};
constexpr F32Field<Ext1> ext1_lifts[] = {
    {0x00, "bottom lift in mm", &Ext1::bottom_mm, 0, max_mm},
    {0x04, "bottom lift's speed in mm/min", &Ext1::bottom_mm_min, 0, max_mm_min},
    {0x08, "lift in mm", &Ext1::mm, 0, max_mm},
    {0x0C, "lift's speed in mm/min", &Ext1::mm_min, 0, max_mm_min},
    {0x10, "retract speed in mm/min", &Ext1::retract_mm_min, 0, max_mm_min},
};
constexpr F32Field<Header> ext1_measures[] = {
    {0x14, "resin in ml", &Header::resin_ml, 0, 1e6F},
    {0x18, "resin in g", &Header::resin_g, 0, 1e6F},
    {0x1C, "cost", &Header::cost, 0, 1e9F},
    {0x20, "bottom light-off time in seconds", &Header::bottom_light_off_s, 0, max_seconds},
};
constexpr U32Field<Header> ext2_numbers[] = {
    {0x2C, "level of anti-aliasing", &Header::anti_aliasing},
    {0x30, "version of the slicer", &Header::slicer_version},
};

constexpr U32Field<Preview> preview_numbers[] = {
    {0x00, "preview's width in pixels", &Preview::width, 1, SlicedFile::max_preview_side},
    {0x04, "preview's height in pixels", &Preview::height, 1, SlicedFile::max_preview_side},
    {0x08, "offset of the preview's data", &Preview::data_offset, SlicedFile::header_bytes},
    {0x0C, "length of the preview's data", &Preview::data_bytes, 1},
};

constexpr F32Field<Layer> layer_measures[] = {
    {0x00, "layer's place in mm", &Layer::z_mm, 0, max_mm},
    {0x04, "layer's exposure in seconds", &Layer::exposure_s, 0, max_seconds},
    {0x08, "layer's light-off time in seconds", &Layer::light_off_s, 0, max_seconds},
};
constexpr U32Field<Layer> layer_numbers[] = {
    {0x0C, "offset of the layer's picture", &Layer::data_offset, SlicedFile::header_bytes},
    {0x10, "length of the layer's picture", &Layer::data_bytes, 1},
};
constexpr std::size_t layer_info_at = 0x18;
constexpr F32Field<Lift> block_lift[] = {
    {0x28, "layer's lift in mm", &Lift::mm, 0, max_mm},
    {0x2C, "layer's lift speed in mm/min", &Lift::mm_min, 0, max_mm_min},
    {0x38, "layer's retract speed in mm/min", &Lift::retract_mm_min, 0, max_mm_min},
};

std::string format_of(std::uint32_t magic, Format& format) {
    if (magic == magic_cbddlp || magic == magic_ctb) {
        format = magic == magic_ctb ? Format::ctb : Format::cbddlp;
        return {};
    }
    return fmt::format(
        "The file begins with 0x{:08X}; a .cbddlp or .photon begins with 0x{:08X}, a .ctb with 0x{:08X}.",
        magic, magic_cbddlp, magic_ctb);
}

Region table_of(const Header& header) {
    return {"layer table", header.layer_table,
            std::uint64_t{header.layers} * header.level_sets * SlicedFile::record_bytes};
}

/// Reads the parts one after the other; stops at the first problem.
class SlicedFileReader {
  public:
    SlicedFileReader(const ByteSource& source, Header& header) : source_(source), header_(header) {}

    std::string read() {
        const Region whole{"header", 0, SlicedFile::header_bytes};
        if (!take_region(whole) || !ok(read_whole(source_, whole, bytes_)) || !read_header() ||
            !take_region(table_of(header_)) || !read_ext1() || !read_ext2()) {
            return problem_;
        }
        if (read_preview("large preview", large_preview_at, header_.large_preview)) {
            read_preview("small preview", small_preview_at, header_.small_preview);
        }
        return problem_;
    }

  private:
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

    bool read_header() {
        if (!ok(format_of(load_u32(bytes_, 0), header_.format)) ||
            !ok(take(header_numbers, bytes_, 0, header_)) || !ok(take(header_measures, bytes_, 0, header_))) {
            return false;
        }
        for (std::size_t axis = 0; axis < header_.bed_mm.size(); ++axis) {
            const std::size_t at = bed_at + 4 * axis;
            const float mm = load_f32(bytes_, at);
            if (!(mm >= 0 && mm <= max_mm)) {
                return ok(wrong_measure("bed's size in mm", at, mm, 0, max_mm));
            }
            header_.bed_mm[axis] = mm;
        }
        if (header_.pixels() > SlicedFile::max_pixels) {
            return ok(fmt::format("The pictures (at 0x34) have {} x {} pixels; at most {} can be.",
                                  header_.width, header_.height, SlicedFile::max_pixels));
        }
        header_.mirrored = load_u32(bytes_, projection_at) != 0;
        header_.pwm = load_u16(bytes_, pwm_at);
        header_.bottom_pwm = load_u16(bytes_, bottom_pwm_at);
        return read_level_sets();
    }

    /// Only cbddlp has several pictures a layer; its first version left the field empty.
    bool read_level_sets() {
        const std::uint32_t sets = load_u32(bytes_, level_sets_at);
        if (header_.format == Format::ctb || (header_.version == 1 && sets == 0)) {
            return true;
        }
        header_.level_sets = sets;
        return sets >= 1 && sets <= SlicedFile::max_level_sets
                   ? true
                   : ok(wrong_number("number of pictures per layer", level_sets_at, sets, 1,
                                     SlicedFile::max_level_sets));
    }

    /// Where the header says that an extension is; `bytes` 0 when there is none.
    bool find_extension(std::string_view what, std::size_t at, std::uint32_t least, Region& found) {
        found = {what, load_u32(bytes_, at), load_u32(bytes_, at + 4)};
        if (found.bytes == 0 || found.offset == 0) {
            found.bytes = 0;
            return true;
        }
        if (found.bytes < least || found.bytes > max_ext_bytes) {
            return ok(
                wrong_number(fmt::format("size of the {}", what), at + 4, found.bytes, least, max_ext_bytes));
        }
        return take_region(found);
    }

    bool read_ext1() {
        Region region;
        std::array<char, ext1_bytes> bytes{};
        if (!find_extension("first extension", ext1_at, ext1_bytes, region) || region.bytes == 0) {
            return problem_.empty();
        }
        Ext1 ext1;
        if (!ok(read_whole(source_, region, bytes)) || !ok(take(ext1_lifts, bytes, region.offset, ext1)) ||
            !ok(take(ext1_measures, bytes, region.offset, header_))) {
            return false;
        }
        header_.lift = Lift{ext1.mm, ext1.mm_min, ext1.retract_mm_min};
        header_.bottom_lift = Lift{ext1.bottom_mm, ext1.bottom_mm_min, ext1.retract_mm_min};
        return true;
    }

    bool read_ext2() {
        Region region;
        std::array<char, ext2_bytes> bytes{};
        if (!find_extension("second extension", ext2_at, ext2_bytes, region) || region.bytes == 0) {
            return problem_.empty();
        }
        if (!ok(read_whole(source_, region, bytes)) ||
            !ok(take(ext2_numbers, bytes, region.offset, header_))) {
            return false;
        }
        const Region name{"machine's name", load_u32(bytes, 0x1C), load_u32(bytes, 0x20)};
        if (name.bytes == 0) {
            return true;
        }
        if (name.bytes > SlicedFile::max_machine_name) {
            return ok(wrong_number("length of the machine's name", region.offset + 0x20, name.bytes, 0,
                                   SlicedFile::max_machine_name));
        }
        header_.machine.resize(name.bytes);
        return take_region(name) && ok(read_whole(source_, name, header_.machine));
    }

    bool read_preview(std::string_view what, std::size_t at, std::optional<Preview>& out) {
        const Region record{what, load_u32(bytes_, at), preview_bytes};
        if (record.offset == 0) {
            return true;
        }
        std::array<char, preview_bytes> bytes{};
        Preview preview;
        if (!take_region(record) || !ok(read_whole(source_, record, bytes)) ||
            !ok(take(preview_numbers, bytes, record.offset, preview)) ||
            !take_region({"data of a preview", preview.data_offset, preview.data_bytes})) {
            return false;
        }
        out = preview;
        return true;
    }

    const ByteSource& source_;
    Header& header_;
    std::array<char, SlicedFile::header_bytes> bytes_{};
    std::vector<Region> taken_;
    std::string problem_;
};

}  // namespace

std::string_view to_string(Format format) {
    return format == Format::ctb ? "ctb" : "cbddlp";
}

Outcome<SlicedFile> SlicedFile::open(const ByteSource& source) {
    SlicedFile file;
    std::string problem = SlicedFileReader(source, file.header_).read();
    if (!problem.empty()) {
        return Outcome<SlicedFile>::failure(std::move(problem));
    }
    return file;
}

Outcome<Layer> SlicedFile::layer(const ByteSource& source, std::uint32_t n, std::uint32_t plane) const {
    using Result = Outcome<Layer>;
    if (n >= header_.layers || plane >= header_.level_sets) {
        return Result::failure(
            fmt::format("There is no layer {} with a picture {}: {} layers of {} picture(s).", n, plane,
                        header_.layers, header_.level_sets));
    }
    const std::uint64_t index = n + std::uint64_t{plane} * header_.layers;
    const Region record{"layer's record", header_.layer_table + index * record_bytes, record_bytes};
    std::array<char, record_bytes> bytes{};
    Layer layer;
    std::string problem = read_whole(source, record, bytes);
    if (problem.empty()) problem = take(layer_measures, bytes, record.offset, layer);
    if (problem.empty()) problem = take(layer_numbers, bytes, record.offset, layer);
    const std::uint32_t info = header_.version >= 3 ? load_u32(bytes, layer_info_at) : 0;
    if (problem.empty() && info != 0 && info != layer_block_bytes) {
        problem = wrong_number("size of the layer's block", record.offset + layer_info_at, info,
                               layer_block_bytes, layer_block_bytes);
    }
    if (problem.empty()) problem = take_data(source, info, layer);
    if (!problem.empty()) {
        return Result::failure(fmt::format("Layer {}: {}", n, problem));
    }
    if (!layer.lift) {
        layer.lift = n < header_.bottom_layers ? header_.bottom_lift : header_.lift;
    }
    return layer;
}

std::string SlicedFile::take_data(const ByteSource& source, std::uint32_t block, Layer& layer) const {
    const Region data{"picture", layer.data_offset, layer.data_bytes};
    const Region around{"picture with its block", data.offset - block, data.bytes + block};
    std::string problem = check_within(data, source.size());
    if (problem.empty()) problem = check_apart(around, {"header", 0, header_bytes});
    if (problem.empty()) problem = check_apart(around, table_of(header_));
    if (!problem.empty() || block == 0) {
        return problem;
    }
    std::array<char, layer_block_bytes> bytes{};
    problem = read_whole(source, {"layer's block", around.offset, block}, bytes);
    if (problem.empty()) problem = take(block_lift, bytes, around.offset, layer.lift.emplace());
    return problem;
}

Outcome<std::uint64_t> SlicedFile::layer_end(const ByteSource& source, std::uint32_t n) const {
    const Outcome<Layer> found = layer(source, n);
    return found ? Outcome<std::uint64_t>(found->end()) : Outcome<std::uint64_t>::failure(found.problem());
}

}  // namespace fauxboard::sliced
