#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("slow: acts, is repeatable, ends, both ways") {
    check_paces("slow:rate=5kB/s");
    check_paces("slow:rate=120B/s");
}

TEST_CASE("slow: the bytes trickle at the rate") {
    LineRig rig;
    rig.add("slow:rate=10B/s");
    CHECK(rig.push("0123\n56789\n").empty());
    CHECK(rig.pass(ms(99)).empty());
    CHECK(rig.pass(ms(1)) == "0");
    CHECK(rig.pass(ms(300)) == "123");
    CHECK(rig.pass(ms(600)) == "\n56789");
    CHECK(rig.pass(ms(100)) == "\n");
    rig.pass(ms(5000));
    CHECK(rig.push("a\n").empty());
    CHECK(rig.pass(ms(100)) == "a");
}

TEST_CASE("slow: at high rates it wants to be called every 5 ms, not for each byte") {
    LineRig rig;
    rig.add("slow:rate=10kB/s");
    rig.push(std::string(999, 'x') + "\n");
    int calls = 0;
    for (SimTime next = rig.line.advance(rig.now); next != fauxboard::machine::never;
         next = rig.line.advance(next)) {
        rig.now = next;
        ++calls;
    }
    CHECK(rig.now == ms(100));
    CHECK(calls == 20);
    CHECK(rig.line.output().size() == 1000);
}

TEST_CASE("slow: too much for it is lost and counted, and the line lives on") {
    LineRig rig;
    rig.add("slow:rate=1B/s");
    for (int i = 0; i < 100; ++i) {
        rig.push(std::string(999, 'x') + "\n");
    }
    CHECK(rig.line.held() == FaultLine::most_held);
    CHECK(rig.line.bytes_overflowed() == 100'000 - FaultLine::most_held);
    rig.line.clear(rig.now);
    CHECK(rig.pass(SimTime{0}).size() == FaultLine::most_held);
    CHECK(rig.push("on\n") == "on\n");
}

TEST_CASE("slow: a delay behind it counts from when the bytes came through") {
    LineRig rig;
    rig.add("slow:rate=10B/s");
    rig.add("delay:time=1s");
    rig.push("ab\n");
    CHECK(rig.pass(ms(1099)).empty());
    CHECK(rig.pass(ms(1)) == "a");
    CHECK(rig.pass(ms(200)) == "b\n");
}
