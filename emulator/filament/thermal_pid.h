#pragma once

#include "emulator/filament/thermal_config.h"

namespace fauxboard::filament {

/// The heater controller of the Smartto firmware (structure of its public source; the gains of that source do
/// not fit the recorded board). Called once per measurement with what the board prints, so it controls with
/// the folded value: at a target of 200 the A30T's nozzle holds 199.1.
class ThermalPid {
  public:
    /// `config` outlives this.
    explicit ThermalPid(const PidConfig& config) : config_(&config) {}

    /// The heater's output, 0..max_output, for the error `target - printed`: all while above the range,
    /// nothing while below -off_below, else Kp*e + Ki*sum(e) - D with D = dP*Kd*K1 + D*(1-K1), where sum and
    /// D start at zero on entry. Ki*sum(e) is kept within +-max_output. Chosen: what falls out of the range
    /// below the same target keeps its sum; the gains were measured at 200, and at 250 a nozzle would else
    /// never settle.
    double update(double target_c, double printed_c);

    /// The target is 0: no output; the next update() starts afresh.
    void off(double printed_c);

    /// Forgets everything, as after power-on.
    void reset() { *this = ThermalPid(*config_); }

  private:
    const PidConfig* config_;
    double target_c_{0};
    double previous_c_{0};
    double error_sum_{0};
    double slope_term_{0};
    bool in_range_{false};
};

}  // namespace fauxboard::filament
