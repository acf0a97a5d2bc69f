#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "emulator/filament/names.h"
#include "emulator/filament/thermal_config.h"
#include "emulator/filament/thermal_pid.h"
#include "emulator/filament/thermal_plant.h"
#include "emulator/filament/thermal_protection.h"

namespace fauxboard::filament {

enum class HeaterId : std::uint8_t { nozzle, bed };

/// The four temperatures a board prints: bed, nozzle, and the two inputs that have no sensor on a mixing
/// printer.
enum class ThermalChannel : std::uint8_t { bed, t0, t1, t2 };

/// What is wrong with a heater and its sensor. Physical: it outlives a reset.
struct HeaterTrouble {
    bool open = false;     ///< the sensor's wire is broken
    bool shorted = false;  ///< its wires touch
    double contact = 1;    ///< share of the heat above the surroundings that the sensor feels, 0..1
    double strength = 1;   ///< share of its power that the heater has, 0..1
    double stuck = 0;      ///< share of its power that is on whatever the board wants, 0..1
    bool operator==(const HeaterTrouble&) const = default;
};

/// The heaters of a board and what it reads and prints of them. Everything happens at the measurements, every
/// `period` from power-on (0.3 s on the A30T): read all channels, control both heaters. Between them nothing
/// changes.
///
/// Use: advance(now) before reading or setting anything at `now`. Times never go back. Deterministic: the
/// same config, seed and calls at the same times give the same bits, however often advance() is called in
/// between.
class Thermal {
  public:
    /// Unpowered, everything at ambient: no time passes until the first power_on(). `config` outlives this.
    Thermal(const ThermalConfig& config, std::uint64_t seed);

    /// The board (re)starts: controllers, targets and readings are forgotten, real temperatures kept. All
    /// channels read 0.0 until the first measurement, one period from `now`.
    void power_on(SimTime now);

    /// Does all measurements due up to and including `now` (at least a period before `never`). O(1) while
    /// settled().
    void advance(SimTime now);

    /// Heaters off and everything at ambient: nothing will ever change by itself. (Within 0.005 K of ambient
    /// all is put exactly there.)
    bool settled() const;

    /// When the next measurement is due; `never` while settled or unpowered.
    SimTime next_measurement() const;

    /// The new target, 0 for off, in force from the next measurement. Kept within 0..max_target_c; returns
    /// whether that changed it.
    bool set_target(HeaterId id, double c);
    double target_c(HeaterId id) const { return heater(id).target_c; }
    const PlantConfig& plant(HeaterId id) const { return heater(id).config->plant; }
    bool heating(HeaterId id) const { return heater(id).target_c != 0; }

    /// What is at the sensor's place, at the last measurement.
    double temperature_c(HeaterId id) const { return heater(id).plant.sensor_c(); }
    /// What the sensor tells of it, neither quantised nor folded: the same, unless it is broken.
    double sensed_c(HeaterId id) const { return sensed_c(heater(id)); }

    const HeaterTrouble& trouble(HeaterId id) const { return heater(id).trouble; }
    void set_trouble(HeaterId id, const HeaterTrouble& trouble);
    /// A heater found to be broken since the last call; both are off since. Once for each.
    std::optional<HeaterId> take_alarm();
    /// Why it was, until it is heated anew or the board restarts.
    ThermalAlarm alarm(HeaterId id) const { return heater(id).protection.alarm(); }
    /// The first measurement that may raise an alarm; `never` if none can before something else happens.
    SimTime next_alarm_check() const { return alarm_check_; }
    /// The board's program stands still: nothing is read or controlled until it restarts. Heaters stay as
    /// they are, or lose their power.
    void freeze(bool powered);

    /// What the board prints: quantised, and folded when the config says so. 0.0 before the first
    /// measurement.
    double printed_c(ThermalChannel channel) const { return printed_[static_cast<std::size_t>(channel)]; }

    /// What the board gives the heater, 0..1.
    double power(HeaterId id) const { return share_of_full(heater(id)); }

    /// Where M109/M190 stop waiting: printed >= target - done_within_c.
    bool reached(HeaterId id) const;
    /// The same from above: printed > target + done_within_c.
    bool above(HeaterId id) const;

    /// The printed values of this moment were reported.
    void mark_reported();
    /// Whether the measurement before the last one found any channel 1.0 or more away from the values
    /// reported. (The recorded board decides in one slot of its schedule and prints in the next, 0.3 s
    /// later. Looking back by one measurement, and no further, tells for 122 of 132 slots between 45 and
    /// 470 s from T0 alone whether it sent; a flag that stays set once any measurement differed is wrong in
    /// every second slot of the cooling from 200 C.) At rest, and at the first measurement after power-on,
    /// when the values reported are 0.0, it is that of the last measurement.
    bool moved_since_report() const { return moved_; }

    /// For tests and faults: the whole hotend or bed at `c`; the surroundings of both at `c`.
    void set_temperature(HeaterId id, double c);
    void set_ambient(double c);

  private:
    struct Heater {
        Heater(const HeaterConfig& heater_config, SimTime period, ThermalChannel heater_channel)
            : config(&heater_config),
              plant(heater_config.plant, period),
              pid(heater_config.pid),
              protection(heater_config.protection),
              channel(heater_channel) {}

        const HeaterConfig* config;
        ThermalPlant plant;
        ThermalPid pid;
        ThermalProtection protection;
        HeaterTrouble trouble{};
        ThermalChannel channel;
        double target_c{0};
        double output{0};       // 0..max_output, constant until the next measurement
        bool commanded{false};  // had a target at the last measurement
        bool alarmed{false};    // not taken yet
    };

    const Heater& heater(HeaterId id) const { return heaters_[static_cast<std::size_t>(id)]; }
    Heater& heater(HeaterId id) { return heaters_[static_cast<std::size_t>(id)]; }
    static double share_of_full(const Heater& h) { return h.output / h.config->pid.max_output; }
    static double real_power(const Heater& h);
    static double sensed_c(const Heater& h);
    SimTime earliest_alarm(const Heater& h) const;
    void plan_alarm_check();
    void measure();
    void protect();
    void read_sensor(Heater& h);
    void control(Heater& h);
    void read_input(ThermalChannel channel, const SensorlessInputConfig& input);
    void print(ThermalChannel channel, double read_c);
    void watch();

    const ThermalConfig* config_;
    std::uint64_t seed_;
    std::array<Heater, 2> heaters_;    // by HeaterId
    std::array<double, 4> printed_{};  // by ThermalChannel
    std::array<double, 4> reported_{};
    SimTime next_{never};
    SimTime alarm_check_{never};       // on the grid of measurements
    std::uint64_t index_{0};           // of the next measurement, since construction
    std::uint64_t since_power_on_{0};  // measurements
    bool moved_{false};
    bool at_rest_{false};
    bool frozen_{false};
    bool powered_{true};
};

}  // namespace fauxboard::filament
