#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("silence: acts, is repeatable, ends, both ways") {
    check_interrupts("silence");
}

TEST_CASE("silence: without a rule it begins when it is added, once") {
    LineRig rig;
    rig.pass(ms(700));
    rig.add("silence:for=2s");
    CHECK(rig.status().acted == 1);
    CHECK(rig.push("lost\n").empty());
    rig.pass(ms(1999));
    CHECK(rig.push("lost\n").empty());
    rig.pass(ms(1));
    CHECK(rig.push("back\n") == "back\n");
    CHECK(rig.line.bytes_lost() == 10);
}

TEST_CASE("silence: bytes are lost, not lines") {
    LineRig rig;
    rig.add("silence:at=1s,for=1s");
    rig.pass(ms(900));
    CHECK(rig.push("N-0 L1 ") == "N-0 L1 ");
    rig.pass(ms(200));
    CHECK(rig.push("X0*1\r\nN-0 L2").empty());
    rig.pass(ms(900));
    CHECK(rig.push(" P0*3\r\n") == " P0*3\r\n");
}

TEST_CASE("silence: on every n-th line, which is the first to be lost") {
    LineRig rig;
    rig.add("silence:every=3,for=100ms");
    CHECK(rig.push("one\ntwo\nthree\nfour\n") == "one\ntwo\n");
    rig.pass(ms(100));
    CHECK(rig.push("five\nsix\nseven\n") == "five\nsix\n");
    CHECK(rig.status().seen == 6);
    CHECK(rig.status().acted == 2);
}

TEST_CASE("silence: one direction only") {
    Faults faults;
    faults.add(SimTime{0}, fault_from_text("silence:to_screen,for=1s"));
    faults.to_screen().push(SimTime{0}, "lost\n");
    faults.to_board().push(SimTime{0}, "passes\n");
    CHECK(faults.to_screen().output().empty());
    CHECK(faults.to_board().output() == "passes\n");
    CHECK(faults.connected(SimTime{0}));
}
