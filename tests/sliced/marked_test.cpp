// .pws and .photons, and what is peculiar to the oldest .photon and the newest .ctb.

#include <bit>
#include <cmath>
#include <limits>

#include "tests/sliced/helpers.h"
#include "tests/support/marked_file.h"

namespace fauxboard::sliced::test {
namespace {

using testing::make_photons;
using testing::make_pws;

ResinFile small() {
    ResinFile wishes;
    wishes.kind = ResinFile::Kind::cbddlp;
    wishes.layers = 3;
    return wishes;
}

Outcome<SlicedFile> opened(const MemorySource& source) {
    Outcome<SlicedFile> file = SlicedFile::open(source);
    REQUIRE_MESSAGE(file, file.problem());
    return file;
}

TEST_CASE("sliced: a .pws with its settings, its preview and its pictures") {
    for (const std::uint32_t sets : {1U, 4U, 8U}) {
        ResinFile wishes = small();
        wishes.level_sets = sets;
        const auto made = make_pws(wishes);
        const MemorySource source(made.bytes);
        const auto file = opened(source);
        const Header& header = file->header();
        CHECK(header.format == Format::pws);
        CHECK(header.layers == 3);
        CHECK(header.level_sets == sets);
        CHECK(header.bottom_layers == 2);
        CHECK(header.lift == Lift{6, 90, 150});
        CHECK(header.resin_ml == 12.34F);
        CHECK_FALSE(header.individual);
        CHECK(read_all(source) == "");
        for (std::uint32_t n = 0; n < header.layers; ++n) {
            CHECK(layer_picture(*file, source, n).values == expected_picture(wishes, n));
        }
        REQUIRE(header.large_preview);
        const Picture preview = whole(Scanlines::of_preview(*header.large_preview, source));
        REQUIRE(preview.values.size() == 12);
        CHECK(preview.values[0] == 0xFF'00'00);
        CHECK(preview.values[1] == 0x00'00'FF);
        const auto last = file->layer(source, 2);
        REQUIRE(last);
        CHECK(last->z_mm == doctest::Approx(0.15));
        CHECK(last->exposure_s == 8);
        CHECK(file->layer(source, 1)->exposure_s == 60);
    }
}

TEST_CASE("sliced: the layers of a .pws have settings of their own when the file says so") {
    const auto made = make_pws(small(), true);
    const MemorySource source(made.bytes);
    const auto file = opened(source);
    CHECK(file->header().individual);
    const auto layer = file->layer(source, 1);
    REQUIRE(layer);
    CHECK(layer->exposure_s == 10);
    CHECK(layer->lift == Lift{7, 180, 150});
}

TEST_CASE("sliced: a .photons is walked through, however many layers it has") {
    for (const std::uint32_t layers : {1U, 3U, 3000U}) {
        ResinFile wishes = small();
        wishes.layers = layers;
        const auto made = make_photons(wishes);
        const MemorySource source(made.bytes);
        const auto file = opened(source);
        CHECK(file->header().format == Format::photons);
        CHECK(file->header().layers == layers);
        CHECK(file->header().lift == Lift{6, 90, 150});
        for (const std::uint32_t n : {0U, layers / 2, layers - 1}) {
            CHECK(layer_picture(*file, source, n).values == expected_picture(wishes, n));
            CHECK(file->layer(source, n)->data_offset == made.heads[n] + 28);
        }
    }
}

TEST_CASE("sliced: the header of a .photon of version 1 ends at byte 108, its layers in any order") {
    ResinFile wishes = small();
    wishes.version = 1;
    wishes.first_extension = wishes.second_extension = wishes.previews = false;
    auto made = make_resin_file(wishes);
    // Four bytes less: what stands behind the header moves up.
    made.bytes.erase(0x6C, 4);
    poke(made.bytes, 0x40, made.layer_table - 4);
    for (std::uint32_t n = 0; n < wishes.layers; ++n) {
        const std::size_t record = made.layer_table - 4 + 36 * n;
        poke(made.bytes, record, 0.15F - 0.05F * static_cast<float>(n));
        poke(made.bytes, record + 0x0C, made.data_begins[n] - 4);
    }
    const MemorySource source(made.bytes);
    const auto file = opened(source);
    CHECK(read_all(source) == "");
    CHECK(file->header().version == 1);
    CHECK(file->header().pwm == 255);
    CHECK(file->layer(source, 0)->z_mm > file->layer(source, 2)->z_mm);
    CHECK_FALSE(file->layer(source, 0)->lift);
}

TEST_CASE("sliced: .ctb of versions 4 and 5 are told apart from the encrypted ones") {
    ResinFile wishes = small();
    wishes.kind = ResinFile::Kind::ctb;
    auto made = make_resin_file(wishes);
    poke(made.bytes, 0, 0x12FD'0106U);
    for (const std::uint32_t version : {4U, 5U}) {
        poke(made.bytes, 4, version);
        const MemorySource source(made.bytes);
        const auto file = opened(source);
        CHECK(file->header().version == version);
        CHECK(layer_picture(*file, source, 1).values == expected_picture(wishes, 1));
    }
    using namespace std::string_view_literals;
    CHECK(SlicedFile::open(MemorySource("\x06\x01\xFD\x12\x04\x00\x00\x00"sv)).problem() ==
          "It is a .ctb of version 4, but its header would take 112 bytes, and the file has only 8.");
    CHECK(SlicedFile::open(MemorySource("\x07\x01\xFD\x12\x05\x00\x00\x00"sv)).problem() ==
          "It is an encrypted .ctb (0x12FD0107, version 5): its settings and pictures are enciphered with a "
          "key that is not published.");
}

void check_sentence(const std::string& problem) {
    CHECK(problem.size() > 20);
    CHECK(problem.size() < 400);
    CHECK(problem.back() == '.');
}

/// All that a file costs to be read is bounded by its size, whatever it says of itself.
std::string read_bounded(std::string_view bytes) {
    const MemorySource source(bytes);
    std::string problem = read_all(source);
    CHECK(source.biggest_read <= ByteWindow::buffer_bytes);
    CHECK(source.bytes_read <= 400 * bytes.size() + 400);
    if (!problem.empty()) {
        check_sentence(problem);
    }
    return problem;
}

TEST_CASE("sliced, hostile: a .pws or .photons cut at any byte is told") {
    ResinFile wishes = small();
    wishes.level_sets = 2;
    for (const std::string& bytes : {make_pws(wishes).bytes, make_photons(small()).bytes}) {
        CHECK(read_bounded(bytes) == "");
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            CAPTURE(size);
            CHECK(read_bounded(std::string_view(bytes).substr(0, size)) != "");
        }
    }
}

TEST_CASE("sliced, hostile: every word of a .pws or .photons at its extremes is taken or told") {
    ResinFile wishes = small();
    wishes.level_sets = 2;
    std::vector<std::uint32_t> values{0,           1,           2,           0x0100'0000,
                                      0x7FFF,      0xFF7F'0000, 0x7FFF'FFFF, 0x8000'0000,
                                      0xFFFF'FFFF, 0x0000'00FF, 0xF07F'0000};
    for (const float value : {std::numeric_limits<float>::infinity(), std::nanf(""), -1.0F, 1e30F, 1e-40F}) {
        values.push_back(std::bit_cast<std::uint32_t>(value));
    }
    for (const std::string& made : {make_pws(wishes, true).bytes, make_photons(small()).bytes}) {
        for (std::size_t at = 0; at + 4 <= std::min<std::size_t>(made.size(), 400); at += 2) {
            for (const std::uint32_t value : values) {
                std::string bytes = made;
                poke(bytes, at, value);
                read_bounded(bytes);
            }
        }
    }
}

TEST_CASE("sliced, hostile: a .pws of another version or with a wrong mark is refused") {
    const auto made = make_pws(small());
    const auto problem_with = [&](std::size_t at, std::uint32_t value) {
        std::string bytes = made.bytes;
        poke(bytes, at, value);
        return read_bounded(bytes);
    };
    CHECK(problem_with(12, 516) == "The version of a .pws (at 0xC) is 516; it can be only 1.");
    CHECK(problem_with(made.info, 0) == "The section HEADER at byte 48 does not begin with the mark HEADER.");
    CHECK(problem_with(made.table + 16, 0).find("number of layers") != std::string::npos);
    CHECK(problem_with(made.table + 16, 0xFFFF'FFFF).find("section LAYERDEF would take") !=
          std::string::npos);
    CHECK(problem_with(made.preview, 0).find("mark PREVIEW") != std::string::npos);
    CHECK(problem_with(made.info + 56, 17).find("number of pictures per layer") != std::string::npos);
}

}  // namespace
}  // namespace fauxboard::sliced::test
