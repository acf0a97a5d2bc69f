#include "emulator/filament/planner.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "emulator/filament/arc.h"

using namespace fauxboard::filament;

namespace {

/// Runs moves through a planner that is kept full, as a job does, and gives the seconds they take.
class Bench {
  public:
    explicit Bench(Settings settings = {}, std::size_t blocks = 16)
        : settings_(settings), planner_(settings_) {
        planner_.set_blocks(blocks);
    }

    void to(double x, double y, double z, double e, double feed) {
        moves_.push_back({{}, {x, y, z, e}, feed, 0});
    }

    double run() {
        SimTime now{0};
        std::size_t next = 0;
        AxisValues at{};
        ends_.clear();
        while (next < moves_.size() || !planner_.empty()) {
            while (next < moves_.size() && !planner_.full()) {
                Planner::Move move = moves_[next++];
                move.from = at;
                planner_.add(move);
            }
            if (planner_.empty()) {
                break;
            }
            planner_.start(now);
            REQUIRE(planner_.end() >= now);
            now = planner_.end();
            at = planner_.target();
            planner_.finish();
            ends_.push_back(to_seconds(now));
        }
        at_ = at;
        return to_seconds(now);
    }

    const std::vector<double>& ends() const { return ends_; }
    const AxisValues& at() const { return at_; }

  private:
    Settings settings_;
    Planner planner_;
    std::vector<Planner::Move> moves_;
    std::vector<double> ends_;
    AxisValues at_{};
};

constexpr double jerk = 7;            // mm/s, X and Y
constexpr double acceleration = 500;  // mm/s^2

}  // namespace

TEST_CASE("planner: a lone move starts and ends by the jerk, and is a trapezoid in between") {
    Bench bench;
    bench.to(100, 0, 0, 0, 50);
    const double up = (50 - jerk) / acceleration;
    const double up_mm = (50 * 50 - jerk * jerk) / (2 * acceleration);
    const double down = 50 / acceleration;
    const double down_mm = 50 * 50 / (2 * acceleration);
    CHECK(bench.run() == doctest::Approx(up + down + (100 - up_mm - down_mm) / 50).epsilon(0.002));
}

TEST_CASE("planner: a short move never reaches its feed") {
    Bench bench;
    bench.to(1, 0, 0, 0, 100);
    const double peak = std::sqrt(acceleration + jerk * jerk / 2);
    CHECK(bench.run() == doctest::Approx((2 * peak - jerk) / acceleration).epsilon(0.005));
}

TEST_CASE("planner: a line cut into pieces takes as long as in one") {
    Bench whole;
    whole.to(100, 50, 0, 4, 60);
    Bench pieces;
    for (int i = 1; i <= 200; ++i) {
        pieces.to(i * 0.5, i * 0.25, 0, i * 0.02, 60);
    }
    // 16 blocks of 0.56 mm are less than the 3.6 mm that braking from 60 mm/s takes: no difference.
    CHECK(pieces.run() == doctest::Approx(whole.run()).epsilon(0.001));
}

TEST_CASE("planner: what lies within its blocks bounds the speed; more blocks are faster") {
    const auto seconds = [](std::size_t blocks) {
        Bench bench({}, blocks);
        for (int i = 1; i <= 1000; ++i) {
            bench.to(i * 0.1, 0, 0, 0, 100);
        }
        return bench.run();
    };
    const double v16 = std::sqrt(2 * acceleration * 1.5);  // 15 blocks of 0.1 mm to brake in
    CHECK(seconds(16) == doctest::Approx(100 / v16).epsilon(0.05));
    CHECK(seconds(64) < seconds(16) * 0.65);
    CHECK(seconds(2) > seconds(16) * 2);
}

TEST_CASE("planner: a corner is taken at the jerk, a turn about as good as stopping") {
    Bench straight;
    straight.to(50, 0, 0, 0, 60);
    straight.to(100, 0, 0, 0, 60);
    Bench corner;
    corner.to(50, 0, 0, 0, 60);
    corner.to(50, 50, 0, 0, 60);
    Bench back;
    back.to(50, 0, 0, 0, 60);
    back.to(0, 0, 0, 0, 60);
    const double lost =
        2 * (60 - jerk) / acceleration - 2 * (60 * 60 - jerk * jerk) / (2 * acceleration * 60);
    CHECK(corner.run() - straight.run() == doctest::Approx(lost).epsilon(0.01));
    CHECK(back.run() >= corner.run() - 1e-6);
}

TEST_CASE("planner: each axis keeps its velocity and acceleration") {
    Bench z;
    z.to(0, 0, 20, 0, 100);  // 20 mm/s and 50 mm/s^2 at most
    CHECK(z.run() == doctest::Approx(20 / 20.0 + 20 / 50.0).epsilon(0.03));
    Bench e;
    e.to(0, 0, 0, 50, 100);  // 25 mm/s
    CHECK(e.run() == doctest::Approx(50 / 25.0).epsilon(0.05));
    Settings slow;
    slow.min_velocity_mm_s = 10;
    slow.min_travel_mm_s = 20;
    Bench crawl(slow);
    crawl.to(100, 0, 0, 0, 0.001);
    CHECK(crawl.run() == doctest::Approx(100 / 20.0).epsilon(0.02));
    Bench crawl_e(slow);
    crawl_e.to(100, 0, 0, 1, 0.001);
    CHECK(crawl_e.run() == doctest::Approx(100 / 10.0).epsilon(0.02));
}

TEST_CASE("planner: moves of fewer than six steps are no moves, and their way is not lost") {
    Bench bench;
    for (int i = 1; i <= 1000; ++i) {
        bench.to(i * 0.01, 0, 0, 0, 50);  // 0.8 steps each
    }
    bench.run();
    CHECK(bench.ends().size() == 125);  // eight to 6.4 steps
    CHECK(bench.at()[0] == doctest::Approx(10.0).epsilon(1e-9));
}

TEST_CASE("planner: the microseconds' rounding does not add up") {
    Bench bench;
    for (int i = 1; i <= 100'000; ++i) {
        bench.to(i * 0.1, 0, 0, 0, 10);
    }
    CHECK(bench.run() == doctest::Approx(1000).epsilon(1e-4));
}

TEST_CASE("planner: settings of 0, and moves of any size, end") {
    Settings zero;
    zero.velocity_mm_s = zero.max_acceleration_mm_s2 = zero.jerk_mm_s = {0, 0, 0, 0};
    zero.acceleration_mm_s2 = zero.retract_acceleration_mm_s2 = zero.min_velocity_mm_s =
        zero.min_travel_mm_s = 0;
    Bench bench(zero);
    bench.to(1, 1, 1, 1, 0);
    bench.to(1e5, -1e5, 1e5, 1e9, 1e9);
    CHECK(std::isfinite(bench.run()));
}

TEST_CASE("planner: G92 shifts what waits") {
    const Settings settings;
    Planner planner(settings);
    planner.add({{}, {10, 0, 0, 5}, 50, 1});
    planner.add({{}, {20, 0, 0, 6}, 50, 2});
    planner.start(SimTime{0});
    planner.shift(3, -6);
    CHECK(planner.target() == AxisValues{10, 0, 0, -1});
    CHECK(planner.byte(9) == 1);
    planner.finish();
    CHECK(planner.target() == AxisValues{20, 0, 0, 0});
    CHECK(planner.byte(9) == 2);
}

TEST_CASE("planner: the job's place is that of its first move, whoever's moves are before it") {
    const Settings settings;
    Planner planner(settings);
    planner.add({{}, {10, 0, 0, 0}, 50});
    CHECK(planner.byte(9) == 9);
    planner.add({{}, {20, 0, 0, 0}, 50, 2});
    planner.add({{}, {30, 0, 0, 0}, 50, 3});
    CHECK(planner.byte(9) == 2);
    planner.disown();
    CHECK(planner.byte(9) == 9);
}

TEST_CASE("planner: a trapezoid from and to any speed") {
    CHECK(trapezoid_seconds(100, 10, 10, 10, 500) == doctest::Approx(10));
    CHECK(trapezoid_seconds(15, 0, 10, 0, 10) == doctest::Approx(2.5));
    CHECK(trapezoid_seconds(10, 0, 100, 0, 10) == doctest::Approx(2.0));
    CHECK(trapezoid_seconds(7.5, 5, 100, 10, 5) == doctest::Approx(1.0));  // up all the way
}

TEST_CASE("arc: segments of about a millimetre, all on the circle, the last at the end") {
    ArcSegments arc;
    ArcSegments::Request request;
    request.from = {10, 0, 0, 0};
    request.to = {0, 10, 2, 4};
    request.i = -10;
    REQUIRE(arc.begin(request));
    AxisValues at{};
    int count = 0;
    double z = 0;
    for (; arc.active(); ++count) {
        at = arc.take();
        CHECK(std::hypot(at[0], at[1]) == doctest::Approx(10).epsilon(1e-9));
        CHECK(at[0] > -1e-9);  // the short way, counter-clockwise
        CHECK(at[2] >= z);
        z = at[2];
    }
    CHECK(count == 15);  // 15.7 mm
    CHECK(at == request.to);
    request.clockwise = true;
    REQUIRE(arc.begin(request));
    for (count = 0; arc.active(); ++count) {
        arc.take();
    }
    CHECK(count == 47);  // three quarters
}

TEST_CASE("arc: to its own start it is a full circle; by radius either way round") {
    const auto length = [](const ArcSegments::Request& request) {
        ArcSegments arc;
        AxisValues at = request.from;
        double sum = 0;
        REQUIRE(arc.begin(request));
        while (arc.active()) {
            const AxisValues next = arc.take();
            sum += std::hypot(next[0] - at[0], next[1] - at[1]);
            at = next;
        }
        return sum;
    };
    constexpr double circle = 2 * std::numbers::pi * 20;
    ArcSegments::Request request;
    request.from = request.to = {50, 50, 0, 0};
    request.i = 20;
    CHECK(length(request) == doctest::Approx(circle).epsilon(0.002));
    request.i = 0;
    request.to = {70, 70, 0, 0};
    for (const bool clockwise : {false, true}) {
        request.clockwise = clockwise;
        request.radius = 20;
        CHECK(length(request) == doctest::Approx(circle / 4).epsilon(0.002));
        request.radius = -20;
        CHECK(length(request) == doctest::Approx(circle * 3 / 4).epsilon(0.002));
    }
    request.radius = 5;  // cannot reach: half a circle, as in Marlin
    CHECK(length(request) == doctest::Approx(std::hypot(20, 20) / 2 * std::numbers::pi).epsilon(0.002));
    ArcSegments arc;
    request.radius = 0;
    CHECK_FALSE(arc.begin(request));
    CHECK_FALSE(arc.active());
    request.radius = 5;  // from where it stands to there
    const AxisValues to = request.to;
    request.to = request.from;
    CHECK_FALSE(arc.begin(request));
    request.to = to;
    request.radius = 0;
    request.i = 1e9;  // bounded, whatever comes
    CHECK_FALSE(arc.begin(request));
    request.i = 1e6;
    CHECK(arc.begin(request));
}
