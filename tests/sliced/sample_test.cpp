// The small file made for who has none: the reader takes it, and it is what was wished for.

#include "emulator/sliced/sample.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "emulator/sliced/scanlines.h"
#include "tests/support/resin_file.h"

using namespace fauxboard;
using namespace fauxboard::sliced;

/// Full pixels of a layer that must be whole.
static std::size_t lit_in(const SlicedFile& file, const ByteSource& source, std::uint32_t layer) {
    auto lines = Scanlines::of_layer(file, source, layer);
    REQUIRE(lines);
    std::vector<std::uint32_t> row(lines->width());
    std::size_t lit = 0;
    while (lines->next(row)) {
        lit += static_cast<std::size_t>(std::count(row.begin(), row.end(), 255U));
    }
    CHECK(lines->problem() == "");
    return lit;
}

TEST_CASE("sample: the reader finds header and layers as they were wished for") {
    Sample wishes;
    wishes.layers = 7;
    wishes.exposure_s = 1.5F;
    const std::string bytes = make_sample(wishes);
    const fauxboard::testing::MemorySource source(bytes);
    const auto file = SlicedFile::open(source);
    REQUIRE(file);
    CHECK(file->header().format == Format::cbddlp);
    CHECK(file->header().layers == 7);
    CHECK(file->header().pwm == 255);
    CHECK(file->header().bottom_pwm == 255);
    std::set<std::uint64_t> ends;
    for (std::uint32_t n = 0; n < 7; ++n) {
        const auto layer = file->layer(source, n);
        REQUIRE(layer);
        CHECK(layer->exposure_s == 1.5F);
        CHECK(layer->z_mm == doctest::Approx(0.05 * (n + 1)));
        REQUIRE(layer->lift.has_value());
        CHECK(layer->lift->mm == 5);
        ends.insert(layer->end());
    }
    CHECK(ends.size() == 7);
    CHECK(*ends.rbegin() == bytes.size());
    CHECK_FALSE(file->layer(source, 7));
    CHECK(lit_in(*file, source, 3) == 24 * 8);
}

TEST_CASE("sample: layers are bounded, and small") {
    CHECK(make_sample({0, 2}) == make_sample({1, 2}));
    CHECK(make_sample({Sample::most_layers + 5, 2}).size() == make_sample({Sample::most_layers, 2}).size());
    CHECK(make_sample({Sample::most_layers, 2}).size() < 1'000'000);
}

TEST_CASE("sample: on an LCD of the wished size") {
    Sample wishes;
    wishes.layers = 2;
    wishes.width = 1440;
    wishes.height = 2560;
    const std::string bytes = make_sample(wishes);
    const fauxboard::testing::MemorySource source(bytes);
    const auto file = SlicedFile::open(source);
    REQUIRE(file);
    CHECK(file->header().width == 1440);
    CHECK(lit_in(*file, source, 1) == 1432U * 2552U);
}
