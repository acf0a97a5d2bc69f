// .pws: what the slicer Photon Workshop writes. Little endian; marked sections, speeds in mm/s.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "emulator/sliced/format_reader.h"

namespace fauxboard::sliced {
namespace {

constexpr std::string_view file_mark = "ANYCUBIC";
constexpr std::size_t mark_bytes = 12;
constexpr std::uint32_t file_header_bytes = 48;
constexpr std::uint32_t info_bytes = 84;  ///< with its mark and length
constexpr std::uint32_t preview_header_bytes = 28;
constexpr std::uint32_t table_header_bytes = 20;
constexpr std::uint32_t layer_bytes = 32;
constexpr std::uint32_t most_section_bytes = 1U << 26;
constexpr float max_mm_s = max_mm_min / 60;
constexpr float seconds_per_min = 60;

/// What stands at the beginning of the file.
struct Sections {
    std::uint32_t version = 0;
    std::uint32_t info = 0;
    std::uint32_t preview = 0;
    std::uint32_t table = 0;
};
constexpr U32Field<Sections> section_numbers[] = {
    {12, "version of a .pws", &Sections::version, 1, 1},
    {20, "offset of the section HEADER", &Sections::info, file_header_bytes},
    {28, "offset of the section PREVIEW", &Sections::preview, 0},
    {36, "offset of the section LAYERDEF", &Sections::table, file_header_bytes},
};

/// The section HEADER as it stands in the file.
struct Info {
    float bottom_layers = 0;
    float lift_mm = 0;
    float lift_mm_s = 0;
    float drop_mm_s = 0;
};
constexpr F32Field<Info> info_measures[] = {
    {36, "number of bottom layers", &Info::bottom_layers, 0, 1e6F},
    {40, "lift in mm", &Info::lift_mm, 0, max_mm},
    {44, "lift's speed in mm/s", &Info::lift_mm_s, 0, max_mm_s},
    {48, "drop's speed in mm/s", &Info::drop_mm_s, 0, max_mm_s},
};
constexpr F32Field<Header> info_header_measures[] = {
    {20, "layer height in mm", &Header::layer_height_mm, 0, max_mm},
    {24, "exposure in seconds", &Header::exposure_s, 0, max_seconds},
    {28, "light-off time in seconds", &Header::light_off_s, 0, max_seconds},
    {32, "bottom exposure in seconds", &Header::bottom_exposure_s, 0, max_seconds},
    {52, "resin in ml", &Header::resin_ml, 0, 1e6F},
    {68, "resin in g", &Header::resin_g, 0, 1e6F},
    {72, "price", &Header::cost, 0, 1e9F},
};
constexpr U32Field<Header> info_header_numbers[] = {
    {56, "number of pictures per layer", &Header::level_sets, 0, SlicedFile::max_level_sets},
    {60, "picture's width in pixels", &Header::width, 1, SlicedFile::max_side},
    {64, "picture's height in pixels", &Header::height, 1, SlicedFile::max_side},
};
constexpr std::size_t individual_at = 80;

constexpr U32Field<Preview> preview_numbers[] = {
    {16, "preview's width in pixels", &Preview::width, 1, SlicedFile::max_preview_side},
    {24, "preview's height in pixels", &Preview::height, 1, SlicedFile::max_preview_side},
};

constexpr U32Field<Layer> layer_places[] = {
    {0, "offset of the layer's picture", &Layer::data_offset, file_header_bytes},
    {4, "length of the layer's picture", &Layer::data_bytes, 1},
};
/// A layer's own settings, of which the lift is in mm/s.
constexpr F32Field<Lift> layer_lifts[] = {
    {8, "layer's lift in mm", &Lift::mm, 0, max_mm},
    {12, "layer's lift speed in mm/s", &Lift::mm_min, 0, max_mm_s},
};
constexpr F32Field<Layer> layer_measures[] = {
    {16, "layer's exposure in seconds", &Layer::exposure_s, 0, max_seconds},
};

class PwsReader : private PartReader {
  public:
    PwsReader(const ByteSource& source, Header& header) : PartReader(source), header_(header) {}

    std::string read() {
        std::array<char, file_header_bytes> bytes{};
        const Region whole{"file's header", 0, file_header_bytes};
        if (take_region(whole) && PartReader::read(whole, bytes) && marked(bytes, file_mark, whole) &&
            ok(take(section_numbers, bytes, 0, sections_)) && read_info() && read_preview()) {
            read_table();
        }
        return problem();
    }

  private:
    /// A section begins with its name, the rest of 12 bytes is NUL.
    bool marked(std::span<const char> bytes, std::string_view mark, const Region& section) {
        const std::string_view found(bytes.data(), mark_bytes);
        return ok(found.starts_with(mark) &&
                          found.find_first_not_of('\0', mark.size()) == std::string_view::npos
                      ? ""
                      : fmt::format("The {} at byte {} does not begin with the mark {}.", section.what,
                                    section.offset, mark));
    }

    /// The first `head.size()` bytes of a section, whose length stands behind its mark.
    bool read_section(std::string_view what, std::string_view mark, std::uint32_t offset, std::uint32_t least,
                      std::span<char> head) {
        const Region begin{what, offset, head.size()};
        if (!ok(check_within(begin, source().size())) || !PartReader::read(begin, head) ||
            !marked(head, mark, begin)) {
            return false;
        }
        const std::uint32_t length = load_u32(head, mark_bytes);
        if (length < least || length > most_section_bytes) {
            return ok(wrong_number(fmt::format("length of the {}", what), offset + mark_bytes, length, least,
                                   most_section_bytes));
        }
        return true;
    }

    bool read_info() {
        std::array<char, info_bytes> bytes{};
        Info info;
        const std::uint32_t base = sections_.info;
        constexpr std::uint32_t least = info_bytes - mark_bytes - 4;
        if (!read_section("section HEADER", "HEADER", base, least, bytes) ||
            !take_region({"section HEADER", base, info_bytes}) ||
            !ok(take(info_measures, bytes, base, info)) ||
            !ok(take(info_header_measures, bytes, base, header_)) ||
            !ok(take(info_header_numbers, bytes, base, header_)) || !ok(check_pixels(header_, base + 60))) {
            return false;
        }
        header_.format = Format::pws;
        header_.version = sections_.version;
        header_.level_sets = header_.level_sets == 0 ? 1 : header_.level_sets;
        header_.sets_in_one = true;
        header_.individual = load_u32(bytes, individual_at) != 0;
        header_.bottom_layers = static_cast<std::uint32_t>(info.bottom_layers);
        header_.bottom_light_off_s = header_.light_off_s;
        header_.lift = header_.bottom_lift =
            Lift{info.lift_mm, info.lift_mm_s * seconds_per_min, info.drop_mm_s * seconds_per_min};
        return true;
    }

    bool read_preview() {
        if (sections_.preview == 0) {
            return true;
        }
        std::array<char, preview_header_bytes> bytes{};
        Preview preview;
        const std::uint32_t base = sections_.preview;
        constexpr std::uint32_t length_of_head = preview_header_bytes - mark_bytes - 4;
        if (!read_section("section PREVIEW", "PREVIEW", base, length_of_head, bytes) ||
            !ok(take(preview_numbers, bytes, base, preview))) {
            return false;
        }
        preview.coding = PreviewCoding::words;
        preview.data_offset = base + preview_header_bytes;
        preview.data_bytes = preview.width * preview.height * 2;
        header_.large_preview = preview;
        return take_region(
            {"section PREVIEW", base, std::uint64_t{preview_header_bytes} + preview.data_bytes});
    }

    bool read_table() {
        std::array<char, table_header_bytes> bytes{};
        const std::uint32_t base = sections_.table;
        if (!read_section("section LAYERDEF", "LAYERDEF", base, 4, bytes)) {
            return false;
        }
        header_.layers = load_u32(bytes, mark_bytes + 4);
        header_.layer_table = base + table_header_bytes;
        header_.model_height_mm = header_.layer_height_mm * static_cast<float>(header_.layers);
        if (header_.layers == 0) {
            return ok(wrong_number("number of layers", base + mark_bytes + 4, 0, 1, 0xFFFF'FFFF));
        }
        return take_region(
            {"section LAYERDEF", base, table_header_bytes + std::uint64_t{header_.layers} * layer_bytes});
    }

    Header& header_;
    Sections sections_;
};

/// The pictures of a layer lie in one piece; whoever reads `plane` passes over those before it.
std::string read_layer(const ByteSource& source, const Header& header, const LayerIndex& /*index*/,
                       std::uint32_t n, std::uint32_t /*plane*/, Layer& layer) {
    const Region record{"layer's record", header.layer_table + std::uint64_t{n} * layer_bytes, layer_bytes};
    std::array<char, layer_bytes> bytes{};
    std::string problem = read_whole(source, record, bytes);
    if (problem.empty()) problem = take(layer_places, bytes, record.offset, layer);
    if (problem.empty()) {
        problem = check_within({"picture", layer.data_offset, layer.data_bytes}, source.size());
    }
    const bool bottom = n < header.bottom_layers;
    layer.z_mm = static_cast<float>(n + 1) * header.layer_height_mm;
    layer.light_off_s = header.light_off_s;
    layer.exposure_s = bottom ? header.bottom_exposure_s : header.exposure_s;
    layer.lift = header.lift;
    if (problem.empty() && header.individual) {
        problem = take(layer_measures, bytes, record.offset, layer);
        if (problem.empty()) problem = take(layer_lifts, bytes, record.offset, *layer.lift);
        layer.lift->mm_min *= seconds_per_min;
    }
    return problem;
}

bool begins(std::string_view bytes) {
    return bytes.starts_with(file_mark);
}

std::string open(const ByteSource& source, Header& header, LayerIndex& /*index*/) {
    return PwsReader(source, header).read();
}

}  // namespace

const FormatReader pws_format{begins, open, read_layer};

}  // namespace fauxboard::sliced
