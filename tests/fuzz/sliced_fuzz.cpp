// Arbitrary bytes as a sliced file of a resin printer: header, layers, every picture.
//
// The input is the file as it stands.

#include <algorithm>
#include <string>
#include <vector>

#include "emulator/sliced/scanlines.h"
#include "tests/fuzz/support.h"
#include "tests/support/resin_file.h"

namespace fauxboard::fuzz {
namespace {

using sliced::Layer;
using sliced::Outcome;
using sliced::PictureRuns;
using sliced::Run;
using sliced::Scanlines;
using sliced::SlicedFile;

/// Bigger pictures are read run by run only.
constexpr std::uint64_t most_line_pixels = 1U << 18;

void require_sentence(const std::string& problem) {
    require(problem.size() > 20 && problem.size() < 500 && problem.back() == '.', "a problem is no sentence");
}

struct Sum {
    std::uint64_t pixels = 0;
    std::uint64_t values = 0;
    std::string problem;
};

Sum sum_of(PictureRuns runs, std::uint64_t bytes) {
    Sum sum;
    std::uint64_t count = 0;
    for (Run run; runs.next(run); ++count) {
        require(run.pixels != 0, "a run of nothing");
        sum.pixels += run.pixels;
        sum.values += std::uint64_t{run.pixels} * run.value;
    }
    require(count <= bytes, "more runs than bytes");
    sum.problem = runs.problem();
    return sum;
}

Sum sum_of(Scanlines lines) {
    Sum sum;
    std::vector<std::uint32_t> row(lines.width());
    while (lines.next(row)) {
        sum.pixels += row.size();
        for (const std::uint32_t value : row) {
            sum.values += value;
        }
    }
    sum.problem = lines.problem();
    return sum;
}

/// By runs and by lines it is the same picture, and all of it, or the same mistake.
void check_picture(const Sum& runs, Scanlines lines) {
    const std::uint64_t pixels = std::uint64_t{lines.width()} * lines.height();
    if (pixels <= most_line_pixels) {
        const Sum by_lines = sum_of(std::move(lines));
        require(by_lines.problem == runs.problem, "runs and lines do not tell the same");
        require(!runs.problem.empty() || by_lines.values == runs.values, "runs and lines differ");
    }
    if (runs.problem.empty()) {
        require(runs.pixels == pixels, "a whole picture lacks pixels");
    } else {
        require_sentence(runs.problem);
    }
}

void check_layer(const SlicedFile& file, const testing::MemorySource& source, std::uint32_t n) {
    for (std::uint32_t plane = 0; plane < file.header().level_sets; ++plane) {
        const Outcome<Layer> layer = file.layer(source, n, plane);
        if (!layer) {
            require_sentence(layer.problem());
            return;
        }
        require(layer->end() <= source.size(), "a layer ends beyond the file");
        const Sum sum = sum_of(PictureRuns::of_layer(file, source, n, *layer), layer->data_bytes);
        if (file.header().level_sets == 1) {
            check_picture(sum, *Scanlines::of_layer(file, source, n));
        }
    }
    Outcome<Scanlines> lines = Scanlines::of_layer(file, source, n);
    if (lines && file.header().pixels() <= most_line_pixels) {
        sum_of(std::move(*lines));
    }
}

void run(std::string_view bytes) {
    const testing::MemorySource source(bytes);
    const Outcome<SlicedFile> file = SlicedFile::open(source);
    require(source.bytes_read < 1024, "opening reads more than the records");
    if (!file) {
        require_sentence(file.problem());
        return;
    }
    require(std::uint64_t{file->header().layers} * SlicedFile::record_bytes <= bytes.size(),
            "more layers than the file has room for");
    for (const auto* preview : {&file->header().large_preview, &file->header().small_preview}) {
        if (*preview) {
            check_picture(sum_of(PictureRuns::of_preview(**preview, source), (*preview)->data_bytes),
                          Scanlines::of_preview(**preview, source));
        }
    }
    for (std::uint32_t n = 0; n < file->header().layers; ++n) {
        check_layer(*file, source, n);
    }
    require(source.biggest_read <= sliced::ByteWindow::buffer_bytes, "a read of more than the buffer");
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fauxboard::fuzz::run({reinterpret_cast<const char*>(data), size});
    return 0;
}
