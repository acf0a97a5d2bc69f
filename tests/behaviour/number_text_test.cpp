#include "emulator/behaviour/number_text.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "protocol/framing.h"

using fauxboard::behaviour::write_fixed;

namespace {

std::string written(double value, int decimals) {
    std::array<char, 64> out{};
    const auto number = write_fixed(out, value, decimals);
    const std::string text(out.data(), number.size);
    CHECK(number.sum == fauxboard::protocol::xor_checksum(text));
    return text;
}

std::string expected(double value, int decimals) {
    std::array<char, 400> out{};
    std::snprintf(out.data(), out.size(), "%.*f", decimals, value);
    return out.data();
}

void check(double value) {
    for (int decimals = 0; decimals <= 6; ++decimals) {
        CAPTURE(decimals);
        REQUIRE(written(value, decimals) == expected(value, decimals));
    }
}

}  // namespace

TEST_CASE("numbers: as C's printf writes them, for 100 000 random values") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> small(-1000, 1000);
    std::uniform_real_distribution<double> exponent(-9, 14.9);
    for (int i = 0; i < 50000; ++i) {
        check(small(random));
        const double any = std::pow(10, exponent(random));
        check(random() % 2 == 0 ? any : -any);
    }
}

TEST_CASE("numbers: ties and their neighbours are rounded from the exact value") {
    for (int i = -4000; i <= 4000; ++i) {
        const double tie = i / 16.0 + 0.03125;  // exact in binary
        check(tie);
        check(std::nextafter(tie, 1e9));
        check(std::nextafter(tie, -1e9));
        check(i / 1000.0 + 0.0005);  // not exact: above or below the tie
        check(i / 100.0 + 0.005);
        check(i + 0.5);
    }
}

TEST_CASE("numbers: zeros keep their sign, as printf's do") {
    check(0.0);
    check(-0.0);
    check(-0.001);
    check(0.0004999);
    check(-1e-300);
    check(std::numeric_limits<double>::denorm_min());
}

TEST_CASE("numbers: what is no number is 0, what is too large is the bound") {
    CHECK(written(std::nan(""), 2) == "0.00");
    CHECK(written(std::numeric_limits<double>::infinity(), 1) == "0.0");
    CHECK(written(1e30, 0) == "1000000000000000");
    CHECK(written(-1e30, 3) == "-1000000000000000.000");
    CHECK(written(1.23456789, 9) == "1.234568");  // at most six decimals
    CHECK(written(1.5, -3) == "2");
}

TEST_CASE("numbers: nothing is written where there is no room") {
    for (std::size_t room = 0; room <= 8; ++room) {
        std::array<char, 8> out;
        out.fill('#');
        const std::size_t size = write_fixed(std::span<char>(out).first(room), -123.45, 2).size;
        CHECK(size == (room >= 7 ? 7 : 0));
        for (std::size_t i = size; i < out.size(); ++i) {
            CHECK(out[i] == '#');
        }
    }
}
