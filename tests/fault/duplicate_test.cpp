#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("duplicate: acts, is repeatable, ends, both ways") {
    check_edits("duplicate");
}

TEST_CASE("duplicate: the line and its copies, each with its line end") {
    CHECK(spoiled("duplicate:every=2", "one\r\ntwo\r\n") == "one\r\ntwo\r\ntwo\r\n");
    CHECK(spoiled("duplicate:copies=3", "a\n") == "a\na\na\na\n");
}

TEST_CASE("duplicate: later faults take each copy for a line") {
    LineRig rig;
    rig.add("duplicate");
    rig.add("drop:every=3");
    CHECK(rig.push("one\ntwo\nthree\n") == "one\none\ntwo\nthree\n");
}

TEST_CASE("duplicate: faults in a row cannot blow up a line without bound") {
    LineRig rig;
    for (std::size_t i = 0; i < FaultLine::most_faults; ++i) {
        rig.add("duplicate:copies=10");
    }
    const std::string out = rig.push("a\n");
    CHECK(out.size() > 100);
    CHECK(out.size() <= 2 + FaultLine::most_growth);
}

TEST_CASE("duplicate: half a line is not doubled") {
    LineRig rig;
    rig.add("duplicate");
    CHECK(rig.push("half").empty());
    CHECK(rig.pass(ms(100)) == "half");
    CHECK(rig.push(" a line\n") == " a line\n");
    CHECK(rig.status().seen == 0);
}
