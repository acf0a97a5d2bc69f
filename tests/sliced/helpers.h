#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "emulator/sliced/scanlines.h"
#include "tests/support/resin_file.h"

namespace fauxboard::sliced::test {

using testing::MadeResinFile;
using testing::make_resin_file;
using testing::MemorySource;
using testing::poke;
using testing::ResinFile;

/// All values of a picture; `problem` says why they are not all.
struct Picture {
    std::vector<std::uint32_t> values;
    std::string problem;
};

inline Picture whole(Scanlines lines) {
    Picture picture;
    std::vector<std::uint32_t> row(lines.width());
    while (lines.next(row)) {
        picture.values.insert(picture.values.end(), row.begin(), row.end());
    }
    picture.problem = lines.problem();
    return picture;
}

inline Picture layer_picture(const SlicedFile& file, const ByteSource& source, std::uint32_t n) {
    Outcome<Scanlines> lines = Scanlines::of_layer(file, source, n);
    return lines ? whole(std::move(*lines)) : Picture{{}, lines.problem()};
}

/// The first problem that reading all of the file meets: header, every layer's record and pictures, previews.
inline std::string read_all(const ByteSource& source) {
    const Outcome<SlicedFile> file = SlicedFile::open(source);
    if (!file) {
        return file.problem();
    }
    for (const auto* preview : {&file->header().large_preview, &file->header().small_preview}) {
        const std::string problem =
            *preview ? whole(Scanlines::of_preview(**preview, source)).problem : std::string();
        if (!problem.empty()) {
            return problem;
        }
    }
    for (std::uint32_t n = 0; n < file->header().layers; ++n) {
        const std::string problem = layer_picture(*file, source, n).problem;
        if (!problem.empty()) {
            return problem;
        }
    }
    return {};
}

/// The same pictures as the file's maker was asked for, with what each format loses.
inline std::vector<std::uint32_t> expected_picture(const ResinFile& wishes, std::uint32_t n) {
    std::vector<std::uint32_t> values;
    for (std::uint32_t y = 0; y < wishes.height; ++y) {
        for (std::uint32_t x = 0; x < wishes.width; ++x) {
            const std::uint32_t grey = wishes.picture(n, x, y);
            const std::uint32_t seven = grey / 2;
            const std::uint32_t lit = grey * wishes.level_sets / 255;
            values.push_back(wishes.kind == ResinFile::Kind::ctb ? seven * 2 + seven / 64
                                                                 : lit * 255 / wishes.level_sets);
        }
    }
    return values;
}

}  // namespace fauxboard::sliced::test
