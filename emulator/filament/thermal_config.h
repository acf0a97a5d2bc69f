#pragma once

#include <vector>

#include "emulator/filament/names.h"

namespace fauxboard::filament {

// Everything the thermal part can be told. Plain values; the defaults are a Geeetech A30T (Smartto V1.xx.03),
// fitted to a public recording of its screen line (GeeetechA30T, 2021-04-21).
//
// Temperatures in these structs are true ones, in degrees Celsius. What the board prints is another matter:
// see thermal_fold.h.

/// One heater and what it heats: two masses (the heated one, T1, and one behind it, T2), a lagging sensor, a
/// dead time.
///   T1' = heating * power(t - dead_time) - exchange_a * (T1 - T2) - loss * (T1 - ambient)
///   T2' = exchange_b * (T1 - T2) - loss_behind * (T2 - ambient)
///   sensor' = (T1 - sensor) / sensor_lag
/// All rates >= 0. Multiply heating_k_per_s by the heat capacity for watts.
struct PlantConfig {
    double heating_k_per_s{0};
    double exchange_a_per_s{0};
    double exchange_b_per_s{0};
    /// What the second mass loses: without it, it would come to be as hot as the first one in a long print.
    double loss_behind_per_s{0};
    /// The loss while the heater has a target, and while it has none: the recording fits two different
    /// values.
    double loss_on_per_s{0};
    double loss_off_per_s{0};
    /// Time constant of the sensor, >= 0.01 s (less is taken as 0.01).
    double sensor_lag_s{1};
    /// From the heater's output to its first effect, 0..60 s; need not be a multiple of the measurement
    /// period.
    double dead_time_s{0};
    double ambient_c{22.0};
    /// Grain of the reading: ADC counts per degree, >= 1 (nozzle 7, bed 15).
    int counts_per_c{1};
    /// Standard deviation of the reading, while the heater has a target; cold and idle there is none.
    double noise_c{0};
    /// The first reading after power-on is this much high (bed: one count; the A30T prints 23.9, then 22.0).
    double first_reading_offset_c{0};
};

/// The firmware's controller: see thermal_pid.h.
struct PidConfig {
    double kp{0};
    double ki{0};
    double kd{0};
    /// Weight of the newest slope in the D term, 0..1.
    double k1{1};
    /// Full power while the error is larger than this.
    double range_c{0};
    /// No power while the error is below minus this.
    double off_below_c{10};
    /// The output that is full power, > 0.
    double max_output{4095};
};

/// How the board finds out that a heater or its sensor is broken: as Marlin does, with numbers of its own
/// kind. None of them is a recorded fact of the A30T; they are such that nothing it does when it is well
/// comes near them.
struct ProtectionConfig {
    /// A heater that is on and reads less is too cold: a broken wire. More than max_c is too hot, on or off.
    double min_c{5};
    double max_c{275};
    /// Heating up, it must rise by watch_rise_c in each watch_s.
    double watch_s{20};
    double watch_rise_c{2};
    /// Once there, it may be more than runaway_c below its target for runaway_s.
    double runaway_s{40};
    double runaway_c{15};
    /// Of a simpler board: all that counts is that the reading moves at all, up or down, while it is more
    /// than runaway_c below the target; watch_s starts anew with each watch_rise_c.
    bool any_change{false};
    /// What an open and a shorted sensor read: the ends of the firmware's table.
    double open_reads_c{0};
    double shorted_reads_c{300};
};

struct HeaterConfig {
    PlantConfig plant;
    PidConfig pid;
    ProtectionConfig protection{};
    double max_target_c{0};
    /// A target beyond max_target_c is taken as that; else as it is.
    bool clamps{true};
    /// M109/M190 end when the printed temperature reaches target minus this.
    double done_within_c{0};
};

/// What a sensorless input reads at one temperature of the nozzle.
struct CrossTalkPoint {
    double source_c{0};
    double value_c{0};
};

/// An input without a sensor, which picks up its neighbour's signal. Straight lines between the points, which
/// are in rising order of source_c, constant beyond the ends; two points with the same source_c make a jump.
struct SensorlessInputConfig {
    std::vector<CrossTalkPoint> points;
    /// Standard deviation of the noise, which is there only while the nozzle heater has a target: cold and
    /// idle, the recorded board saw no change for 40 s.
    double noise_c{0};
    /// In so long a time it wanders from one value to the next, so that two measurements in a row differ
    /// little; 0: each measurement has its own.
    double noise_wander_s{0};
    int counts_per_c{7};
};

/// Nozzle of the A30T. Plant and gains were fitted together over this very code (evolution strategy with
/// covariance adaptation) to the T0 of the recording, unfolded, as the mean and worst of several phases of
/// the measurement grid and starting temperatures, because the hold is a chaotic limit cycle. Rms error in K,
/// mean and worst of 9 such starts: heating 22..188: 0.41, 0.43; false peak, sag, overshoot and hold: 0.49,
/// 0.52; all cooling down to 102: 0.33, 0.39. It is as well what the whole recording shows: a hold of 50
/// minutes at 200 has a mean of 199.2 and an sd of 0.40 (199.09, 0.31), and 103 s after it 138.5 C are left
/// (138), as after one of 5 minutes. The gains are effective values: kd and k1 matter through their product.
/// The noise of the readings is such that the status of a print at temperature goes out as often as recorded,
/// and for the same channels' sake. The largest target is no recorded fact.
inline HeaterConfig a30t_nozzle() {
    return {.plant = {.heating_k_per_s = 1.9624,
                      .exchange_a_per_s = 0.0017841,
                      .exchange_b_per_s = 0.00052465,
                      .loss_behind_per_s = 0.0039737,
                      .loss_on_per_s = 0.0043229,
                      .loss_off_per_s = 0.0028975,
                      .sensor_lag_s = 5.4134,
                      .dead_time_s = 2.6476,
                      .ambient_c = 21.7,
                      .counts_per_c = 7,
                      .noise_c = 0.19},
            .pid = {.kp = 83.774, .ki = 6.6499, .kd = 25769, .k1 = 0.0082224, .range_c = 11.065},
            .max_target_c = 250,
            .done_within_c = 1};
}

/// Bed of the A30T: plant and gains as fitted to 469..1000 s of the recording (rms 0.40 K), the loss without
/// target so that 49..46 after a long hold takes the recorded 119 s. M190 S50 from 22.0 takes 162 s
/// (recorded, from 21.7: 160), overshoots to 52.1 (53.2), sinks to 47.8 (47.0), then holds 49.0..49.1 (same).
/// The largest target is no recorded fact.
inline HeaterConfig a30t_bed() {
    return {.plant = {.heating_k_per_s = 0.267,
                      .exchange_a_per_s = 0.0102,
                      .exchange_b_per_s = 0.0105,
                      .loss_on_per_s = 0.00073,
                      .loss_off_per_s = 0.00148,
                      .sensor_lag_s = 5.8,
                      .dead_time_s = 0.75,
                      .ambient_c = 22.0,
                      .counts_per_c = 15,
                      .noise_c = 0.022,
                      .first_reading_offset_c = 0.07},
            .pid = {.kp = 236, .ki = 9.29, .kd = 13.6, .k1 = 0.35, .range_c = 5.07},
            .protection = {.max_c = 150, .watch_s = 60, .runaway_s = 60, .runaway_c = 8},
            .max_target_c = 100,
            .done_within_c = 3};
}

/// T1 and T2 of the A30T against the true nozzle temperature, read off the recording's heating and cooling.
SensorlessInputConfig a30t_t1();
SensorlessInputConfig a30t_t2();

struct ThermalConfig {
    /// Time between two measurements, which is also the controller's: > 0.
    SimTime period{300'000};
    /// Measurements after power-on that the board makes but does not use: it prints 0.0 until they are over.
    unsigned warm_up_measurements{0};
    /// Print each temperature with the fraction of its degree mirrored, and control with that
    /// (thermal_fold.h).
    bool fold{true};
    HeaterConfig nozzle{a30t_nozzle()};
    HeaterConfig bed{a30t_bed()};
    SensorlessInputConfig t1{a30t_t1()};
    SensorlessInputConfig t2{a30t_t2()};
};

}  // namespace fauxboard::filament
