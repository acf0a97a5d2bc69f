#include "emulator/host/clock.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/link/event_loop.h"
#include "tests/host/live_helpers.h"

namespace fauxboard::host {
namespace {

using namespace std::chrono_literals;

TEST_CASE("at full speed time jumps from alarm to alarm") {
    link::EventLoop loop;
    const auto clock = make_clock(loop, {1, true});
    std::vector<SimTime> rung;
    std::unique_ptr<Alarm> alarm = clock->make_alarm([&] {
        rung.push_back(clock->now());
        if (rung.size() == 200) {
            loop.stop();
        } else {
            alarm->at(clock->now() + 1h);
        }
    });
    alarm->at(5s);
    clock->start();
    clock->run();
    REQUIRE(rung.size() == 200);
    CHECK(rung[0] == 5s);
    CHECK(rung[199] == 5s + 199h);
}

TEST_CASE("at full speed the event loop gets its turn, also when nothing is due") {
    link::EventLoop loop;
    const auto clock = make_clock(loop, {1, true});
    int rung = 0;
    std::unique_ptr<Alarm> alarm = clock->make_alarm([&] {
        if (++rung < 100'000) {
            alarm->at(clock->now() + 1s);
        }
    });
    clock->start();
    alarm->at(0s);
    loop.post([&] {
        CHECK(rung < 1000);
        rung = 100'000;  // the next alarm is the last
        loop.post([&] { loop.post([&] { loop.stop(); }); });
    });
    clock->run();
    CHECK(rung >= 100'000);
}

TEST_CASE("time that is held passes by skips alone, and what is due rings all the same") {
    for (const bool max : {true, false}) {
        CAPTURE(max);
        link::EventLoop loop;
        const auto clock = make_clock(loop, {1000, max});
        std::vector<SimTime> rung;
        const auto alarm = clock->make_alarm([&] {
            rung.push_back(clock->now());
            if (rung.size() == 2) {
                loop.post([&] { clock->hold(false); });
            }
        });
        const auto last = clock->make_alarm([&] { loop.stop(); });
        clock->start();
        alarm->at(1h);
        clock->hold(true);
        const SimTime held_at = clock->now();
        CHECK(clock->held());
        loop.post([&] {
            CHECK(clock->now() == held_at);
            clock->skip(2h);
            CHECK(rung.size() == 1);
            last->at(held_at + 2h + 1s);
            alarm->at(held_at + 2h);  // later than real time has got, and due all the same
        });
        clock->run();
        CHECK(rung == std::vector<SimTime>{1h, held_at + 2h});
        CHECK(clock->now() >= held_at + 2h + 1s);
    }
}

TEST_CASE("an alarm of the real clock never rings before its time, and the latest wish counts") {
    for (const double factor : {1.0, 1e6, 1000.0}) {
        CAPTURE(factor);
        link::EventLoop loop;
        const auto clock = make_clock(loop, {factor, false});
        int rung = 0;
        const auto alarm = clock->make_alarm([&] {
            ++rung;
            loop.stop();
        });
        clock->start();
        alarm->at(std::chrono::hours(1'000'000));
        alarm->at(1ms);
        alarm->at(3ms);
        clock->run();
        CHECK(clock->now() >= 3ms);
        CHECK(rung == 1);
    }
}

TEST_CASE("an alarm that never comes is none") {
    link::EventLoop loop;
    const auto clock = make_clock(loop, {0.01, false});
    const auto alarm = clock->make_alarm([] { FAIL("rung"); });
    clock->start();
    alarm->at(machine::never);
    alarm->at(SimTime::max() - 1us);
    clock->run();  // nothing to wait for: comes back at once
}

/// The names of the alarms in the order in which they rang.
struct Bells {
    Clock& clock;
    std::string rung;
    std::vector<SimTime> times;

    std::unique_ptr<Alarm> make(char name) {
        return clock.make_alarm([this, name] {
            rung += name;
            times.push_back(clock.now());
        });
    }
};

TEST_CASE("several alarms ring in the order of their times, each once, on both clocks") {
    for (const bool max : {true, false}) {
        CAPTURE(max);
        link::EventLoop loop;
        const auto clock = make_clock(loop, {1000, max});
        Bells bells{*clock, {}, {}};
        const auto a = bells.make('a');
        const auto b = bells.make('b');
        auto gone = bells.make('x');
        const auto c = bells.make('c');
        const auto last = clock->make_alarm([&] { loop.stop(); });
        last->at(60s);  // real: 60 ms
        c->at(1s);
        a->at(3s);
        b->at(2s);
        gone->at(2s);
        gone.reset();
        clock->start();
        clock->run();
        CHECK(bells.rung == "cba");
        CHECK(bells.times[0] >= 1s);
        CHECK(bells.times[2] >= 3s);
        CHECK(clock->now() >= 60s);
    }
}

TEST_CASE("alarms of one moment ring in the order in which they were made, and none starves another") {
    test::HandClock clock;
    std::string rung;
    std::unique_ptr<Alarm> greedy = clock.make_alarm([&] {
        rung += 'g';
        greedy->at(clock.now());
    });
    const auto modest = clock.make_alarm([&] { rung += 'm'; });
    modest->at(1s);
    greedy->at(1s);
    clock.hand = 2s;
    clock.ring_due();
    CHECK(rung == "gm");
    clock.ring_due();
    CHECK(rung == "gmg");
}

TEST_CASE("an alarm may destroy itself and others, and make new ones") {
    test::HandClock clock;
    Bells bells{clock, {}, {}};
    auto other = bells.make('x');
    std::unique_ptr<Alarm> made;
    std::unique_ptr<Alarm> itself = clock.make_alarm([&] {
        itself.reset();
        other.reset();
        made = bells.make('n');
        made->at(1s);
    });
    itself->at(1s);
    other->at(2s);
    clock.pass(3s);
    CHECK(bells.rung == "n");
    CHECK(bells.times == std::vector<SimTime>{1s});
    CHECK(clock.earliest() == machine::never);
}

TEST_CASE("skipped time rings all that is due on the way, each at its moment, on both clocks") {
    for (const bool max : {true, false}) {
        CAPTURE(max);
        link::EventLoop loop;
        const auto clock = make_clock(loop, {1, max});
        std::vector<SimTime> rung;
        std::unique_ptr<Alarm> hourly = clock->make_alarm([&] {
            rung.push_back(clock->now());
            hourly->at(clock->now() + 1h);
        });
        const auto later = clock->make_alarm([&] { loop.stop(); });
        clock->start();
        hourly->at(1h);
        later->at(24h);
        clock->skip(10h);
        REQUIRE(rung.size() == 10);
        CHECK(rung[0] == 1h);
        CHECK(rung[9] == 10h);
        CHECK(clock->now() >= 10h);
        CHECK(clock->now() < 11h);
        // What was to come in hours comes at once when they have been skipped, without waiting for them.
        clock->skip(14h - 1ms - (clock->now() - 10h));
        clock->run();
        CHECK(clock->now() >= 24h);
        CHECK(rung.size() >= 23);
        const SimTime before = clock->now();
        clock->skip(SimTime{-5});
        clock->skip(SimTime{0});
        CHECK(clock->now() >= before);
    }
}

TEST_CASE("time before the start is 0; a skip from inside an alarm is refused, an endless one is bounded") {
    link::EventLoop loop;
    const auto clock = make_clock(loop, {1, false});
    CHECK(clock->now() == 0s);
    const auto alarm = clock->make_alarm([&] { CHECK_THROWS_AS(clock->skip(1s), std::logic_error); });
    alarm->at(1s);
    clock->skip(machine::never);
    CHECK(clock->now() > std::chrono::hours(24 * 365 * 1000));
    clock->start();
    CHECK(clock->now() < machine::never);
}

}  // namespace
}  // namespace fauxboard::host
