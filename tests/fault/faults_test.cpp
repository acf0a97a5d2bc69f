#include <doctest/doctest.h>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

TEST_CASE("a fault works in the direction it is for") {
    Faults faults;
    faults.add(SimTime{0}, fault_from_text("drop:to_screen"));
    faults.add(SimTime{0}, fault_from_text("duplicate:to_board"));
    faults.to_screen().push(SimTime{0}, "lost\n");
    faults.to_board().push(SimTime{0}, "twice\n");
    CHECK(faults.to_screen().output().empty());
    CHECK(faults.to_board().output() == "twice\ntwice\n");
}

TEST_CASE("a fault of both directions has one id, and its counters are added up") {
    Faults faults;
    const FaultId first = faults.add(SimTime{0}, fault_from_text("drop:to_board,probability=0"));
    const FaultId second = faults.add(SimTime{0}, fault_from_text("drop:count=2"));
    CHECK(first == 1);
    CHECK(second == 2);
    faults.to_screen().push(SimTime{0}, "a\nb\nc\n");
    faults.to_board().push(SimTime{0}, "a\n");
    const auto list = faults.list(SimTime{0});
    REQUIRE(list.size() == 2);
    CHECK(list[0].id == 1);
    CHECK(list[0].seen == 1);
    CHECK(list[1].id == 2);
    CHECK(list[1].seen == 4 - 1);  // the third line to the screen came after its end
    CHECK(list[1].acted == 3);
    CHECK(list[1].by[0] == FaultStatus::Counts{2, 2});
    CHECK(list[1].by[1] == FaultStatus::Counts{1, 1});
    CHECK_FALSE(list[1].over);
    faults.to_board().push(SimTime{0}, "a\n");
    CHECK(faults.list(SimTime{0})[1].over);
}

TEST_CASE("a change may move a fault to the other direction") {
    Faults faults;
    const FaultId id = faults.add(SimTime{0}, fault_from_text("drop:to_screen"));
    CHECK(faults.change(SimTime{0}, id, fault_from_text("drop:to_board")));
    faults.to_screen().push(SimTime{0}, "a\n");
    faults.to_board().push(SimTime{0}, "b\n");
    CHECK(faults.to_screen().output() == "a\n");
    CHECK(faults.to_board().output().empty());
    CHECK_FALSE(faults.change(SimTime{0}, 9, fault_from_text("drop")));
    CHECK(faults.remove(SimTime{0}, id));
    CHECK_FALSE(faults.remove(SimTime{0}, id));
    CHECK(faults.list(SimTime{0}).empty());
}

TEST_CASE("a full direction refuses, and the other one is left alone") {
    for (const char* full : {"drop:to_board,probability=0", "drop:to_screen,probability=0"}) {
        Faults faults;
        for (std::size_t i = 0; i < FaultLine::most_faults; ++i) {
            faults.add(SimTime{0}, fault_from_text(full));
        }
        CHECK_THROWS_AS(faults.add(SimTime{0}, fault_from_text("drop")), FaultSpecError);
        CHECK(faults.list(SimTime{0}).size() == FaultLine::most_faults);
    }
}

TEST_CASE("advance does both directions and gives the earlier time") {
    Faults faults;
    faults.add(SimTime{0}, fault_from_text("delay:to_screen,time=2s"));
    faults.add(SimTime{0}, fault_from_text("delay:to_board,time=1s"));
    faults.to_screen().push(SimTime{0}, "a\n");
    faults.to_board().push(SimTime{0}, "b\n");
    CHECK(faults.advance(SimTime{0}) == ms(1000));
    CHECK(faults.advance(ms(1000)) == ms(2000));
    CHECK(faults.to_board().output() == "b\n");
    CHECK(faults.advance(ms(2000)) == fauxboard::machine::never);
    CHECK(faults.to_screen().output() == "a\n");
}

TEST_CASE("changing a fault while the link is down by another one leaves it down") {
    Faults faults;
    faults.add(SimTime{0}, fault_from_text("disconnect:for=10s"));
    const FaultId other = faults.add(SimTime{0}, fault_from_text("disconnect:for=20s"));
    faults.remove(ms(1), other);
    CHECK_FALSE(faults.connected(ms(9999)));
    CHECK(faults.connected(ms(10'000)));
}
