#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("cut: acts, is repeatable, ends, both ways") {
    check_edits("cut");
    check_edits("cut:line_end=lost");
    check_edits("cut:bytes=5");
}

TEST_CASE("cut: the last bytes are lost, the line end stays or goes with them") {
    CHECK(spoiled("cut:bytes=2,every=2", "one\r\nthree\r\nfive\r\n") == "one\r\nthr\r\nfive\r\n");
    CHECK(spoiled("cut:bytes=2,line_end=lost,count=1", "three\r\nfive\n") == "thrfive\n");
    CHECK(spoiled("cut:bytes=9", "three\r\nfive\n") == "\r\n\n");
}

TEST_CASE("cut: without a number it is a random one, at least one") {
    bool whole_line = false;
    for (int seed = 0; seed < 100; ++seed) {
        const std::string out = spoiled("cut:seed=" + std::to_string(seed), "three\r\n");
        CHECK(std::string_view("three").starts_with(out.substr(0, out.size() - 2)));
        CHECK(out.size() < 7);
        CHECK(out.ends_with("\r\n"));
        whole_line = whole_line || out == "\r\n";
    }
    CHECK(whole_line);
}

TEST_CASE("cut: of a line that stalled the rest is lost, not its line end") {
    LineRig rig;
    rig.add("cut:bytes=1,count=1");
    rig.push("half");
    CHECK(rig.pass(ms(100)) == "hal");
    CHECK(rig.push(" a line\r\nnext\r\n") == "\r\nnext\r\n");
}
