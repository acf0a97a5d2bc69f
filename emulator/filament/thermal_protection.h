#pragma once

#include <cstdint>

#include "emulator/filament/names.h"
#include "emulator/filament/thermal_config.h"

namespace fauxboard::filament {

enum class ThermalAlarm : std::uint8_t { none, too_cold, too_hot, no_rise, runaway };

/// How a board notices that a heater or its sensor is broken, as Marlin does: a reading out of range, a
/// heater that does not rise while it heats up, one that falls away from a target it had reached.
class ThermalProtection {
  public:
    /// `config` outlives this.
    explicit ThermalProtection(const ProtectionConfig& config) : config_(&config) {}

    /// To be called at each measurement with the target, 0 for off, and with what the board reads. True when
    /// something is newly found wrong. Too hot is told once, until it reads clearly less again or is to be
    /// heated.
    bool check(SimTime now, double target_c, double reading_c);
    /// Whether the last check was with this target.
    bool watches(double target_c) const { return target_c == target_c_; }
    /// If it was: when a check may at the earliest find that the heater does not rise
    /// or runs away, the next check being at `next`.
    SimTime earliest(SimTime next) const;
    /// What was found wrong last, until it is heated anew.
    ThermalAlarm alarm() const { return alarm_; }
    /// Forgets everything, as after power-on.
    void reset() { *this = ThermalProtection(*config_); }

  private:
    ThermalAlarm watch(SimTime now, double target_c, double reading_c);
    ThermalAlarm still(SimTime now, double target_c, double reading_c);

    const ProtectionConfig* config_;
    ThermalAlarm alarm_ = ThermalAlarm::none;
    bool told_hot_ = false;
    double target_c_ = 0;    ///< that is watched
    bool reached_ = false;   ///< it was, since it was set
    SimTime due_ = never;    ///< heating up: when it must have risen
    double due_c_ = 0;       ///< to this
    SimTime away_since_{0};  ///< reached: since when it is too far below
};

}  // namespace fauxboard::filament
