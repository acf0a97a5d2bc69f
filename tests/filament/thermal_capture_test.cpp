// The nozzle against a public recording of a real A30T's screen line, read in place where it is at hand.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "emulator/filament/thermal.h"
#include "emulator/filament/thermal_crosstalk.h"
#include "emulator/filament/thermal_fold.h"

using namespace fauxboard::filament;

namespace {

// What was done to the recorded board, s since its first line.
constexpr double heat_on_s = 43.45;
constexpr double heat_off_s = 283.40;
constexpr double reset_s = 347.65;
// A line's time is that of its end on the recording PC.
constexpr double line_delay_s = 0.04;

struct Sample {
    double t;
    double c;
};

/// What stands behind `key` in a temperature line; 0 when it is none.
double printed_in(const std::string& line, const std::string& key) {
    const std::size_t field = line.find(key);
    if (field == std::string::npos || line.find("L2 B:") == std::string::npos) return 0;
    return std::stod(line.substr(field + key.size()));
}

/// A printed .0 means T = P, or P - 2 for a temperature just above a degree: whichever suits its neighbours.
void settle_ambiguous(std::vector<Sample>& samples) {
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        Sample& s = samples[i];
        const double expected = (samples[i - 1].c + samples[i + 1].c) / 2;
        if (s.c == std::floor(s.c) && std::fabs(s.c - 2 - expected) < std::fabs(s.c - expected)) s.c -= 2;
    }
}

/// The true temperatures of one channel of the recording; empty when it is not there.
std::vector<Sample> recorded(const std::string& key) {
    std::ifstream file(FAUXBOARD_SOURCE_DIR "/../shared/captures/a30t-boot-heat-load-home.jsonl");
    std::vector<Sample> samples;
    for (std::string line; std::getline(file, line);) {
        const double printed = printed_in(line, key);
        if (printed > 0) samples.push_back({std::stod(line.substr(6)), unfold_temperature(printed)});
    }
    settle_ambiguous(samples);
    return samples;
}

struct Errors {
    double squares = 0;
    double largest = 0;
    int n = 0;
    void add(double error) {
        squares += error * error;
        largest = std::max(largest, std::fabs(error));
        ++n;
    }
    double rms() const { return std::sqrt(squares / n); }
};

}  // namespace

TEST_CASE("thermal: the nozzle heats, overshoots, holds and cools like the recorded one") {
    const std::vector<Sample> samples = recorded(" T0:");
    if (samples.empty()) {
        MESSAGE("skipped: no recording at ../shared/captures");
        return;
    }
    REQUIRE(samples.size() > 150);
    const ThermalConfig config;
    for (const int phase_ms :
         {0, 75, 150, 225}) {  // of the measurement grid, which the recording does not show
        CAPTURE(phase_ms);
        Thermal thermal(config, 1);
        thermal.power_on(SimTime{phase_ms * 1000});
        bool heated = false;
        bool cooled = false;
        bool reset = false;
        const auto once_at = [&](double when_s, double now_s, bool& done, auto action) {
            if (done || now_s < when_s) return;
            thermal.advance(from_seconds(when_s));
            action();
            done = true;
        };
        Errors heating;
        Errors controlled;
        Errors cooling;
        Errors cooling_all;
        for (const Sample& sample : samples) {
            const double now_s = sample.t - line_delay_s;
            once_at(heat_on_s, now_s, heated, [&] { thermal.set_target(HeaterId::nozzle, 200); });
            once_at(heat_off_s, now_s, cooled, [&] { thermal.set_target(HeaterId::nozzle, 0); });
            once_at(reset_s, now_s, reset, [&] { thermal.power_on(from_seconds(reset_s)); });
            thermal.advance(from_seconds(now_s));
            const double error = thermal.temperature_c(HeaterId::nozzle) - sample.c;
            if (heated && !cooled) {
                controlled.add(error);
                if (sample.t < 172) heating.add(error);
            }
            if (cooled) {
                cooling_all.add(error);
                if (!reset) cooling.add(error);
            }
        }
        MESSAGE("rms K: heating " << heating.rms() << ", all of 43..283 s " << controlled.rms()
                                  << ", cooling " << cooling.rms() << ", with the time after the reset "
                                  << cooling_all.rms());
        CHECK(heating.n > 50);
        CHECK(heating.rms() < 0.6);
        CHECK(controlled.rms() < 0.8);
        CHECK(controlled.largest < 1.5);
        CHECK(cooling.rms() < 0.8);
        CHECK(cooling_all.rms() < 0.8);
    }
}

TEST_CASE(
    "thermal: the inputs without sensor read what the recorded ones did at the same nozzle temperature") {
    const std::vector<Sample> nozzle = recorded(" T0:");
    const ThermalConfig config;
    for (const auto& [key, input] : {std::pair{" T1:", &config.t1}, std::pair{" T2:", &config.t2}}) {
        const std::vector<Sample> samples = recorded(key);
        if (samples.empty()) {
            MESSAGE("skipped: no recording at ../shared/captures");
            return;
        }
        REQUIRE(samples.size() == nozzle.size());
        Errors errors;
        int far = 0;  // around a jump a small error of the nozzle is a large one here
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double error = cross_talk_c(*input, nozzle[i].c) - samples[i].c;
            if (std::fabs(error) > 3) {
                ++far;
            } else {
                errors.add(error);
            }
        }
        MESSAGE(std::string(key) << " rms K: " << errors.rms() << ", beyond a jump: " << far);
        CHECK(errors.rms() < 1);
        CHECK(far <= 6);
    }
}

TEST_CASE("thermal: the nozzle's false peak, sag and overshoot on the way to 200") {
    // Recorded: 192.6..193 at 134..138 s, 189.9 at 144 s, 201.1 at 168 s, within 1 K from about 185 s.
    const ThermalConfig config;
    Thermal thermal(config, 1);
    thermal.power_on(SimTime{0});
    thermal.set_target(HeaterId::nozzle, 200);
    double peak_c = 0;
    double sag_c = 1000;
    double overshoot_c = 0;
    double overshoot_s = 0;
    for (double t = 0.3; t < 240; t += 0.3) {
        thermal.advance(from_seconds(t));
        const double c = thermal.temperature_c(HeaterId::nozzle);
        if (t < 142) peak_c = std::max(peak_c, c);
        if (t > 136 && t < 152) sag_c = std::min(sag_c, c);
        if (t > 152 && c > overshoot_c) {
            overshoot_c = c;
            overshoot_s = t;
        }
        if (t > 190) REQUIRE(std::fabs(c - 199.1) < 2);
    }
    CHECK(peak_c == doctest::Approx(192.8).epsilon(0.004));
    CHECK(sag_c == doctest::Approx(189.9).epsilon(0.005));
    CHECK(overshoot_c == doctest::Approx(201.1).epsilon(0.003));
    CHECK(overshoot_s == doctest::Approx(168).epsilon(0.03));
}
