#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("merge: acts, is repeatable, ends, both ways") {
    check_edits("merge");
}

TEST_CASE("merge: two lines become one") {
    CHECK(spoiled("merge:every=2", "one\r\ntwo\r\nthree\r\nfour\nfive\n") == "one\r\ntwothree\r\nfourfive\n");
}

TEST_CASE("merge: the line end of a line that stalled is lost too") {
    LineRig rig;
    rig.add("merge:count=1");
    rig.push("half");
    CHECK(rig.pass(ms(100)) == "half");
    CHECK(rig.push(" a line\r\nnext\r\n") == " a linenext\r\n");
}
