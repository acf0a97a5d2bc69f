#include <doctest/doctest.h>

#include <map>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("delay: acts, is repeatable, ends, both ways") {
    check_paces("delay");
    check_paces("delay:time=50ms,jitter=300ms");
}

TEST_CASE("delay: a line comes exactly so much later, counted from its arrival") {
    LineRig rig;
    rig.add("delay:time=200ms");
    rig.push("one\n");
    rig.pass(ms(50));
    CHECK(rig.push("two\n").empty());
    CHECK(rig.pass(ms(149)).empty());
    CHECK(rig.line.advance(rig.now) == ms(200));
    CHECK(rig.pass(ms(1)) == "one\n");
    CHECK(rig.pass(ms(49)).empty());
    CHECK(rig.pass(ms(1)) == "two\n");
}

TEST_CASE("delay: two delays add up, even if the line is advanced late") {
    LineRig rig;
    rig.add("delay:time=200ms");
    rig.add("delay:time=300ms");
    rig.push("one\n");
    rig.now = ms(450);  // nobody called at 200 ms
    rig.line.push(rig.now, "two\n");
    CHECK(rig.line.output().empty());
    CHECK(rig.pass(ms(49)).empty());
    CHECK(rig.pass(ms(1)) == "one\n");
    CHECK(rig.pass(ms(449)).empty());
    CHECK(rig.pass(ms(1)) == "two\n");
}

TEST_CASE("delay: jitter keeps the order and stays within its bounds") {
    LineRig rig;
    rig.add("delay:time=100ms,jitter=100ms,seed=3");
    std::string in;
    std::string out;
    std::map<int, std::int64_t> arrived;
    bool in_bounds = true;
    for (int i = 0; i < 100; ++i) {
        const std::string line = std::to_string(i) + "\n";
        in += line;
        arrived[i] = rig.now.count();
        out += rig.push(line);
        for (int step = 0; step < 30; ++step) {
            const std::string came = rig.pass(ms(1));
            if (!came.empty()) {
                const std::int64_t late = rig.now.count() - arrived.at(std::stoi(came));
                in_bounds = in_bounds && late >= 100'000 && late <= 201'000;
            }
            out += came;
        }
    }
    CHECK(in_bounds);
    out += rig.pass(ms(1000));
    CHECK(out == in);
}

TEST_CASE("delay: of every n-th line only, and what is behind waits") {
    LineRig rig;
    rig.add("delay:every=2,time=1s");
    CHECK(rig.push("one\ntwo\nthree\n") == "one\n");
    CHECK(rig.pass(ms(999)).empty());
    CHECK(rig.pass(ms(1)) == "two\nthree\n");
}

TEST_CASE("delay: changed or removed, what it held goes on at once and in order") {
    LineRig rig;
    const FaultId id = rig.add("delay:time=10s");
    rig.push("one\n");
    CHECK(rig.line.change(rig.now, id, fault_from_text("delay:time=1s")));
    CHECK(rig.pass(SimTime{0}) == "one\n");
    rig.push("two\n");
    rig.pass(ms(500));
    CHECK(rig.line.remove(rig.now, id));
    CHECK(rig.pass(SimTime{0}) == "two\n");
}
