#include "emulator/filament/thermal.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "emulator/filament/thermal_crosstalk.h"
#include "emulator/filament/thermal_fold.h"

using namespace fauxboard::filament;

namespace {

constexpr std::uint64_t seed = 7;

std::string one_decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

std::string printed(const Thermal& thermal) {
    return "B:" + one_decimal(thermal.printed_c(ThermalChannel::bed)) +
           " T0:" + one_decimal(thermal.printed_c(ThermalChannel::t0)) +
           " T1:" + one_decimal(thermal.printed_c(ThermalChannel::t1)) +
           " T2:" + one_decimal(thermal.printed_c(ThermalChannel::t2));
}

/// Everything that can be seen, to the last bit.
bool same(const Thermal& a, const Thermal& b) {
    bool equal = a.next_measurement() == b.next_measurement() && a.settled() == b.settled() &&
                 a.moved_since_report() == b.moved_since_report();
    for (const auto channel :
         {ThermalChannel::bed, ThermalChannel::t0, ThermalChannel::t1, ThermalChannel::t2}) {
        equal = equal && a.printed_c(channel) == b.printed_c(channel);
    }
    for (const auto id : {HeaterId::nozzle, HeaterId::bed}) {
        equal = equal && a.temperature_c(id) == b.temperature_c(id) && a.power(id) == b.power(id);
    }
    return equal;
}

/// A small random generator for the tests' own choices.
struct Dice {
    std::uint64_t state;
    std::uint64_t below(std::uint64_t n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return (state >> 33) % n;
    }
};

}  // namespace

TEST_CASE("thermal: folding mirrors the fraction inside a degree and can be undone") {
    CHECK(fold_temperature(28.0) == 28.0);
    CHECK(fold_temperature(27.3) == doctest::Approx(28.7));
    CHECK(fold_temperature(199.1) == doctest::Approx(200.9));
    CHECK(unfold_temperature(28.7) == doctest::Approx(27.3));
    CHECK(unfold_temperature(28.0) == 28.0);
    CHECK(fold_temperature(quantise(-0.4, 10)) == doctest::Approx(0.4));
    for (const int counts : {1, 7, 15}) {
        for (int n = -20 * counts; n <= 300 * counts; ++n) {
            const double c = static_cast<double>(n) / counts;
            REQUIRE(quantise(c, counts) == c);
            REQUIRE(unfold_temperature(fold_temperature(c)) == doctest::Approx(c).epsilon(1e-12));
        }
    }
}

TEST_CASE(
    "thermal: readings are 0.0 until the first measurement, and the first bed reading is a count high") {
    const ThermalConfig config;
    Thermal thermal(config, seed);
    CHECK(thermal.next_measurement() == never);
    thermal.advance(from_seconds(1000));
    CHECK(printed(thermal) == "B:0.0 T0:0.0 T1:0.0 T2:0.0");
    thermal.power_on(from_seconds(1000));
    thermal.advance(from_seconds(1000.299));
    CHECK(printed(thermal) == "B:0.0 T0:0.0 T1:0.0 T2:0.0");
    CHECK_FALSE(thermal.moved_since_report());
    CHECK(thermal.next_measurement() == from_seconds(1000.3));
    thermal.advance(from_seconds(1000.3));
    CHECK(printed(thermal) == "B:23.9 T0:22.3 T1:88.6 T2:106.0");
    CHECK(thermal.moved_since_report());
    thermal.mark_reported();
    CHECK_FALSE(thermal.moved_since_report());
    thermal.advance(from_seconds(1000.6));
    CHECK(printed(thermal) == "B:22.0 T0:22.3 T1:88.6 T2:106.0");
    CHECK(thermal.moved_since_report());
    CHECK(thermal.settled());
    CHECK(thermal.next_measurement() == never);
}

TEST_CASE("thermal: targets are kept within bounds") {
    const ThermalConfig config;
    Thermal thermal(config, seed);
    thermal.power_on(SimTime{0});
    CHECK_FALSE(thermal.set_target(HeaterId::nozzle, 200));
    CHECK(thermal.target_c(HeaterId::nozzle) == 200);
    CHECK(thermal.heating(HeaterId::nozzle));
    CHECK(thermal.set_target(HeaterId::nozzle, 1000));
    CHECK(thermal.target_c(HeaterId::nozzle) == config.nozzle.max_target_c);
    CHECK(thermal.set_target(HeaterId::bed, -5));
    CHECK(thermal.target_c(HeaterId::bed) == 0);
    CHECK(thermal.set_target(HeaterId::bed, std::nan("")));
    CHECK_FALSE(thermal.heating(HeaterId::bed));
    CHECK_FALSE(thermal.set_target(HeaterId::bed, config.bed.max_target_c));
    CHECK_FALSE(thermal.set_target(HeaterId::bed, 0));
}

TEST_CASE("thermal: every target that can be set is reached, and held") {
    const ThermalConfig config;
    for (const auto& [id, highest_c] : {std::pair(HeaterId::nozzle, config.nozzle.max_target_c),
                                        std::pair(HeaterId::bed, config.bed.max_target_c)}) {
        for (double target_c = 50; target_c <= highest_c; target_c += 10) {
            CAPTURE(target_c);
            Thermal thermal(config, seed);
            thermal.power_on(SimTime{0});
            thermal.set_target(id, target_c);
            thermal.advance(std::chrono::minutes(20));
            CHECK(thermal.reached(id));
            thermal.advance(std::chrono::minutes(60));
            CHECK(thermal.temperature_c(id) == doctest::Approx(target_c).epsilon(0.03));
        }
    }
}

TEST_CASE("thermal: any splitting of time gives the same bits") {
    const ThermalConfig config;
    Thermal whole(config, seed);
    Thermal split(config, seed);
    Dice dice{99};
    const auto step_split = [&](SimTime from, SimTime to) {
        for (SimTime t = from; t < to; t += SimTime{static_cast<SimTime::rep>(dice.below(900'000))}) {
            split.advance(t);
        }
        split.advance(to);
    };
    SimTime now{12'345};
    whole.power_on(now);
    split.power_on(now);
    const double nozzle_targets[] = {200, 0, 180, 240, 0, 60};
    for (int round = 0; round < 6; ++round) {
        const double target = nozzle_targets[round];
        whole.set_target(HeaterId::nozzle, target);
        split.set_target(HeaterId::nozzle, target);
        whole.set_target(HeaterId::bed, target / 3);
        split.set_target(HeaterId::bed, target / 3);
        const SimTime end = now + SimTime{static_cast<SimTime::rep>(dice.below(300'000'000))};
        whole.advance(end);
        step_split(now, end);
        now = end;
        REQUIRE(same(whole, split));
        if (round == 3) {
            whole.power_on(now);
            split.power_on(now);
        }
        if (round == 1) {
            whole.mark_reported();
            split.mark_reported();
        }
    }
}

TEST_CASE("thermal: the seed decides the noise, and nothing else") {
    ThermalConfig config;
    config.nozzle.plant.noise_c = 0;
    config.t1.noise_wander_s = 0;
    Thermal a(config, 1);
    Thermal b(config, 1);
    Thermal c(config, 2);
    bool noise_differs = false;
    double sum = 0;
    double squares = 0;
    int n = 0;
    for (Thermal* thermal : {&a, &b, &c}) {
        thermal->power_on(SimTime{0});
        thermal->set_target(HeaterId::nozzle, 200);
    }
    for (int k = 1; k < 4000; ++k) {
        for (Thermal* thermal : {&a, &b, &c})
            thermal->advance(config.period * k);
        REQUIRE(same(a, b));
        REQUIRE(a.printed_c(ThermalChannel::t0) == c.printed_c(ThermalChannel::t0));
        noise_differs = noise_differs || a.printed_c(ThermalChannel::t1) != c.printed_c(ThermalChannel::t1);
        if (k < 1500) continue;
        const double t1 = unfold_temperature(a.printed_c(ThermalChannel::t1)) -
                          cross_talk_c(config.t1, a.temperature_c(HeaterId::nozzle));
        sum += t1;
        squares += t1 * t1;
        ++n;
    }
    CHECK(noise_differs);
    CHECK(sum / n == doctest::Approx(0).epsilon(0.02));
    CHECK(std::sqrt(squares / n) == doctest::Approx(0.13).epsilon(0.15));
}

TEST_CASE(
    "thermal: noise that wanders differs little from one measurement to the next, and as much in the long "
    "run") {
    double largest = 0;
    double farthest = 0;
    for (std::uint64_t i = 1; i < 20'000; ++i) {
        const double here = wandering_noise(3, 2, i, 200);
        largest = std::max(largest, std::fabs(here - wandering_noise(3, 2, i - 1, 200)));
        farthest = std::max(farthest, std::fabs(here));
    }
    CHECK(largest < 0.04);
    CHECK(farthest > 1.5);
    CHECK(wandering_noise(3, 2, 77, 1) == measurement_noise(3, 2, 77));
}

TEST_CASE("thermal: a long hold at 200 cools as a short one does, and reports as often as recorded") {
    const ThermalConfig config;
    for (const double hold_s : {400.0, 3000.0}) {
        Thermal thermal(config, 1);
        thermal.power_on(SimTime{0});
        thermal.set_target(HeaterId::nozzle, 200);
        thermal.set_target(HeaterId::bed, 50);
        SimTime now{0};
        int slots = 0;
        int reports = 0;
        while (now < from_seconds(hold_s)) {
            now += from_seconds(2.0996);
            thermal.advance(now);
            if (now < from_seconds(900)) continue;
            ++slots;
            if (thermal.moved_since_report()) {
                ++reports;
                thermal.mark_reported();
            }
        }
        if (slots != 0) {
            CHECK(static_cast<double>(reports) / slots == doctest::Approx(695.0 / 1436).epsilon(0.1));
        }
        thermal.set_target(HeaterId::nozzle, 0);
        thermal.advance(now + from_seconds(103));
        CHECK(std::fabs(thermal.temperature_c(HeaterId::nozzle) - 138) < 1.5);
    }
}

TEST_CASE("thermal: inputs without sensor follow the nozzle by their table, jumps included") {
    const ThermalConfig config;
    CHECK(cross_talk_c(config.t1, 0) == 87.4);
    CHECK(cross_talk_c(config.t1, 32) == doctest::Approx(89.45));
    CHECK(cross_talk_c(config.t1, 110.599) == doctest::Approx(120.5).epsilon(0.001));
    CHECK(cross_talk_c(config.t1, 110.6) == 111.5);
    CHECK(cross_talk_c(config.t2, 101.749) == doctest::Approx(120.3).epsilon(0.001));
    CHECK(cross_talk_c(config.t2, 101.75) == 109.9);
    CHECK(cross_talk_c(config.t2, 110.6) == 118.2);
    CHECK(cross_talk_c(config.t2, 122.15) == 110.6);
    CHECK(cross_talk_c(config.t2, 300) == 121.2);
    CHECK(cross_talk_c(SensorlessInputConfig{}, 50) == 0);
    for (const auto* input : {&config.t1, &config.t2}) {
        for (std::size_t i = 1; i < input->points.size(); ++i) {
            CHECK(input->points[i - 1].source_c <= input->points[i].source_c);
        }
    }
}

TEST_CASE("thermal: left alone it comes to rest, and rest costs nothing") {
    const ThermalConfig config;
    Thermal thermal(config, seed);
    thermal.power_on(SimTime{0});
    thermal.set_target(HeaterId::nozzle, 210);
    thermal.set_target(HeaterId::bed, 60);
    thermal.advance(from_seconds(900));
    CHECK_FALSE(thermal.settled());
    thermal.set_target(HeaterId::nozzle, 0);
    thermal.set_target(HeaterId::bed, 0);
    CHECK_FALSE(thermal.settled());
    thermal.advance(from_seconds(86'400));
    CHECK(thermal.settled());
    CHECK(thermal.temperature_c(HeaterId::nozzle) == config.nozzle.plant.ambient_c);
    CHECK(thermal.temperature_c(HeaterId::bed) == config.bed.plant.ambient_c);
    thermal.mark_reported();

    Thermal reference = thermal;
    const SimTime later = from_seconds(86'400 + 10 * 365.25 * 86'400);
    thermal.advance(later);
    CHECK(thermal.settled());
    CHECK_FALSE(thermal.moved_since_report());
    CHECK(printed(thermal) == "B:22.0 T0:22.3 T1:88.6 T2:106.0");
    // The grid goes on where it was, in one jump or in many.
    for (int year = 1; year <= 10; ++year)
        reference.advance(later - from_seconds((10 - year) * 1e6));
    CHECK_FALSE(thermal.set_target(HeaterId::nozzle, 100));
    reference.set_target(HeaterId::nozzle, 100);
    CHECK(thermal.next_measurement() > later);
    CHECK(thermal.next_measurement() <= later + config.period);
    CHECK(thermal.next_measurement() % config.period == SimTime{0});
    thermal.advance(later + from_seconds(100));
    reference.advance(later + from_seconds(100));
    CHECK(same(thermal, reference));
}

TEST_CASE("thermal: a day with both heaters on") {
    const ThermalConfig config;
    Thermal thermal(config, seed);
    thermal.power_on(SimTime{0});
    thermal.set_target(HeaterId::nozzle, 200);
    thermal.set_target(HeaterId::bed, 50);
    thermal.advance(from_seconds(86'400));
    CHECK(thermal.temperature_c(HeaterId::nozzle) == doctest::Approx(199.1).epsilon(0.005));
    CHECK(thermal.temperature_c(HeaterId::bed) == doctest::Approx(49.05).epsilon(0.004));
    CHECK(thermal.reached(HeaterId::nozzle));
    CHECK(thermal.reached(HeaterId::bed));
}

TEST_CASE("thermal: power-on forgets the controller and keeps the heat, also between two measurements") {
    const ThermalConfig config;
    Thermal thermal(config, seed);
    thermal.power_on(SimTime{0});
    thermal.set_target(HeaterId::nozzle, 200);
    thermal.advance(from_seconds(60));
    const double before = thermal.temperature_c(HeaterId::nozzle);
    thermal.power_on(from_seconds(60.13));
    CHECK(thermal.target_c(HeaterId::nozzle) == 0);
    CHECK(thermal.power(HeaterId::nozzle) == 0);
    CHECK(thermal.printed_c(ThermalChannel::t0) == 0);
    CHECK(thermal.reached(HeaterId::bed));
    CHECK(thermal.next_measurement() == from_seconds(60.43));
    CHECK(thermal.temperature_c(HeaterId::nozzle) > before);
    CHECK(thermal.temperature_c(HeaterId::nozzle) < before + 0.3);
    thermal.advance(from_seconds(61));
    CHECK(thermal.temperature_c(HeaterId::nozzle) > before);
}

TEST_CASE(
    "thermal: a reset at any moment changes the curve by no more than a rounding of the outputs on their "
    "way") {
    const ThermalConfig config;
    Thermal plain(config, seed);
    plain.power_on(SimTime{0});
    plain.set_target(HeaterId::nozzle, 200);
    plain.advance(from_seconds(60));
    Thermal reset = plain;
    plain.set_target(HeaterId::nozzle, 0);
    plain.advance(from_seconds(60.3));
    reset.power_on(from_seconds(60.29));
    plain.advance(from_seconds(90));
    reset.advance(from_seconds(90));
    CHECK(std::fabs(plain.temperature_c(HeaterId::nozzle) - reset.temperature_c(HeaterId::nozzle)) < 0.2);
}

TEST_CASE("thermal: a watched channel that moves by 1.0 or more asks for a report") {
    ThermalConfig config;
    config.fold = false;
    Thermal thermal(config, seed);
    thermal.power_on(SimTime{0});
    thermal.advance(from_seconds(0.6));
    thermal.mark_reported();
    thermal.set_ambient(22.8);
    thermal.set_temperature(HeaterId::nozzle, 22.4);
    thermal.set_temperature(HeaterId::bed, 22.9);
    thermal.advance(from_seconds(0.9));
    CHECK_FALSE(thermal.moved_since_report());
    thermal.set_temperature(HeaterId::bed, 23.0);
    thermal.advance(from_seconds(1.2));
    CHECK_FALSE(thermal.moved_since_report());  // it is told one measurement later
    thermal.set_temperature(HeaterId::bed, 22.0);
    thermal.advance(from_seconds(1.5));
    CHECK(thermal.moved_since_report());
    thermal.advance(from_seconds(1.8));
    CHECK_FALSE(thermal.moved_since_report());  // and forgotten when it was over before the slot came
}

TEST_CASE("thermal: a dead time that is no multiple of the period is exact") {
    // A pure integrator: after dead time d at full power the mass has risen by rate * (t - d).
    const PlantConfig plant{.heating_k_per_s = 1, .sensor_lag_s = 0.01, .dead_time_s = 0.75, .ambient_c = 20};
    ThermalPlant heated(plant, from_seconds(0.3));
    for (int i = 0; i < 100; ++i)
        heated.step(1, true);
    CHECK(heated.sensor_c() == doctest::Approx(20 + 30 - 0.75 - 0.01).epsilon(1e-9));
    for (int i = 0; i < 10; ++i)
        heated.step(0, true);
    CHECK(heated.sensor_c() == doctest::Approx(50).epsilon(1e-9));
    CHECK_FALSE(heated.settle(1));
}

TEST_CASE("thermal: the bed of the A30T") {
    // The recorded M190 S50: 160 s until it prints 47, overshoot 53.2, then 49.0..49.1 for good.
    const ThermalConfig config;
    Thermal thermal(config, seed);
    thermal.power_on(SimTime{0});
    thermal.set_target(HeaterId::bed, 50);
    double done_s = 0;
    double highest_c = 0;
    for (int k = 1; k <= 5000; ++k) {
        thermal.advance(config.period * k);
        const double c = thermal.temperature_c(HeaterId::bed);
        if (done_s == 0 && thermal.reached(HeaterId::bed)) done_s = 0.3 * k;
        highest_c = std::max(highest_c, c);
        if (k > 2000) {
            REQUIRE(c > 48.9);
            REQUIRE(c < 49.2);
        }
    }
    CHECK(done_s == doctest::Approx(159.9).epsilon(0.02));
    CHECK(highest_c > 51.8);
    CHECK(highest_c < 53.5);
    thermal.set_target(HeaterId::bed, 0);
    const SimTime off = config.period * 5000;
    SimTime at_49 = off;
    SimTime at_46 = off;
    for (int k = 5001; k <= 6000; ++k) {
        thermal.advance(config.period * k);
        if (thermal.temperature_c(HeaterId::bed) > 49) at_49 = config.period * k;
        if (thermal.temperature_c(HeaterId::bed) > 46) at_46 = config.period * k;
    }
    CHECK(to_seconds(at_46 - at_49) == doctest::Approx(119).epsilon(0.05));
}
