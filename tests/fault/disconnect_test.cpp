#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;
using fauxboard::machine::never;

TEST_CASE("disconnect: acts, is repeatable, ends, both ways") {
    check_interrupts("disconnect");
}

TEST_CASE("disconnect: the owner is told when the link goes and comes back") {
    Faults faults;
    faults.add(SimTime{0}, fault_from_text("disconnect:at=10s,for=2s"));
    CHECK(faults.advance(SimTime{0}) == ms(10'000));
    CHECK(faults.connected(SimTime{0}));
    CHECK(faults.advance(ms(10'000)) == ms(12'000));
    CHECK_FALSE(faults.connected(ms(10'000)));
    CHECK(faults.advance(ms(12'000)) == never);
    CHECK(faults.connected(ms(12'000)));
}

TEST_CASE("disconnect: of both directions by time alone it is one event, and a full one when moved to one") {
    Faults faults;
    const FaultId id = faults.add(SimTime{0}, fault_from_text("disconnect:at=1s"));
    faults.advance(ms(1000));
    for (FaultLine* line : {&faults.to_screen(), &faults.to_board()}) {
        line->push(ms(1500), "lost\n");
        CHECK(line->output().empty());
        CHECK(line->bytes_lost() == 5);
    }
    CHECK(faults.list(ms(1500)).at(0).acted == 1);
    CHECK_FALSE(faults.list(ms(1500)).at(0).over);
    CHECK(faults.list(ms(3000)).at(0).over);
    CHECK(faults.change(ms(3000), id, fault_from_text("disconnect:to_board")));
    CHECK_FALSE(faults.connected(ms(3000)));
    CHECK(faults.list(ms(3000)).at(0).acted == 1);
}

TEST_CASE("disconnect: a line of either direction takes the link away from both") {
    for (const bool screen : {true, false}) {
        Faults faults;
        faults.add(SimTime{0}, fault_from_text(screen ? "disconnect:to_screen,after=1,count=1"
                                                      : "disconnect:to_board,after=1,count=1"));
        FaultLine& one = screen ? faults.to_screen() : faults.to_board();
        FaultLine& other = screen ? faults.to_board() : faults.to_screen();
        one.push(ms(5), "one\ntwo\n");
        CHECK(one.output() == "one\n");
        CHECK_FALSE(faults.connected(ms(5)));
        other.push(ms(5), "lost\n");
        CHECK(other.output().empty());
        CHECK(other.bytes_lost() == 5);
        CHECK(faults.advance(ms(5)) == ms(2005));
        faults.advance(ms(2005));
        CHECK(faults.connected(ms(2005)));
        one.push(ms(2005), "three\n");
        other.push(ms(2005), "four");
        CHECK(one.output() == "one\nthree\n");
        CHECK(other.output() == "four");
    }
}

TEST_CASE("disconnect: what is under way when the link goes is lost") {
    Faults faults;
    faults.add(SimTime{0}, fault_from_text("delay:to_screen,time=1s"));
    faults.add(SimTime{0}, fault_from_text("disconnect:to_board,at=900ms,for=200ms"));
    faults.to_screen().push(SimTime{0}, "lost\n");
    faults.to_screen().push(ms(500), "late\n");
    faults.advance(ms(3000));
    CHECK(faults.to_screen().output() == "late\n");
    CHECK(faults.to_screen().bytes_lost() == 5);
}

TEST_CASE(
    "disconnect: what came before the line that brings it is through, also when other faults shaped it") {
    for (const char* first : {"duplicate", "delay:time=0s"}) {
        for (const std::size_t chunk : {1UL, 3UL, 100UL}) {
            LineRig rig;
            rig.add(first);
            rig.add("disconnect:every=3,for=1s");
            const bool twice = std::string_view(first) == "duplicate";
            CHECK(rig.push("one\ntwo\nthree\n", chunk) == (twice ? "one\none\ntwo\ntwo\n" : "one\ntwo\n"));
        }
    }
}

TEST_CASE("disconnect: cleared or removed, the link is back at once") {
    Faults faults;
    const FaultId id = faults.add(SimTime{0}, fault_from_text("disconnect:for=1h"));
    CHECK_FALSE(faults.connected(ms(1)));
    CHECK(faults.remove(ms(1), id));
    CHECK(faults.connected(ms(1)));
    faults.add(ms(2), fault_from_text("disconnect:for=1h"));
    CHECK_FALSE(faults.connected(ms(3)));
    faults.clear(ms(3));
    CHECK(faults.connected(ms(3)));
}
