// What is written comes back: every format and version, every number, every pixel.

#include <string>

#include "tests/sliced/helpers.h"

namespace fauxboard::sliced::test {
namespace {

using Kind = ResinFile::Kind;

struct Case {
    const char* name;
    ResinFile wishes;
};

ResinFile wishes(Kind kind, std::uint32_t version, std::uint32_t key, std::uint32_t level_sets) {
    ResinFile made;
    made.kind = kind;
    made.version = version;
    made.key = key;
    made.level_sets = level_sets;
    made.first_extension = made.second_extension = version > 1;
    return made;
}

std::vector<Case> cases() {
    std::vector<Case> all{
        {"cbddlp 1", wishes(Kind::cbddlp, 1, 0, 1)},
        {"cbddlp 2", wishes(Kind::cbddlp, 2, 0, 1)},
        {"cbddlp 2, 2 pictures a layer", wishes(Kind::cbddlp, 2, 0, 2)},
        {"cbddlp 3, 8 pictures a layer", wishes(Kind::cbddlp, 3, 0, 8)},
        {"ctb 1", wishes(Kind::ctb, 1, 0, 1)},
        {"ctb 2", wishes(Kind::ctb, 2, 0, 1)},
        {"ctb 2, with a key", wishes(Kind::ctb, 2, 0x1234'5678, 1)},
        {"ctb 3", wishes(Kind::ctb, 3, 0, 1)},
        {"ctb 3, with a key", wishes(Kind::ctb, 3, 0xFFFF'FFFF, 1)},
    };
    Case bare{"ctb 3, no previews, no extensions", wishes(Kind::ctb, 3, 7, 1)};
    bare.wishes.previews = bare.wishes.first_extension = bare.wishes.second_extension = false;
    all.push_back(bare);
    return all;
}

TEST_CASE("sliced: every format gives back its numbers, layers and pixels") {
    for (const Case& each : cases()) {
        CAPTURE(each.name);
        const ResinFile& made_of = each.wishes;
        const MadeResinFile made = make_resin_file(made_of);
        const MemorySource source(made.bytes);
        const Outcome<SlicedFile> file = SlicedFile::open(source);
        REQUIRE_MESSAGE(file, file.problem());
        const Header& header = file->header();
        CHECK(to_string(header.format) == (made_of.kind == Kind::ctb ? "ctb" : "cbddlp"));
        CHECK(header.version == made_of.version);
        CHECK(header.layers == made_of.layers);
        CHECK(header.level_sets == made_of.level_sets);
        CHECK(header.key == made_of.key);
        CHECK(header.lift.has_value() == made_of.first_extension);
        CHECK(header.large_preview.has_value() == made_of.previews);
        CHECK(header.machine == (made_of.second_extension ? made_of.machine : ""));
        for (std::uint32_t n = 0; n < made_of.layers; ++n) {
            const Outcome<Layer> layer = file->layer(source, n);
            REQUIRE_MESSAGE(layer, layer.problem());
            CHECK(layer->end() == made.layer_ends[n]);
            CHECK(layer->data_offset == made.data_begins[n]);
            const Picture picture = layer_picture(*file, source, n);
            CHECK(picture.problem == "");
            CHECK(picture.values == expected_picture(made_of, n));
        }
        CHECK(made.layer_ends.back() <= made.bytes.size());
    }
}

TEST_CASE("sliced: the header's numbers, each in its place") {
    const MadeResinFile made = make_resin_file(wishes(Kind::ctb, 2, 0, 1));
    const MemorySource source(made.bytes);
    const Outcome<SlicedFile> file = SlicedFile::open(source);
    REQUIRE(file);
    const Header& header = file->header();
    CHECK(header.bed_mm == std::array<float, 3>{68.04F, 120.96F, 150});
    CHECK(header.model_height_mm == doctest::Approx(0.2));
    CHECK(header.layer_height_mm == 0.05F);
    CHECK(header.exposure_s == 8);
    CHECK(header.bottom_exposure_s == 60);
    CHECK(header.light_off_s == 1);
    CHECK(header.bottom_layers == 2);
    CHECK(header.pixels() == 16U * 8U);
    CHECK(header.print_time_s == 3600);
    CHECK(header.mirrored);
    CHECK(header.pwm == 255);
    CHECK(header.bottom_pwm == 255);
    CHECK(header.lift == Lift{6, 90, 150});
    CHECK(header.bottom_lift == Lift{8, 60, 150});
    CHECK(header.bottom_light_off_s == 2);
    CHECK(header.resin_ml == 12.5F);
    CHECK(header.resin_g == 13.75F);
    CHECK(header.cost == 0.5F);
    CHECK(header.anti_aliasing == 1);
    CHECK(header.slicer_version == 0x01060501);
    REQUIRE(header.large_preview);
    CHECK(header.large_preview->width == 40);
    CHECK(header.large_preview->height == 30);
}

TEST_CASE("sliced: the layer's record rules, then its block, then the header by bottom and normal layers") {
    ResinFile version_3 = wishes(Kind::ctb, 3, 0, 1);
    ResinFile version_2 = wishes(Kind::ctb, 2, 0, 1);
    const MadeResinFile with_block = make_resin_file(version_3);
    const MadeResinFile without = make_resin_file(version_2);
    const MemorySource block_source(with_block.bytes);
    const MemorySource source(without.bytes);
    const Outcome<SlicedFile> block_file = SlicedFile::open(block_source);
    const Outcome<SlicedFile> file = SlicedFile::open(source);
    REQUIRE(block_file);
    REQUIRE(file);
    for (std::uint32_t n = 0; n < 4; ++n) {
        const Outcome<Layer> layer = block_file->layer(block_source, n);
        REQUIRE_MESSAGE(layer, layer.problem());
        CHECK(layer->z_mm == 0.05F * static_cast<float>(n + 1));
        CHECK(layer->exposure_s == (n < 2 ? 60 : 8));
        CHECK(layer->light_off_s == 1);
        CHECK(layer->lift == Lift{6 + static_cast<float>(n), 90, 150});
        const Outcome<Layer> plain = file->layer(source, n);
        REQUIRE(plain);
        CHECK(plain->lift == (n < 2 ? Lift{8, 60, 150} : Lift{6, 90, 150}));
    }
    const Outcome<std::uint64_t> end = file->layer_end(source, 3);
    REQUIRE(end);
    CHECK(*end == without.bytes.size());

    const MadeResinFile first = make_resin_file(wishes(Kind::cbddlp, 1, 0, 1));
    const MemorySource first_source(first.bytes);
    const Outcome<SlicedFile> first_file = SlicedFile::open(first_source);
    REQUIRE(first_file);
    const Outcome<Layer> silent = first_file->layer(first_source, 0);
    REQUIRE(silent);
    CHECK_FALSE(silent->lift);
}

TEST_CASE("sliced: both previews, pixel by pixel") {
    const MadeResinFile made = make_resin_file({});
    const MemorySource source(made.bytes);
    const Outcome<SlicedFile> file = SlicedFile::open(source);
    REQUIRE(file);
    for (const auto* preview : {&file->header().large_preview, &file->header().small_preview}) {
        REQUIRE(*preview);
        const Picture picture = whole(Scanlines::of_preview(**preview, source));
        CHECK(picture.problem == "");
        REQUIRE(picture.values.size() == (*preview)->width * (*preview)->height);
        const std::uint32_t width = (*preview)->width;
        CHECK(picture.values[0] == 0);
        CHECK(picture.values[1] == 0x000008);          // blue 1 of 31
        CHECK(picture.values[19] == 0x00009C);         // blue 19
        CHECK(picture.values[width] == 0x000800);      // green 1
        CHECK(picture.values[9 * width] == 0x080800);  // red 1, green 1
    }
}

TEST_CASE("sliced: run lengths of every form, and a run over many rows") {
    ResinFile big = wishes(Kind::ctb, 2, 99, 1);
    big.width = 4000;
    big.height = 1000;
    big.layers = 5;
    const auto lit = std::to_array<std::uint32_t>({1, 127, 128, 16'383, 2'100'000});  // pixels from the start
    big.picture = [&](std::uint32_t n, std::uint32_t x, std::uint32_t y) {
        return static_cast<std::uint8_t>(y * 4000 + x < lit.at(n) ? 255 : 0);
    };
    const MadeResinFile made = make_resin_file(big);
    const MemorySource source(made.bytes);
    const Outcome<SlicedFile> file = SlicedFile::open(source);
    REQUIRE(file);
    for (std::uint32_t n = 0; n < big.layers; ++n) {
        const Outcome<Layer> layer = file->layer(source, n);
        REQUIRE(layer);
        PictureRuns runs = PictureRuns::of_layer(*file, source, n, *layer);
        Run run;
        REQUIRE(runs.next(run));
        CHECK(run.value == 255);
        CHECK(run.pixels == lit.at(n));
        REQUIRE(runs.next(run));
        CHECK(run.value == 0);
        CHECK(run.pixels == 4'000'000 - lit.at(n));
        CHECK_FALSE(runs.next(run));
        CHECK(runs.problem() == "");
    }
    CHECK(layer_picture(*file, source, 4).values == expected_picture(big, 4));
}

TEST_CASE("sliced: the cipher's first words, worked out apart") {
    // key 0x12345678, layer 3: step 0x547864c3, first word 0xceb6859c; by hand with Python's integers.
    std::string bytes(9, '\0');
    Cipher cipher(0x1234'5678, 3);
    cipher.apply(std::span(bytes).first(3));
    cipher.apply(std::span(bytes).subspan(3));
    CHECK(bytes == std::string("\x9C\x85\xB6\xCE\x5F\xEA\x2E\x23\x22", 9));
}

}  // namespace
}  // namespace fauxboard::sliced::test
