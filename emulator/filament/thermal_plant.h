#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "emulator/filament/names.h"
#include "emulator/filament/thermal_config.h"

namespace fauxboard::filament {

/// Two heated masses and a sensor (the equations stand at PlantConfig), advanced exactly: the system is
/// linear and the heater's output constant between measurements, so one period is one multiplication with a
/// matrix computed at construction. The dead time is a delay line of past outputs, exact for fractions of a
/// period too. Allocates at construction only.
class ThermalPlant {
  public:
    /// Everything at ambient, heater off for ever. `period` > 0 is the time of one step().
    ThermalPlant(const PlantConfig& config, SimTime period);

    /// One period on, with the heater's output at `power` (0..1) throughout. `commanded`: the heater has a
    /// target (chooses the loss).
    void step(double power, bool commanded);

    /// A part of a period on (0 <= `elapsed` < period), the heater's output being `power`; what is then still
    /// in the delay line is laid out anew on a grid of periods that begins now. For a reset between two
    /// measurements.
    void step_partly(SimTime elapsed, double power, bool commanded);

    /// What the sensor feels, degrees C, neither quantised nor folded.
    double sensor_c() const { return ambient_c_ + state_[2]; }

    /// Of all masses, the sensor and what surrounds them, degrees C.
    double warmest_c() const { return ambient_c_ + std::max({0.0, state_[0], state_[1], state_[2]}); }
    double coldest_c() const { return ambient_c_ + std::min({0.0, state_[0], state_[1], state_[2]}); }

    double ambient_c() const { return ambient_c_; }

    /// Everything within `within_k` of ambient and no heat under way: then all is put at ambient exactly.
    /// Returns whether it is so.
    bool settle(double within_k);

    /// All masses and the sensor at `c`.
    void set_temperature(double c);
    void set_ambient(double c);

  private:
    using State = std::array<double, 3>;  // T1, T2, sensor; above ambient, in K

    /// state = transition * state + early * (output before the dead time's end in this step) + late * (output
    /// after)
    struct Step {
        std::array<std::array<double, 3>, 3> transition{};
        State early{};
        State late{};
    };

    Step discretise(double seconds, bool commanded) const;
    void apply(const Step& step, double early_power, double late_power);
    /// The output of `age` periods ago; 0 is the newest.
    double& past_power(std::size_t age);
    void push_power(double power);

    PlantConfig config_;
    double ambient_c_;
    double period_s_;
    std::size_t delay_periods_;  // whole periods of the dead time
    double delay_rest_s_;        // and the rest, 0 <= rest < period
    Step on_;
    Step off_;
    State state_{};
    std::vector<double> powers_;  // ring of the outputs still on their way
    std::size_t newest_{0};
    std::size_t idle_periods_;  // outputs of zero in a row, counted up to powers_.size()
};

}  // namespace fauxboard::filament
