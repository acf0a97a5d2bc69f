// .cbddlp, .photon and .ctb.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "emulator/sliced/format_reader.h"

namespace fauxboard::sliced {
namespace {

// Layouts: see the README of this folder.
/// The header of version 1 ends before the size of the second extension, which it does not have.
constexpr std::uint32_t first_header_bytes = 0x6C;
constexpr std::uint32_t header_bytes = 0x70;
constexpr std::uint32_t ext1_bytes = 60;
constexpr std::uint32_t ext2_bytes = 76;
constexpr std::uint32_t preview_bytes = 32;
constexpr std::uint32_t max_ext_bytes = 65'536;
/// Before each picture in version 3; the record's field 0x18 says so.
constexpr std::uint32_t layer_block_bytes = 84;

constexpr U32Field<Header> header_numbers[] = {
    {0x30, "number of bottom layers", &Header::bottom_layers},
    {0x34, "picture's width in pixels", &Header::width, 1, SlicedFile::max_side},
    {0x38, "picture's height in pixels", &Header::height, 1, SlicedFile::max_side},
    {0x40, "offset of the layer table", &Header::layer_table, first_header_bytes},
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
    {0x08, "offset of the preview's data", &Preview::data_offset, first_header_bytes},
    {0x0C, "length of the preview's data", &Preview::data_bytes, 1},
};

constexpr F32Field<Layer> layer_measures[] = {
    {0x00, "layer's place in mm", &Layer::z_mm, 0, max_mm},
    {0x04, "layer's exposure in seconds", &Layer::exposure_s, 0, max_seconds},
    {0x08, "layer's light-off time in seconds", &Layer::light_off_s, 0, max_seconds},
};
constexpr U32Field<Layer> layer_numbers[] = {
    {0x0C, "offset of the layer's picture", &Layer::data_offset, first_header_bytes},
    {0x10, "length of the layer's picture", &Layer::data_bytes, 1},
};
constexpr std::size_t layer_info_at = 0x18;
constexpr F32Field<Lift> block_lift[] = {
    {0x28, "layer's lift in mm", &Lift::mm, 0, max_mm},
    {0x2C, "layer's lift speed in mm/min", &Lift::mm_min, 0, max_mm_min},
    {0x38, "layer's retract speed in mm/min", &Lift::retract_mm_min, 0, max_mm_min},
};

/// What a file of this family begins with, and the versions there are of it.
struct Magic {
    std::uint32_t magic;
    Format format;
    std::uint32_t first_version;
    std::uint32_t last_version;
    std::string_view enciphered;  ///< why no more than its kind can be told; empty: it can be read
};
constexpr std::array<Magic, 4> magics{
    {{0x12FD'0019, Format::cbddlp, 1, 3, ""},
     {0x12FD'0086, Format::ctb, 1, 3, ""},
     {0x12FD'0106, Format::ctb, 4, 5, ""},
     {0x12FD'0107, Format::ctb, 0, 0xFFFF'FFFF,
      "its settings and pictures are enciphered with a key that is not published"}}};

const Magic* find_magic(std::uint32_t word) {
    const auto* const hit = std::find_if(magics.begin(), magics.end(),
                                         [word](const Magic& magic) { return magic.magic == word; });
    return hit == magics.end() ? nullptr : hit;
}

Region table_of(const Header& header) {
    return {"layer table", header.layer_table,
            std::uint64_t{header.layers} * header.level_sets * SlicedFile::record_bytes};
}

class ChituReader : private PartReader {
  public:
    ChituReader(const ByteSource& source, Header& header) : PartReader(source), header_(header) {}

    std::string read() {
        if (!read_kind()) {
            return problem();
        }
        const std::uint32_t size = header_.version == 1 ? first_header_bytes : header_bytes;
        const Region whole{"header", 0, size};
        if (!take_region(whole) || !PartReader::read(whole, std::span(bytes_).first(size)) ||
            !read_header() || !take_region(table_of(header_)) || !read_ext1() || !read_ext2()) {
            return problem();
        }
        if (read_preview("large preview", large_preview_at, header_.large_preview)) {
            read_preview("small preview", small_preview_at, header_.small_preview);
        }
        return problem();
    }

  private:
    /// Magic and version: enough to tell what kind of file it is, even of one that cannot be read.
    bool read_kind() {
        std::array<char, 8> begin{};
        if (!PartReader::read({"beginning", 0, begin.size()}, begin)) {
            return false;
        }
        const Magic& magic = *find_magic(load_u32(begin, 0));
        const std::uint32_t version = load_u32(begin, 4);
        if (!magic.enciphered.empty()) {
            return ok(fmt::format("It is an encrypted .ctb (0x{:08X}, version {}): {}.", magic.magic, version,
                                  magic.enciphered));
        }
        if (version < magic.first_version || version > magic.last_version) {
            return ok(wrong_number(fmt::format("version of a .{}", to_string(magic.format)), 4, version,
                                   magic.first_version, magic.last_version));
        }
        header_.format = magic.format;
        header_.version = version;
        return source().size() >= header_bytes || version == 1
                   ? true
                   : ok(fmt::format("It is a .{} of version {}, but its header would take {} bytes, and the "
                                    "file has only {}.",
                                    to_string(magic.format), version, header_bytes, source().size()));
    }

    bool read_header() {
        if (!ok(take(header_numbers, bytes_, 0, header_)) || !ok(take(header_measures, bytes_, 0, header_))) {
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
        if (!ok(check_pixels(header_, 0x34))) {
            return false;
        }
        header_.mirrored = load_u32(bytes_, projection_at) != 0;
        if (header_.version > 1) {
            header_.pwm = load_u16(bytes_, pwm_at);
            header_.bottom_pwm = load_u16(bytes_, bottom_pwm_at);
        }
        return read_level_sets();
    }

    /// Only cbddlp has several pictures a layer; its first version has no such field. An empty one says one.
    bool read_level_sets() {
        const std::uint32_t sets = load_u32(bytes_, level_sets_at);
        if (header_.format == Format::ctb || header_.version == 1 || sets == 0) {
            return true;
        }
        header_.level_sets = sets;
        return sets <= SlicedFile::max_level_sets
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
        if (header_.version == 1) {
            return true;
        }
        Region region;
        std::array<char, ext1_bytes> bytes{};
        if (!find_extension("first extension", ext1_at, ext1_bytes, region) || region.bytes == 0) {
            return problem().empty();
        }
        Ext1 ext1;
        if (!ok(read_whole(source(), region, bytes)) || !ok(take(ext1_lifts, bytes, region.offset, ext1)) ||
            !ok(take(ext1_measures, bytes, region.offset, header_))) {
            return false;
        }
        header_.lift = Lift{ext1.mm, ext1.mm_min, ext1.retract_mm_min};
        header_.bottom_lift = Lift{ext1.bottom_mm, ext1.bottom_mm_min, ext1.retract_mm_min};
        return true;
    }

    bool read_ext2() {
        if (header_.version == 1) {
            return true;
        }
        Region region;
        std::array<char, ext2_bytes> bytes{};
        if (!find_extension("second extension", ext2_at, ext2_bytes, region) || region.bytes == 0) {
            return problem().empty();
        }
        if (!ok(read_whole(source(), region, bytes)) ||
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
        return take_region(name) && ok(read_whole(source(), name, header_.machine));
    }

    bool read_preview(std::string_view what, std::size_t at, std::optional<Preview>& out) {
        const Region record{what, load_u32(bytes_, at), preview_bytes};
        if (record.offset == 0) {
            return true;
        }
        std::array<char, preview_bytes> bytes{};
        Preview preview;
        if (!take_region(record) || !ok(read_whole(source(), record, bytes)) ||
            !ok(take(preview_numbers, bytes, record.offset, preview)) ||
            !take_region({"data of a preview", preview.data_offset, preview.data_bytes})) {
            return false;
        }
        out = preview;
        return true;
    }

    Header& header_;
    std::array<char, header_bytes> bytes_{};
};

/// Checks where the picture stands and reads the block of `block` bytes before it.
std::string take_data(const ByteSource& source, const Header& header, std::uint32_t block, Layer& layer) {
    const Region data{"picture", layer.data_offset, layer.data_bytes};
    const Region around{"picture with its block", data.offset - block, data.bytes + block};
    std::string problem = check_within(data, source.size());
    if (problem.empty()) problem = check_apart(around, {"header", 0, first_header_bytes});
    if (problem.empty()) problem = check_apart(around, table_of(header));
    if (!problem.empty() || block == 0) {
        return problem;
    }
    std::array<char, layer_block_bytes> bytes{};
    problem = read_whole(source, {"layer's block", around.offset, block}, bytes);
    if (problem.empty()) problem = take(block_lift, bytes, around.offset, layer.lift.emplace());
    return problem;
}

std::string read_layer(const ByteSource& source, const Header& header, const LayerIndex& /*index*/,
                       std::uint32_t n, std::uint32_t plane, Layer& layer) {
    const std::uint64_t at = n + std::uint64_t{plane} * header.layers;
    const Region record{"layer's record", header.layer_table + at * SlicedFile::record_bytes,
                        SlicedFile::record_bytes};
    std::array<char, SlicedFile::record_bytes> bytes{};
    std::string problem = read_whole(source, record, bytes);
    if (problem.empty()) problem = take(layer_measures, bytes, record.offset, layer);
    if (problem.empty()) problem = take(layer_numbers, bytes, record.offset, layer);
    const std::uint32_t info = header.version >= 3 ? load_u32(bytes, layer_info_at) : 0;
    if (problem.empty() && info != 0 && info != layer_block_bytes) {
        problem = wrong_number("size of the layer's block", record.offset + layer_info_at, info,
                               layer_block_bytes, layer_block_bytes);
    }
    if (problem.empty()) problem = take_data(source, header, info, layer);
    if (!layer.lift) {
        layer.lift = n < header.bottom_layers ? header.bottom_lift : header.lift;
    }
    return problem;
}

bool begins(std::string_view bytes) {
    return bytes.size() >= 4 && find_magic(load_u32(bytes, 0)) != nullptr;
}

std::string open(const ByteSource& source, Header& header, LayerIndex& /*index*/) {
    return ChituReader(source, header).read();
}

}  // namespace

const FormatReader chitu_format{begins, open, read_layer};

}  // namespace fauxboard::sliced
