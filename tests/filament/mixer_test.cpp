#include "emulator/filament/mixer.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace fauxboard::filament;

namespace {

int sum(const Ratio& r) {
    return r[0] + r[1] + r[2];
}

bool sound(const Ratio& r) {
    return sum(r) == 100 && r[0] >= 0 && r[1] >= 0 && r[2] >= 0;
}

}  // namespace

TEST_CASE("mixer: packed ratios are A + 256 B + 65536 C") {
    CHECK(pack({100, 0, 0}) == 100);
    CHECK(pack({0, 100, 0}) == 25600);
    CHECK(pack({0, 0, 100}) == 6553600);
    CHECK(pack({34, 33, 33}) == 34 + 33 * 256 + 33 * 65536);
}

TEST_CASE("mixer: every ratio of whole percents survives packing and unpacking") {
    int count = 0;
    for (int a = 0; a <= 100; ++a) {
        for (int b = 0; a + b <= 100; ++b) {
            const Ratio ratio{a, b, 100 - a - b};
            Ratio back{};
            REQUIRE(unpack(pack(ratio), back));
            REQUIRE(back == ratio);
            ++count;
        }
    }
    CHECK(count == 5151);
}

TEST_CASE("mixer: what is no packed ratio is refused and leaves the target alone") {
    for (const double wrong : {-1.0, 0.0, 99.0, 101.0, 100.5, 16777216.0, 1e30, std::nan(""),
                               std::numeric_limits<double>::infinity(), 25601.0, 255.0}) {
        CAPTURE(wrong);
        Ratio ratio{1, 2, 3};
        CHECK_FALSE(unpack(wrong, ratio));
        CHECK(ratio == Ratio{1, 2, 3});
    }
}

TEST_CASE("mixer: weights of any scale become percents that add up to 100") {
    Mixer mixer;
    const auto weights = [&](double a, double b, double c) {
        CHECK(mixer.set_weights(a, b, c));
        return mixer.ratio();
    };
    CHECK(weights(1, 0, 0) == Ratio{100, 0, 0});
    CHECK(weights(0, 0.001, 0) == Ratio{0, 100, 0});
    CHECK(weights(1, 1, 1) == Ratio{34, 33, 33});
    CHECK(weights(2, 1, 1) == Ratio{50, 25, 25});
    CHECK(weights(1, 2, 3) == Ratio{17, 33, 50});
    CHECK(weights(-5, 1, 1) == Ratio{0, 50, 50});
    CHECK(weights(std::nan(""), 1, 0) == Ratio{0, 100, 0});
    CHECK(weights(1e30, 1e30, 0) == Ratio{50, 50, 0});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0, 10);
    for (int i = 0; i < 10000; ++i) {
        REQUIRE(sound(weights(any(random), any(random), any(random))));
    }
}

TEST_CASE("mixer: weights of which none is positive change nothing") {
    Mixer mixer;
    mixer.set_weights(0, 1, 0);
    CHECK_FALSE(mixer.set_weights(0, 0, 0));
    CHECK_FALSE(mixer.set_weights(-1, -2, std::nan("")));
    CHECK(mixer.ratio() == Ratio{0, 100, 0});
}

TEST_CASE("mixer: a share leaves the others their proportion") {
    Mixer mixer;
    mixer.set_packed(pack({60, 20, 20}));
    CHECK(mixer.set_share(0, 20));
    CHECK(mixer.ratio() == Ratio{20, 40, 40});
    CHECK(mixer.set_share(1, 100));
    CHECK(mixer.ratio() == Ratio{0, 100, 0});
    CHECK(mixer.set_share(1, 40));  // nothing to keep in proportion: the last channel takes the rest
    CHECK(mixer.ratio() == Ratio{0, 40, 60});
    mixer.set_packed(100);
    CHECK(mixer.set_share(0, 40));
    CHECK(mixer.ratio() == Ratio{40, 0, 60});
    mixer.set_packed(6553600);
    CHECK(mixer.set_share(2, 40));
    CHECK(mixer.ratio() == Ratio{0, 60, 40});
}

TEST_CASE("mixer: shares always add up, wrong ones are refused") {
    Mixer mixer;
    std::mt19937 random(2);
    for (int i = 0; i < 10000; ++i) {
        mixer.set_share(static_cast<int>(random() % 3), static_cast<double>(random() % 1001) / 10);
        REQUIRE(sound(mixer.ratio()));
    }
    const Ratio before = mixer.ratio();
    for (const double wrong : {-0.1, 100.1, 1e30, std::nan("")}) {
        CHECK_FALSE(mixer.set_share(0, wrong));
    }
    CHECK_FALSE(mixer.set_share(-1, 50));
    CHECK_FALSE(mixer.set_share(3, 50));
    CHECK(mixer.ratio() == before);
}

TEST_CASE("mixer: tools have ratios of their own, T3 is the free one") {
    Mixer mixer;
    CHECK(mixer.select_tool(1));
    CHECK(mixer.ratio() == Ratio{0, 100, 0});
    mixer.set_packed(pack({10, 20, 70}));
    CHECK(mixer.select_tool(0));
    CHECK(mixer.ratio() == Ratio{100, 0, 0});
    CHECK(mixer.select_tool(3));
    CHECK(mixer.ratio() == Ratio{10, 20, 70});
    CHECK(mixer.select_tool(1));
    CHECK(mixer.ratio() == Ratio{0, 100, 0});
    CHECK_FALSE(mixer.select_tool(4));
    CHECK_FALSE(mixer.select_tool(-1));
    CHECK(mixer.tool() == 1);
}

TEST_CASE("mixer: the fixed templates, over 2, 10, 20 and 50 mm, from all of one tool to none of it") {
    constexpr std::array<double, 4> heights{2, 10, 20, 50};
    for (int number = 1; number <= 8; ++number) {
        CAPTURE(number);
        Mixer mixer;
        mixer.set_start_height(3);
        CHECK(mixer.select_template(number));
        CHECK(mixer.start() == (number % 2 == 1 ? Ratio{100, 0, 0} : Ratio{0, 100, 0}));
        CHECK(mixer.end() == (number % 2 == 1 ? Ratio{0, 100, 0} : Ratio{100, 0, 0}));
        CHECK(mixer.start_height_mm() == 0);
        CHECK(mixer.end_height_mm() == heights[static_cast<std::size_t>((number - 1) / 2)]);
        CHECK(mixer.template_number() == number);
    }
}

TEST_CASE("mixer: custom templates keep what was said; others do not exist") {
    for (int number = 9; number <= 14; ++number) {
        Mixer mixer;
        mixer.set_start(25600);
        mixer.set_end_height(7);
        CHECK(mixer.select_template(number));
        CHECK(pack(mixer.start()) == 25600);
        CHECK(mixer.end_height_mm() == 7);
    }
    Mixer mixer;
    for (const int wrong : {-1, 0, 15, 1000}) {
        CHECK_FALSE(mixer.select_template(wrong));
    }
    CHECK(mixer.template_number() == 0);
}

TEST_CASE("mixer: heights and modes within their bounds") {
    Mixer mixer;
    CHECK(mixer.set_end_height(1000));
    for (const double wrong : {-0.01, 1000.01, std::nan(""), std::numeric_limits<double>::infinity()}) {
        CHECK_FALSE(mixer.set_end_height(wrong));
        CHECK_FALSE(mixer.set_start_height(wrong));
    }
    CHECK(mixer.end_height_mm() == 1000);
    CHECK(mixer.start_height_mm() == 0);
    CHECK(mixer.set_mode(3));
    CHECK_FALSE(mixer.set_mode(4));
    CHECK_FALSE(mixer.set_mode(-1));
    CHECK(mixer.mode() == 3);
    mixer.power_on();
    CHECK(mixer.mode() == 0);
    CHECK(mixer.end_height_mm() == 0);
}
