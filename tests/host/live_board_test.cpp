#include "emulator/host/live_board.h"

#include <optional>

#include "protocol/framing.h"
#include "tests/host/live_helpers.h"
#include "tests/support/printers.h"

namespace fauxboard::host::test {
namespace {

using protocol::frame;

struct Bench {
    explicit Bench(bool pacing = true, SimTime duration = machine::never)
        : board(load_profile_by_name("geeetech-a30t"), {}, {pacing, 1, &witness}),
          live(board, link, clock, &witness) {
        link.open(live);
        live.start(duration, [this] { ++ended; });
    }
    Witness witness;
    FakeLink link;
    HandClock clock;
    board::Board board;
    LiveBoard live;
    int ended = 0;
};

TEST_CASE("power-on happens at the start, and the boot messages come one a tick") {
    Bench b;
    CHECK(b.link.messages.empty());
    b.clock.pass(0s);
    REQUIRE(b.link.messages.size() == 1);
    CHECK(b.link.messages[0].starts_with("N-0 L3 "));
    b.clock.pass(b.board.profile().tick - 1us);
    CHECK(b.link.messages.size() == 1);
    b.clock.pass(1us);
    CHECK(b.link.messages.size() == 2);
}

TEST_CASE("without pacing the reply leaves before on_bytes returns") {
    Bench b(false);
    b.clock.pass(1s);
    b.link.messages.clear();
    b.live.on_bytes(frame("M104 S200"));
    REQUIRE(b.link.messages.size() == 1);
    CHECK(b.link.messages[0].find("/200.0 /1") != std::string::npos);
}

TEST_CASE("with pacing the reply leaves on a tick, not before") {
    Bench b;
    b.clock.pass(1'010ms);
    b.link.messages.clear();
    b.live.on_bytes(frame("M104 S200"));
    CHECK(b.link.messages.empty());
    b.clock.pass(100ms);
    CHECK(b.link.wrote("/200.0 /1"));
}

TEST_CASE("a request in pieces, with time in between, is one request") {
    Bench b(false);
    b.clock.pass(1s);
    for (const char c : frame("M104 S201")) {
        b.live.on_bytes({&c, 1});
        b.clock.pass(1ms);
    }
    CHECK(b.link.wrote("/201.0 /1"));
}

TEST_CASE("what was due before the bytes came is sent first, however late the alarm is") {
    Bench late;
    late.clock.hand = 3s;  // this computer was busy; no alarm rang
    late.live.on_bytes(frame("M104 S200"));
    late.clock.pass(1s);
    Bench punctual;
    punctual.clock.pass(3s);
    punctual.live.on_bytes(frame("M104 S200"));
    punctual.clock.pass(1s);
    CHECK(late.link.all() == punctual.link.all());
    CHECK(late.link.messages.size() > 15);
}

TEST_CASE("the printer goes on while nobody is there, and the link's story is told") {
    Bench b;
    b.link.go(link::LinkState::up, "somebody came");
    b.clock.pass(2s);
    b.live.on_bytes(frame("M104 S200"));
    b.link.go(link::LinkState::waiting, "gone");
    b.clock.pass(120s);
    b.link.go(link::LinkState::up, "back");
    CHECK(testing::filament_printer(b.board.machine()).thermal.printed_c(filament::ThermalChannel::t0) > 100);
    CHECK(b.witness.links == std::vector<std::string>{"somebody came", "gone", "back"});
    b.link.messages.clear();
    b.live.on_bytes(frame("M105"));
    b.clock.pass(200ms);
    CHECK(b.link.wrote("L2 B:"));
}

TEST_CASE("it ends once, at its time, and is deaf and dumb from then on") {
    Bench b(false, 10s);
    b.clock.pass(9'999'999us);
    CHECK(b.ended == 0);
    b.clock.pass(1us);
    CHECK(b.ended == 1);
    CHECK(b.live.now() == 10s);
    b.link.messages.clear();
    b.clock.pass(100s);
    b.live.on_bytes(frame("M105"));
    CHECK(b.link.messages.empty());
    CHECK(b.ended == 1);
}

TEST_CASE("requests that come all at once are all answered when nothing paces them") {
    Bench b(false);
    b.clock.pass(1s);
    std::string requests;
    while (requests.size() < link::Link::read_limit)
        requests += frame("M20 LCD");
    b.live.on_bytes(requests);
    b.clock.pass(0s);
    CHECK(b.board.counters().requests_lost == 0);
    CHECK(b.board.counters().messages_lost == 0);
}

TEST_CASE("a flood of bytes neither kills it nor stops time") {
    Bench b;
    const std::string junk(4096, 'x');
    for (int i = 0; i < 2500; ++i) {
        b.live.on_bytes(junk);
        b.clock.pass(100us);
    }
    b.live.on_bytes("\n" + frame("M104 S222"));
    b.clock.pass(5s);
    CHECK(b.board.lines_too_long() == 1);
    CHECK(b.link.wrote("/222.0 /1"));
}

TEST_CASE("a clock far ahead of the board gives the event loop its turn") {
    Bench b;
    b.clock.hand = std::chrono::hours(24 * 30);
    b.clock.ring_due();
    CHECK(b.link.messages.size() <= 1100);
    CHECK(b.clock.earliest() <= b.clock.hand);  // and wants to go on at once
}

TEST_CASE("a changed profile is in force at once, and the machine's state stays") {
    Bench b(false);
    b.clock.pass(1s);
    b.live.on_bytes(frame("M104 S200"));
    const behaviour::SourceText changed{
        "changed.json",
        R"({"name": "changed", "extends": "geeetech-a30t", "frames": {"L2": "L2 changed {heaters.nozzle.target:.0f}"}})"};
    b.live.reload(behaviour::load_profile(changed, profile_finder()));
    b.link.messages.clear();
    b.live.on_bytes(frame("M105"));
    CHECK(b.link.all() == frame("L2 changed 200"));
}

}  // namespace
}  // namespace fauxboard::host::test
