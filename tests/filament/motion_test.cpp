// Moves, homing and procedures in closed form.

#include "emulator/filament/motion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "emulator/filament/event_rows.h"

using namespace fauxboard::filament;

namespace {

constexpr SimTime second{1'000'000};

ProcedureStep step(ProcedureStep::Kind kind) {
    ProcedureStep out;
    out.kind = kind;
    return out;
}

ProcedureStep axes(ProcedureStep::Kind kind, std::initializer_list<std::size_t> named) {
    ProcedureStep out = step(kind);
    for (const std::size_t axis : named) {
        out.values[axis] = 0;
    }
    return out;
}

MotionConfig bench_config() {
    MotionConfig config;
    config.volume_mm = {300, 300, 400};
    config.power_on_mm = {100, 50, 20};
    config.homing_feed_mm_s = 20;
    config.homing_bump_s = 4;
    return config;
}

Settings bench_settings() {
    Settings settings;
    settings.velocity_mm_s = {150, 150, 20, 25};
    settings.acceleration_mm_s2 = 500;
    return settings;
}

struct Bench {
    MotionConfig config = bench_config();
    Settings settings = bench_settings();
    EventQueue events;
    Motion motion{config, settings};
    SimTime now{0};

    MoveOutcome move(std::optional<double> x, std::optional<double> y = {}, std::optional<double> z = {},
                     std::optional<double> e = {}, std::optional<double> f = {}) {
        MoveRequest request;
        request.values = {x, y, z, e};
        request.feed_mm_min = f;
        return motion.move(request, now, events);
    }
    void pass(double s) {
        now += from_seconds(s);
        motion.advance(now, events);
    }
    /// Seconds until nothing moves any more.
    double until_idle() {
        const SimTime from = now;
        while (motion.busy()) {
            now = motion.next_event();
            motion.advance(now, events);
        }
        return to_seconds(now - from);
    }
    double x() const { return motion.position(Axis::x); }
    double z() const { return motion.position(Axis::z); }
};

}  // namespace

TEST_CASE("motion: a long move takes its way at its feed, and the ramps") {
    Bench bench;
    bench.move(200, {}, {}, {}, 6000);  // 100 mm/s
    // 200 mm / 100 mm/s + 100 mm/s / 500 mm/s2
    CHECK(bench.until_idle() == doctest::Approx(2.2));
    CHECK(bench.motion.feed_mm_s() == 100);
}

TEST_CASE("motion: a short move never reaches its feed") {
    Bench bench;
    bench.move(5, {}, {}, {}, 6000);
    CHECK(bench.until_idle() == doctest::Approx(2 * std::sqrt(5.0 / 500)));
}

TEST_CASE("motion: the way of X, Y and Z together counts; the extruder's only when it moves alone") {
    Bench bench;
    bench.move(30, 40, 0, 500, 600);
    CHECK(bench.until_idle() == doctest::Approx(50.0 / 10 + 10.0 / 500));
    bench.move({}, {}, {}, 520, 600);
    CHECK(bench.until_idle() == doctest::Approx(20.0 / 10 + 10.0 / 500));
}

TEST_CASE("motion: the slowest axis that moves sets the feed") {
    Bench bench;
    bench.move(10, {}, 100, {}, 9000);
    CHECK(bench.until_idle() == doctest::Approx(std::hypot(10, 100) / 20 + 20.0 / 500));
    bench.move(100, {}, {}, {}, 60000);
    CHECK(bench.until_idle() == doctest::Approx(90.0 / 150 + 150.0 / 500));
}

TEST_CASE("motion: print speed scales moves, and not procedures") {
    Bench bench;
    bench.motion.set_speed_percent(50);
    bench.move(100, {}, {}, {}, 6000);
    CHECK(bench.motion.feed_mm_s() == 50);
    CHECK(bench.until_idle() == doctest::Approx(100.0 / 50 + 50.0 / 500));
    ProcedureStep to = step(ProcedureStep::Kind::to);
    to.values[0] = 0;
    to.feed_mm_s = 100;
    bench.motion.run({to}, bench.now, bench.events);
    CHECK(bench.motion.feed_mm_s() == 100);
    CHECK(bench.until_idle() == doctest::Approx(100.0 / 100 + 100.0 / 500));
}

TEST_CASE("motion: F stays in force, alone it moves nothing, and one that is none is passed over") {
    Bench bench;
    CHECK(bench.move({}, {}, {}, {}, 1200) == MoveOutcome::accepted);
    CHECK_FALSE(bench.motion.busy());
    CHECK_FALSE(bench.motion.motors());
    for (const double wrong : {0.0, -5.0, std::nan(""), -std::numeric_limits<double>::infinity()}) {
        bench.move({}, {}, {}, {}, wrong);
    }
    bench.move(20);
    CHECK(bench.motion.feed_mm_s() == 20);
    CHECK(bench.motion.motors());
}

TEST_CASE("motion: software end stops keep a move inside, and say so") {
    Bench bench;
    CHECK(bench.move(-1) == MoveOutcome::clamped);
    CHECK(bench.x() == 0);
    CHECK(bench.move(301) == MoveOutcome::clamped);
    CHECK(bench.x() == 300);
    CHECK(bench.move(300, 300, 400) == MoveOutcome::accepted);
    CHECK(bench.move({}, {}, {}, -500) == MoveOutcome::accepted);  // the extruder has no ends
    MoveRequest free;
    free.values[2] = -3;
    free.limits = false;
    CHECK(bench.motion.move(free, bench.now, bench.events) == MoveOutcome::accepted);
    CHECK(bench.z() == -3);
}

TEST_CASE("motion: relative moves add to the end of what is planned") {
    Bench bench;
    bench.motion.set_relative(true);
    for (int i = 0; i < 5; ++i) {
        bench.move(10);
    }
    bench.until_idle();
    CHECK(bench.x() == 50);
    bench.motion.set_relative(false);
    bench.move(10);
    CHECK(bench.x() == 10);
    MoveRequest forced;
    forced.values[0] = 5;
    forced.force_relative = true;
    bench.motion.move(forced, bench.now, bench.events);
    CHECK(bench.x() == 15);
}

TEST_CASE("motion: the position told is that of the last move in the planner, which runs ahead") {
    Bench bench;
    bench.config.planner_blocks = 4;
    bench.move(10, {}, {}, {}, 600);
    for (int i = 2; i <= 10; ++i) {
        bench.move(10 * i);
    }
    CHECK(bench.x() == 40);  // four blocks: the one under way and three more
    bench.pass(1.1);         // the first has ended
    CHECK(bench.x() == 50);
    bench.until_idle();
    CHECK(bench.x() == 100);
}

TEST_CASE("motion: a full queue refuses the move and keeps what it has") {
    Bench bench;
    int accepted = 0;
    bench.motion.set_relative(true);
    while (bench.move(0.5, {}, {}, {}, 60) == MoveOutcome::accepted) {
        REQUIRE(++accepted < 1000);
    }
    CHECK(accepted == 64);
    CHECK(bench.move(0.5) == MoveOutcome::queue_full);
    CHECK_FALSE(bench.motion.run({step(ProcedureStep::Kind::wait)}, bench.now, bench.events));
    bench.until_idle();
    CHECK(bench.x() == 32);
    CHECK(bench.move(0.5) == MoveOutcome::accepted);
}

TEST_CASE("motion: a procedure goes in whole or not at all") {
    Bench bench;
    Procedure procedure(60, step(ProcedureStep::Kind::wait));
    for (ProcedureStep& wait : procedure) {
        wait.seconds = 1;
    }
    CHECK(bench.motion.run(procedure, bench.now, bench.events));
    CHECK_FALSE(bench.motion.run(procedure, bench.now, bench.events));
    CHECK(bench.until_idle() == doctest::Approx(60));
}

TEST_CASE("motion: numbers that are none, and huge ones, end at something finite") {
    Bench bench;
    for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
        for (const bool limits : {true, false}) {
            MoveRequest request;
            request.values = {wrong, wrong, wrong, wrong};
            request.feed_mm_min = wrong;
            request.limits = limits;
            bench.motion.move(request, bench.now, bench.events);
            bench.motion.set_position({wrong, {}, {}, wrong});
        }
    }
    bench.until_idle();
    for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::e}) {
        CHECK(std::isfinite(bench.motion.position(axis)));
    }
    CHECK(std::isfinite(bench.motion.feed_mm_s()));
}

TEST_CASE("motion: even the slowest move ends") {
    Bench bench;
    bench.move(300, {}, {}, {}, 1e-30);
    CHECK(bench.motion.next_event() <= bench.now + 86400 * second);
}

TEST_CASE("motion: G92 calls the place so, and homing still knows the way") {
    Bench bench;
    bench.motion.set_position({80.0, {}, {}, {}});
    CHECK(bench.x() == 80);
    CHECK_FALSE(bench.motion.busy());
    bench.motion.run({axes(ProcedureStep::Kind::home, {0})}, bench.now, bench.events);
    CHECK(bench.until_idle() == doctest::Approx(100.0 / 20 + 4));  // it really stood at 100
    CHECK(bench.x() == 0);
}

TEST_CASE("motion: homing takes as long as the way is, one axis after the other") {
    Bench bench;
    const Procedure home{axes(ProcedureStep::Kind::zero, {0, 1, 2}), axes(ProcedureStep::Kind::home, {0, 1}),
                         axes(ProcedureStep::Kind::homed, {0, 1, 2})};
    bench.motion.run(home, bench.now, bench.events);
    CHECK(bench.until_idle() == doctest::Approx(100.0 / 20 + 4 + 50.0 / 20 + 4));
    CHECK(bench.motion.homed());
    bench.motion.run(home, bench.now, bench.events);
    CHECK(bench.until_idle() == doctest::Approx(8));  // it stands there already
    bench.move(60, {}, {}, {}, 6000);
    bench.until_idle();
    bench.motion.run(home, bench.now, bench.events);
    CHECK(bench.until_idle() == doctest::Approx(60.0 / 20 + 8));
}

TEST_CASE("motion: it is homed when all three axes are, until the motors go off") {
    Bench bench;
    for (const std::size_t axis : {0U, 1U, 2U}) {
        CHECK_FALSE(bench.motion.homed());
        bench.motion.run({axes(ProcedureStep::Kind::homed, {axis})}, bench.now, bench.events);
    }
    CHECK(bench.motion.homed());
    bench.motion.set_babystep(0.2);
    bench.motion.set_motors(false);
    CHECK_FALSE(bench.motion.homed());
    bench.motion.run({axes(ProcedureStep::Kind::homed, {0})}, bench.now, bench.events);
    CHECK(bench.motion.babystep_mm() == 0);
}

TEST_CASE("motion: what was too short to be a move is still there when the motors go off at rest") {
    Bench bench;
    const auto jog = [&bench](double mm) {
        bench.motion.stream({100 + mm, 50, 20, 0}, 20, 0);
        bench.motion.start_stream(bench.now);
        bench.until_idle();
    };
    jog(10);
    jog(10.02);  // less than Marlin's six steps
    bench.motion.set_motors(false);
    CHECK(bench.motion.planned()[0] == doctest::Approx(110.02));
    jog(60);
    jog(160);
    bench.motion.stream({100, 50, 20, 0}, 20, 0);
    bench.motion.start_stream(bench.now);
    bench.motion.set_motors(false);  // while it moves
    CHECK(bench.motion.planned()[0] == doctest::Approx(260));
}

TEST_CASE("motion: the extruder's place may lie far beyond any axis") {
    Bench bench;
    bench.motion.set_position({std::nullopt, std::nullopt, std::nullopt, 250'000});
    CHECK(bench.motion.planned()[3] == 250'000);
    MoveRequest request;
    request.values[3] = 10;
    request.force_relative = true;
    bench.motion.move(request, bench.now, bench.events);
    bench.until_idle();
    CHECK(bench.motion.planned()[3] == 250'010);
    bench.motion.set_position({1e6, std::nullopt, std::nullopt, std::nullopt});
    CHECK(bench.motion.planned()[0] == 1e5);
}

TEST_CASE("motion: a probe ends on the bed, a reference probe on the nominal plane") {
    Bench bench;
    bench.config.probe_trigger_mm = 2.5;
    bench.config.probe_offset_mm = {-40, 0};
    bench.config.bed_mesh_mm = {{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, {0.7, 0.8, 0.9}}};
    const auto probe_at = [&](double x, double y, bool reference) {
        ProcedureStep to = step(ProcedureStep::Kind::to);
        to.values = {x + 40, y, 10, {}};
        to.feed_mm_s = 100;
        ProcedureStep probe = step(ProcedureStep::Kind::probe);
        probe.seconds = 1;
        probe.reference = reference;
        bench.motion.run({to, probe}, bench.now, bench.events);
        bench.until_idle();
        return bench.z();
    };
    CHECK(probe_at(0, 0, false) == doctest::Approx(2.6));
    CHECK(probe_at(300, 300, false) == doctest::Approx(3.4));
    CHECK(probe_at(150, 150, false) == doctest::Approx(3.0));
    CHECK(probe_at(75, 0, false) == doctest::Approx(2.65));
    CHECK(probe_at(75, 75, false) == doctest::Approx(2.8));
    CHECK(probe_at(-50, 900, false) == doctest::Approx(3.2));  // beyond the bed: its edge
    CHECK(probe_at(75, 75, true) == 2.5);
}

TEST_CASE("motion: steps of a procedure come into L1's position only when their turn is there") {
    Bench bench;
    ProcedureStep up = step(ProcedureStep::Kind::by);
    up.values[2] = 5;
    up.feed_mm_s = 10;
    ProcedureStep over = step(ProcedureStep::Kind::to);
    over.values[0] = 100;
    over.feed_mm_s = 100;
    bench.motion.run({up, over}, bench.now, bench.events);
    CHECK(bench.z() == 5);
    CHECK(bench.x() == 0);
    bench.pass(0.6);
    CHECK(bench.x() == 100);
    CHECK(bench.motion.feed_mm_s() == 100);
    bench.until_idle();
    CHECK(bench.motion.feed_mm_s() == 100);  // kept when idle
}

TEST_CASE("motion: raise and lose_rounds take no time; asking for lost rounds takes them") {
    Bench bench;
    ProcedureStep lose = step(ProcedureStep::Kind::lose_rounds);
    lose.rounds = 2;
    ProcedureStep raise = step(ProcedureStep::Kind::raise);
    raise.event = event("motion.probed");
    bench.motion.run({lose, raise, lose}, bench.now, bench.events);
    CHECK_FALSE(bench.motion.busy());
    CHECK(bench.events.take() == event("motion.probed"));
    CHECK(bench.motion.take_lost_rounds() == 4);
    CHECK(bench.motion.take_lost_rounds() == 0);
}

TEST_CASE("motion: an abort drops what waits, and the next move starts from where the last one ended") {
    Bench bench;
    bench.move(10, {}, {}, {}, 6000);
    bench.until_idle();
    bench.move(100, {}, {}, {}, 60);
    bench.move(200);
    bench.pass(1);
    bench.motion.abort();
    CHECK_FALSE(bench.motion.busy());
    CHECK(bench.motion.next_event() == never);
    bench.pass(1000);
    CHECK(bench.x() == 10);
    bench.move(20, {}, {}, {}, 600);
    CHECK(bench.until_idle() == doctest::Approx(10.0 / 10 + 10.0 / 500));
}

TEST_CASE("motion: a reset forgets the place, the head stays where it stands") {
    Bench bench;
    bench.move(50, {}, {}, {}, 6000);
    bench.until_idle();
    bench.motion.set_babystep(0.3);
    bench.motion.set_relative(true);
    bench.motion.set_speed_percent(33);
    bench.motion.power_on();
    CHECK(bench.x() == 0);
    CHECK(bench.motion.babystep_mm() == 0);
    CHECK_FALSE(bench.motion.relative());
    CHECK_FALSE(bench.motion.motors());
    CHECK(bench.motion.speed_percent() == 100);
    CHECK(bench.motion.feed_mm_s() == 0);
    bench.motion.run({axes(ProcedureStep::Kind::home, {0})}, bench.now, bench.events);
    CHECK(bench.until_idle() == doctest::Approx(150.0 / 20 + 4));
}

TEST_CASE("motion: one long step or many short ones come to the same") {
    Bench coarse;
    Bench fine;
    for (Bench* bench : {&coarse, &fine}) {
        bench->motion.set_relative(true);
        for (int i = 0; i < 40; ++i) {
            bench->move(i % 7, i % 5, 0.1, {}, 600 + 100 * i);
        }
    }
    coarse.pass(20);
    for (int i = 0; i < 20000; ++i) {
        fine.pass(0.001);
    }
    CHECK(coarse.x() == fine.x());
    CHECK(coarse.motion.feed_mm_s() == fine.motion.feed_mm_s());
    CHECK(coarse.motion.next_event() == fine.motion.next_event());
}
