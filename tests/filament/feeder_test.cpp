#include "emulator/filament/feeder.h"

#include <doctest/doctest.h>

#include "emulator/filament/event_rows.h"

using namespace fauxboard::filament;

namespace {

struct Bench {
    FilamentConfig config;
    Feeder feeder{config};
    EventQueue events;
    SimTime now{0};

    Bench() {
        config.piece_s = 1.0;
        config.piece_commit_s = 0.25;
        feeder.power_on();
    }
    void pass(double s) {
        now += from_seconds(s);
        feeder.advance(now, events);
    }
    void stop() { feeder.stop(now, events); }
    int count(EventId wanted) {
        int n = 0;
        EventQueue rest;
        while (const auto taken = events.take()) {
            if (*taken == wanted) {
                ++n;
            } else {
                rest.raise(*taken);
            }
        }
        events = rest;
        return n;
    }
    bool running() const { return feeder.mode() != Feeder::Mode::idle; }
};

}  // namespace

TEST_CASE("feeder: a piece is told when the one before it has ended, again and again") {
    Bench bench;
    bench.feeder.start(Feeder::Mode::load, bench.now);
    CHECK(bench.feeder.next_event() == from_seconds(1.0));
    bench.pass(0.99);
    CHECK(bench.count(event("filament.piece")) == 0);
    bench.pass(0.01);
    CHECK(bench.count(event("filament.piece")) == 1);
    bench.pass(100);
    CHECK(bench.count(event("filament.piece")) <= 64);  // the queue of events is bounded
    CHECK(bench.running());
}

TEST_CASE("feeder: a stop early in a piece is a stop at once") {
    Bench bench;
    bench.feeder.start(Feeder::Mode::unload, bench.now);
    bench.pass(3.2);
    bench.count(event("filament.piece"));
    bench.stop();
    CHECK(bench.count(event("filament.stopped")) == 1);
    CHECK_FALSE(bench.running());
    CHECK(bench.feeder.next_event() == never);
    bench.pass(10);
    CHECK(bench.events.empty());
}

TEST_CASE("feeder: a stop later in a piece waits for its end") {
    Bench bench;
    bench.feeder.start(Feeder::Mode::clean, bench.now);
    bench.pass(3.25);
    bench.count(event("filament.piece"));
    bench.stop();
    CHECK(bench.events.empty());
    CHECK(bench.running());
    bench.pass(0.75);
    CHECK(bench.events.take() == event("filament.piece"));
    CHECK(bench.events.take() == event("filament.stopped"));
    CHECK_FALSE(bench.running());
}

TEST_CASE("feeder: a stop of nothing is told as well, so that the screen gets its answer") {
    Bench bench;
    bench.stop();
    CHECK(bench.count(event("filament.stopped")) == 1);
}

TEST_CASE("feeder: once is one piece") {
    Bench bench;
    bench.feeder.feed_once(bench.now);
    CHECK(bench.running());
    bench.pass(1.0);
    CHECK(bench.count(event("filament.piece")) == 1);
    CHECK(bench.count(event("filament.stopped")) == 1);
    CHECK_FALSE(bench.running());
}

TEST_CASE("feeder: a new start while one runs begins a new piece and forgets a stop") {
    Bench bench;
    bench.feeder.start(Feeder::Mode::load, bench.now);
    bench.pass(0.5);
    bench.stop();
    bench.feeder.start(Feeder::Mode::unload, bench.now);
    CHECK(bench.feeder.mode() == Feeder::Mode::unload);
    CHECK(bench.feeder.next_event() == from_seconds(1.5));
    bench.pass(1.0);
    CHECK(bench.running());
}
