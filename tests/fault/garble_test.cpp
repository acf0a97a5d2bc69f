#include <doctest/doctest.h>

#include <bit>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

namespace {

const std::string line = "N-0 L1 X1.00 Y2.00*12\r\n";

int changed_bits(const std::string& a, const std::string& b) {
    int bits = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        bits += std::popcount(static_cast<unsigned>(static_cast<unsigned char>(a[i] ^ b[i])));
    }
    return bits;
}

std::size_t changed_bytes(const std::string& a, const std::string& b) {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        bytes += a[i] != b[i] ? 1U : 0U;
    }
    return bytes;
}

}  // namespace

TEST_CASE("garble: acts, is repeatable, ends, both ways") {
    check_edits("garble");
    check_edits("garble:bits=3");
    check_edits("garble:bytes=2");
}

TEST_CASE("garble: exactly so many bits or bytes, and never the line end") {
    for (int seed = 0; seed < 200; ++seed) {
        const std::string more = ",seed=" + std::to_string(seed);
        for (const auto& [spec, bits] : {std::pair{"garble:count=1", 1}, std::pair{"garble:bits=5", 5}}) {
            const std::string out = spoiled(spec + more, line);
            REQUIRE(out.size() == line.size());
            CHECK(changed_bits(line, out) == bits);
            CHECK(out.ends_with("\r\n"));
        }
        CHECK(changed_bytes(line, spoiled("garble:bytes=4" + more, line)) == 4);
    }
}

TEST_CASE("garble: more than there is changes all of it") {
    CHECK(changed_bits("ab\n", spoiled("garble:bits=64", "ab\n")) == 16);
    CHECK(changed_bytes("ab\n", spoiled("garble:bytes=64", "ab\n")) == 2);
}

TEST_CASE("garble: the two directions are not spoiled alike") {
    CHECK(spoiled("garble:seed=7,bytes=3", line, Direction::to_screen) !=
          spoiled("garble:seed=7,bytes=3", line, Direction::to_board));
}
