#include "emulator/sliced/sliced_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "emulator/sliced/format_reader.h"

namespace fauxboard::sliced {
namespace {

constexpr std::array<const FormatReader*, 3> readers{&chitu_format, &pws_format, &photons_format};

std::string unknown_beginning(std::string_view bytes) {
    std::string hex;
    for (const char c : bytes.substr(0, 6)) {
        hex += fmt::format("{}{:02X}", hex.empty() ? "" : " ", static_cast<unsigned char>(c));
    }
    return fmt::format(
        "The file begins with the bytes {}; a .cbddlp or .photon begins with 19 00 FD 12, a .ctb with 86 00 "
        "FD 12 (version 4: 06 01 FD 12), a .pws with ANYCUBIC, a .photons with 00 00 00 02 00 31.",
        hex);
}

}  // namespace

std::string_view to_string(Format format) {
    constexpr std::array<std::string_view, 4> names{"cbddlp", "ctb", "pws", "photons"};
    return names[static_cast<std::size_t>(format)];
}

std::string check_pixels(const Header& header, std::uint64_t at) {
    if (header.pixels() <= SlicedFile::max_pixels) {
        return {};
    }
    return fmt::format("The pictures (at 0x{:X}) have {} x {} pixels; at most {} can be.", at, header.width,
                       header.height, SlicedFile::max_pixels);
}

Outcome<SlicedFile> SlicedFile::open(const ByteSource& source) {
    using Result = Outcome<SlicedFile>;
    std::array<char, 16> begin{};
    const std::string_view bytes(begin.data(), source.read(0, begin));
    if (bytes.empty()) {
        return Result::failure("The file is empty, or cannot be read.");
    }
    const auto* const hit = std::find_if(readers.begin(), readers.end(),
                                         [&](const FormatReader* reader) { return reader->begins(bytes); });
    if (hit == readers.end()) {
        return Result::failure(unknown_beginning(bytes));
    }
    SlicedFile file;
    file.reader_ = *hit;
    std::string problem = file.reader_->open(source, file.header_, file.index_);
    if (!problem.empty()) {
        return Result::failure(std::move(problem));
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
    Layer layer;
    const std::string problem = reader_->layer(source, header_, index_, n, plane, layer);
    if (!problem.empty()) {
        return Result::failure(fmt::format("Layer {}: {}", n, problem));
    }
    return layer;
}

Outcome<std::uint64_t> SlicedFile::layer_end(const ByteSource& source, std::uint32_t n) const {
    const Outcome<Layer> found = layer(source, n);
    return found ? Outcome<std::uint64_t>(found->end()) : Outcome<std::uint64_t>::failure(found.problem());
}

}  // namespace fauxboard::sliced
