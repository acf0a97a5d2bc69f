#include "emulator/host/clock.h"

#include <doctest/doctest.h>

#include <vector>

#include "emulator/link/event_loop.h"

namespace fauxboard::host {
namespace {

using namespace std::chrono_literals;

TEST_CASE("at full speed time jumps from alarm to alarm") {
    asio::io_context loop{1};
    const auto work = asio::make_work_guard(loop);
    const auto clock = make_clock(loop, {1, true});
    std::vector<SimTime> rung;
    clock->start([&] {
        rung.push_back(clock->now());
        if (rung.size() == 200) {
            loop.stop();
        } else {
            clock->wake_at(clock->now() + 1h);
        }
    });
    clock->wake_at(5s);
    clock->run();
    REQUIRE(rung.size() == 200);
    CHECK(rung[0] == 5s);
    CHECK(rung[199] == 5s + 199h);
}

TEST_CASE("at full speed the event loop gets its turn, also when nothing is due") {
    asio::io_context loop{1};
    const auto clock = make_clock(loop, {1, true});
    const auto work = asio::make_work_guard(loop);
    int rung = 0;
    clock->start([&] {
        if (++rung < 100'000) {
            clock->wake_at(clock->now() + 1s);
        }
    });
    clock->wake_at(0s);
    asio::post(loop, [&] {
        CHECK(rung < 1000);
        rung = 100'000;  // the next alarm is the last
        asio::post(loop, [&] { asio::post(loop, [&] { loop.stop(); }); });
    });
    clock->run();
    CHECK(rung >= 100'000);
}

TEST_CASE("an alarm of the real clock never rings before its time, and the earliest one counts") {
    for (const double factor : {1.0, 1e6, 1000.0}) {
        CAPTURE(factor);
        asio::io_context loop{1};
        const auto clock = make_clock(loop, {factor, false});
        SimTime due = 3ms;
        int rung = 0;
        clock->start([&] {
            ++rung;
            if (clock->now() < due) {
                clock->wake_at(due);  // it may be early when it was set back: ask again
                return;
            }
            loop.stop();
        });
        clock->wake_at(std::chrono::hours(1'000'000));
        clock->wake_at(1ms);
        clock->wake_at(due);
        clock->run();
        CHECK(clock->now() >= due);
        CHECK(rung >= 1);
    }
}

TEST_CASE("an alarm that never comes is none") {
    asio::io_context loop{1};
    const auto clock = make_clock(loop, {0.01, false});
    clock->start([] { FAIL("rung"); });
    clock->wake_at(printer::never);
    clock->wake_at(SimTime::max() - 1us);
    clock->run();  // nothing to wait for: comes back at once
}

}  // namespace
}  // namespace fauxboard::host
