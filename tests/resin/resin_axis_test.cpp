#include "emulator/resin/resin_axis.h"

#include <doctest/doctest.h>

#include <cmath>

#include "emulator/resin/event_rows.h"

using namespace fauxboard::resin;

namespace {

struct Bench {
    ResinConfig config;
    ResinSettings settings;
    EventQueue events;
    ResinAxis axis{config, settings};
    SimTime now{0};
    Bench() { axis.power_on(); }
    /// Runs until nothing moves; how long that took, s.
    double rest() {
        const SimTime from = now;
        while (axis.busy()) {
            now = axis.next_event();
            axis.advance(now, events);
        }
        return to_seconds(now - from);
    }
    double z() { return axis.position(now); }
    int homed() {
        int count = 0;
        while (const auto taken = events.take()) {
            count += *taken == event("motion.homed") ? 1 : 0;
        }
        return count;
    }
};

}  // namespace

TEST_CASE("resin axis: wherever it stands it shows 0 at power-on, and can go below") {
    Bench bench;
    CHECK(bench.z() == 0);
    bench.axis.move(-45.796, true, 300, bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(-45.796));
    bench.axis.move(-1000, true, 300, bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(-bench.config.power_on_mm));
}

TEST_CASE("resin axis: a move takes the time of its way, its speed and its ramps") {
    Bench bench;
    bench.axis.move(10, true, 240, bench.now);  // 4 mm/s, 1000 mm/s2
    CHECK(bench.rest() == doctest::Approx(10.0 / 4 + 4.0 / 1000));
    bench.axis.move(10, true, 600, bench.now);  // faster than M8013 allows
    CHECK(bench.rest() == doctest::Approx(10.0 / 5 + 5.0 / 1000));
    bench.settings.set(ResinSetting::acceleration, 1);
    bench.axis.move(1, true, 300, bench.now);  // too short to get up to speed
    CHECK(bench.rest() == doctest::Approx(2.0));
}

TEST_CASE("resin axis: the place between is that of the ramps, and steps of time change nothing") {
    Bench bench;
    bench.settings.set(ResinSetting::acceleration, 2);
    bench.axis.move(9, true, 120, bench.now);  // 2 mm/s after 1 s and 1 mm; 5.5 s in all
    const auto at = [&](double s) { return bench.axis.position(from_seconds(s)); };
    CHECK(at(0) == doctest::Approx(0));
    CHECK(at(0.5) == doctest::Approx(0.25));
    CHECK(at(1) == doctest::Approx(1));
    CHECK(at(3) == doctest::Approx(5));
    CHECK(at(4.5) == doctest::Approx(8));
    CHECK(at(5) == doctest::Approx(8.75));
    CHECK(at(5.5) == doctest::Approx(9));
    double last = 0;
    for (double s = 0; s < 6; s += 0.01) {
        CHECK(at(s) >= last);
        last = at(s);
    }
    CHECK(bench.rest() == doctest::Approx(5.5));
}

TEST_CASE("resin axis: homing finds zero, off the end stop by the offset, and says so once") {
    Bench bench;
    CHECK(bench.axis.home(bench.now));
    CHECK_FALSE(bench.axis.homed());
    const double s = bench.rest();
    CHECK(bench.axis.homed());
    CHECK(bench.homed() == 1);
    CHECK(bench.z() == doctest::Approx(0));
    // 60 mm down, 5 up and down again, 0.1 further to zero, all at 3 mm/s.
    CHECK(s == doctest::Approx(70.1 / 3).epsilon(0.01));
    bench.settings.set(ResinSetting::after_homing, 1);
    bench.axis.home(bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(0.1));  // it stays at the end stop
    bench.settings.set(ResinSetting::offset_used, 0);
    bench.axis.home(bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(0));
}

TEST_CASE("resin axis: with its end stop far from the screen it homes upwards") {
    Bench bench;
    bench.settings.set(ResinSetting::limit_side, 1);
    bench.settings.set(ResinSetting::after_homing, 1);
    bench.axis.home(bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(155));
}

TEST_CASE("resin axis: homed, it stays between zero and the height of M8026") {
    Bench bench;
    bench.axis.home(bench.now);
    bench.rest();
    bench.axis.move(500, false, 300, bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(155));
    bench.axis.move(-500, true, 300, bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(0));
}

TEST_CASE("resin axis: a platform that stands beyond a limit may leave it and not go on") {
    Bench bench;
    bench.axis.home(bench.now);
    bench.axis.move(150, false, 300, bench.now);
    bench.rest();
    bench.settings.set(ResinSetting::max_height, 100);
    bench.axis.move(1, true, 300, bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(150));
    bench.axis.move(-10, true, 300, bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(140));
}

TEST_CASE("resin axis: stopped in its way it is where it was, and goes on from there") {
    Bench bench;
    bench.axis.move(10, true, 60, bench.now);
    bench.now = from_seconds(4);
    const double z = bench.z();
    bench.axis.abort(bench.now);
    CHECK_FALSE(bench.axis.busy());
    CHECK(bench.axis.next_event() == never);
    CHECK(bench.z() == doctest::Approx(z));
    bench.axis.move(1, true, 60, bench.now);
    bench.rest();
    CHECK(bench.z() == doctest::Approx(z + 1));
    bench.axis.motors_off(bench.now);
    CHECK_FALSE(bench.axis.motors());
}

TEST_CASE("resin axis: what waits is bounded") {
    Bench bench;
    int taken = 0;
    while (bench.axis.move(1, true, 300, bench.now)) {
        ++taken;
        REQUIRE(taken < 1000);
    }
    CHECK(taken > 100);
    CHECK_FALSE(bench.axis.home(bench.now));
    CHECK_FALSE(bench.axis.stir(50, bench.now));
    bench.rest();
    bench.axis.move(-50, true, 300, bench.now);
    bench.rest();
    CHECK(bench.axis.stir(50, bench.now));
    const double z = bench.z();
    bench.rest();
    CHECK(bench.z() == doctest::Approx(z));
}

TEST_CASE("resin axis: settings of 0 make it slow, and never stop it for ever") {
    Bench bench;
    bench.settings.set(ResinSetting::max_speed, 0);
    bench.settings.set(ResinSetting::acceleration, 0);
    bench.axis.move(1, true, 0, bench.now);
    const double s = bench.rest();
    CHECK(std::isfinite(s));
    CHECK(bench.z() == doctest::Approx(1));
}
