#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("drop: acts, is repeatable, ends, both ways") {
    check_edits("drop");
}

TEST_CASE("drop: the line goes with its line end, the others stay as they are") {
    CHECK(spoiled("drop:every=2", "one\r\ntwo\r\nthree\nfour\rfive\r\n") == "one\r\nthree\nfive\r\n");
    CHECK(spoiled("drop:after=2", "one\ntwo\nthree\nfour\n") == "one\ntwo\n");
    CHECK(spoiled("drop:count=1", "one\ntwo\n") == "two\n");
}

TEST_CASE("drop: line ends and NULs between lines are no lines") {
    CHECK(spoiled("drop:every=2", std::string_view("one\r\n\0\r\n\ntwo\r\nthree\r\n", 21)) ==
          std::string_view("one\r\n\0\r\n\nthree\r\n", 16));
}

TEST_CASE("drop: a line that stalled is lost with all that still comes of it") {
    LineRig rig;
    rig.add("drop:count=1");
    CHECK(rig.push("a line that").empty());
    CHECK(rig.pass(ms(150)).empty());
    CHECK(rig.status().acted == 1);
    CHECK(rig.push(" stalls").empty());
    CHECK(rig.push(" long\r\nnext\r\n") == "next\r\n");
}
