#include "emulator/filament/heating_wait.h"

#include <doctest/doctest.h>

#include <vector>

#include "emulator/filament/event_rows.h"

using namespace fauxboard::filament;

namespace {

struct Bench {
    ThermalConfig config;
    Thermal thermal{config, 1};
    HeatingWaitConfig waiting;
    HeatingWait wait{waiting};
    EventQueue events;
    SimTime now{0};
    std::vector<double> reports;
    int done = 0;

    Bench() { thermal.power_on(now); }

    void run_until(double s) {
        while (wait.active() && wait.next_event() <= from_seconds(s)) {
            now = wait.next_event();
            thermal.advance(now);
            wait.advance(now, thermal, events);
            while (const auto taken = events.take()) {
                if (*taken == event("heating.wait_report")) {
                    reports.push_back(to_seconds(now));
                }
                done += *taken == event("heating.wait_done") ? 1 : 0;
            }
        }
    }
};

}  // namespace

TEST_CASE("waiting: reports every 2.0 s, one in 26 after 1.2 s, 51.2 s from one such to the next") {
    Bench bench;
    bench.thermal.set_target(HeaterId::bed, 100);
    bench.wait.start(HeaterId::bed, bench.now, bench.events);
    CHECK(bench.events.take() == event("heating.wait_started"));
    bench.run_until(160);
    REQUIRE(bench.reports.size() > 70);
    CHECK(bench.reports[0] == doctest::Approx(2.0));
    std::vector<double> hiccups;
    for (std::size_t i = 1; i < bench.reports.size(); ++i) {
        const double gap = bench.reports[i] - bench.reports[i - 1];
        if (gap < 1.9) {
            CHECK(gap == doctest::Approx(1.2));
            hiccups.push_back(bench.reports[i]);
        } else {
            CHECK(gap == doctest::Approx(2.0));
        }
    }
    REQUIRE(hiccups.size() == 3);
    CHECK(hiccups[0] == doctest::Approx(51.2));
    CHECK(hiccups[1] - hiccups[0] == doctest::Approx(51.2));
}

TEST_CASE("waiting: it ends when the heater is there, once") {
    Bench bench;
    bench.thermal.set_target(HeaterId::nozzle, 60);
    bench.wait.start(HeaterId::nozzle, bench.now, bench.events);
    bench.run_until(600);
    CHECK_FALSE(bench.wait.active());
    CHECK(bench.done == 1);
    CHECK(bench.thermal.printed_c(ThermalChannel::t0) >= 59);
    CHECK(bench.wait.next_event() == never);
    CHECK(bench.wait.heater() == HeaterId::nozzle);  // what was waited for last
}

TEST_CASE("waiting: it ends when the target is taken away, and when it is cancelled") {
    Bench bench;
    bench.thermal.set_target(HeaterId::nozzle, 200);
    bench.wait.start(HeaterId::nozzle, bench.now, bench.events);
    bench.run_until(5);
    bench.thermal.set_target(HeaterId::nozzle, 0);
    bench.run_until(6);
    CHECK_FALSE(bench.wait.active());
    CHECK(bench.done == 1);
    bench.wait.cancel(bench.events);
    CHECK(bench.events.empty());  // nothing to cancel
    bench.wait.start(HeaterId::bed, bench.now, bench.events);
    bench.wait.cancel(bench.events);
    CHECK(bench.events.take() == event("heating.wait_started"));
    CHECK(bench.events.take() == event("heating.wait_done"));
}

TEST_CASE("waiting: where it has to settle, a target that somebody lowers meanwhile ends it") {
    Bench bench;
    bench.waiting.residency_s = 10;
    HeatingWait& wait = bench.wait;
    bench.thermal.set_target(HeaterId::nozzle, 100);
    wait.start(HeaterId::nozzle, bench.now, bench.events);
    bench.run_until(60);
    REQUIRE(wait.active());
    REQUIRE(bench.thermal.sensed_c(HeaterId::nozzle) > 30);
    bench.thermal.set_target(HeaterId::nozzle, 3);
    bench.run_until(62);
    CHECK_FALSE(wait.active());
    CHECK(bench.done == 1);
}
