#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;
using namespace std::string_literals;

TEST_CASE("nul_burst: acts, is repeatable, ends, both ways") {
    check_edits("nul_burst");
    check_edits("nul_burst:bytes=100,where=inside");
    check_edits("nul_burst:where=after");
}

TEST_CASE("nul_burst: so many NULs, where they are wanted") {
    CHECK(spoiled("nul_burst:bytes=3,every=2", "one\r\ntwo\r\n") == "one\r\n\0\0\0two\r\n"s);
    CHECK(spoiled("nul_burst:bytes=3,where=after", "one\r\n") == "one\r\n\0\0\0"s);
    for (int seed = 0; seed < 50; ++seed) {
        std::string out = spoiled("nul_burst:bytes=3,where=inside,seed=" + std::to_string(seed), "one\r\n");
        const std::size_t at = out.find("\0\0\0"s);
        REQUIRE(at < 3);
        CHECK(out.erase(at, 3) == "one\r\n");
    }
}
