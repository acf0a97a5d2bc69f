// `fauxboard sliced`, the real program: what it tells, the pictures that it writes, its mistakes.

#include <png.h>

#include <cstdio>
#include <fstream>

#include "tests/e2e/program.h"
#include "tests/support/resin_file.h"

namespace fauxboard::e2e {
namespace {

using testing::ResinFile;

std::string put(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder.file(name), std::ios::binary) << bytes;
    return folder.file(name);
}

/// A PNG's bytes, one or three a pixel; empty when it is none.
struct Png {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<unsigned char> bytes;

    Png(const std::string& path, std::uint32_t format) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
            return;
        }
        image.format = format;
        bytes.resize(PNG_IMAGE_SIZE(image));
        REQUIRE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) != 0);
        width = image.width;
        height = image.height;
    }
};

TEST_CASE("sliced: what is in a file, for people and for programs") {
    const TemporaryFolder folder;
    ResinFile wishes;
    wishes.key = 0xABCD;
    const auto made = testing::make_resin_file(wishes);
    const std::string file = put(folder, "box.ctb", made.bytes);

    const Result text = run({"sliced", file});
    CHECK(text.code == 0);
    for (const char* part : {"ctb, version 3", "16 x 8 pixels, mirrored", "4 of 0.05 mm", "Made-up LCD",
                             "1.6.5.1", "6 mm at 90 mm/min, back at 150 mm/min", "1:00:00", "key 0x0000ABCD",
                             "large 40 x 30, small 20 x 13", "All 4 layers are whole"}) {
        CAPTURE(std::string(part));
        CHECK(contains(text.out, part));
    }

    const Result json = run({"sliced", "--json", file});
    CHECK(json.code == 0);
    std::istringstream lines(json.out);
    std::string line;
    REQUIRE(std::getline(lines, line));
    const auto header = nlohmann::json::parse(line);
    CHECK(header["layers"] == 4);
    CHECK(header["bytes"] == made.bytes.size());
    for (std::size_t n = 0; n < made.layer_ends.size(); ++n) {
        REQUIRE(std::getline(lines, line));
        const auto layer = nlohmann::json::parse(line);
        CHECK(layer["layer"] == n);
        CHECK(layer["end"] == made.layer_ends[n]);
        CHECK(layer["lift"]["mm"] == 6 + n);
    }
    CHECK_FALSE(std::getline(lines, line));
}

TEST_CASE("sliced: a layer and a preview as PNG, pixel by pixel") {
    const TemporaryFolder folder;
    ResinFile wishes;
    wishes.kind = ResinFile::Kind::cbddlp;
    wishes.version = 2;
    wishes.level_sets = 3;
    const std::string file = put(folder, "box.photon", testing::make_resin_file(wishes).bytes);
    const std::string out = folder.file("out.png");

    CHECK(contains(run({"sliced", file, "--layer", "2", "--png", out}).out, "16 x 8 pixels"));
    const Png layer(out, PNG_FORMAT_GRAY);
    REQUIRE(layer.bytes.size() == 16 * 8);
    for (std::uint32_t i = 0; i < layer.bytes.size(); ++i) {
        CHECK(layer.bytes[i] == ResinFile::box(2, i % 16, i / 16));
    }

    const Result json = run({"sliced", file, "--preview", "small", "--png", out, "--json"});
    CHECK(nlohmann::json::parse(json.out)["width"] == 20);
    const Png preview(out, PNG_FORMAT_RGB);
    REQUIRE(preview.bytes.size() == 20 * 13 * 3);
    CHECK(preview.bytes[19 * 3 + 2] == 0x9C);
    CHECK(preview.bytes[20 * 3 + 1] == 0x08);
    CHECK(run({"sliced", file, "--preview", "large", "--png", out}).code == 0);
}

TEST_CASE("sliced: each mistake has its exit code and its sentence") {
    const TemporaryFolder folder;
    ResinFile wishes;
    wishes.previews = false;
    auto made = testing::make_resin_file(wishes);
    const std::string whole = put(folder, "whole.ctb", made.bytes);
    testing::poke(made.bytes, made.layer_table + 36 + 0x10, 1U);
    const std::string wrong = put(folder, "wrong.ctb", made.bytes);
    const std::string out = folder.file("out.png");
    check_mistakes({
        {{"sliced"}, usage, "FILE"},
        {{"sliced", whole, "--layer", "0"}, usage, "--png"},
        {{"sliced", whole, "--png", out}, usage, "--layer or --preview"},
        {{"sliced", whole, "--preview", "huge", "--png", out}, usage, "large"},
        {{"sliced", whole, "--preview", "large", "--layer", "0", "--png", out}, usage, "excludes"},
        {{"sliced", "/missing.ctb"}, bad_input, "/missing.ctb cannot be read"},
        {{"sliced", "/dev/null"}, bad_input, "no file"},
        {{"sliced", "/etc/passwd"}, bad_input, "The file begins with"},
        {{"sliced", whole, "--layer", "4", "--png", out}, bad_input, "There is no layer 4"},
        {{"sliced", whole, "--preview", "large", "--png", out}, bad_input, "no large preview"},
        {{"sliced", whole, "--layer", "0", "--png", "/missing/out.png"}, bad_input, "cannot be written"},
        {{"sliced", wrong, "--layer", "1", "--png", out}, bad_input, "its last run is cut off"},
    });
    CHECK_FALSE(std::filesystem::exists(out));
    const Result told = run({"sliced", wrong});
    CHECK(told.code == bad_input);
    CHECK(contains(told.errors, "Layer 1: "));
}

}  // namespace
}  // namespace fauxboard::e2e
