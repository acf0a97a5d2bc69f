#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("stray_ok: acts, is repeatable, ends, both ways") {
    check_edits("stray_ok");
    check_edits("stray_ok:number=160,where=after");
}

TEST_CASE("stray_ok: an acknowledgement of its own line, where it is wanted") {
    CHECK(spoiled("stray_ok:every=2", "one\r\ntwo\r\n") == "one\r\nok N:0\r\ntwo\r\n");
    CHECK(spoiled("stray_ok:number=80,where=after", "ok 'a.ctb'\r\n") == "ok 'a.ctb'\r\nok N:80\r\n");
}

TEST_CASE("stray_ok: half a line is let be") {
    LineRig rig;
    rig.add("stray_ok");
    CHECK(rig.push("half").empty());
    CHECK(rig.pass(ms(100)) == "half");
}

TEST_CASE("stray_ok: faults in a row cannot blow up a line without bound") {
    LineRig rig;
    for (std::size_t i = 0; i < FaultLine::most_faults; ++i) {
        rig.add("stray_ok");
    }
    const std::string out = rig.push("a\n");
    CHECK(out.size() > 8);
    CHECK(out.size() <= 2 + FaultLine::most_growth);
}
