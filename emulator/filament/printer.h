#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "emulator/filament/config.h"
#include "emulator/filament/feeder.h"
#include "emulator/filament/heating_wait.h"
#include "emulator/filament/host_commands.h"
#include "emulator/filament/job_runner.h"
#include "emulator/filament/kind.h"
#include "emulator/filament/mixer.h"
#include "emulator/filament/motion.h"
#include "emulator/filament/names.h"
#include "emulator/filament/procedures.h"
#include "emulator/filament/recovery.h"
#include "emulator/filament/reports.h"
#include "emulator/filament/state.h"
#include "emulator/filament/thermal.h"
#include "emulator/machine/machine.h"

namespace fauxboard::filament {

/// A printer that melts filament: its parts together, and the actions that touch several of them.
class Printer final : public machine::Machine {
  public:
    static const machine::Kind& kind_row() { return own_kind; }

    Printer(std::shared_ptr<const Config> shared, const machine::Services& services, std::uint64_t seed);

    const Config& config() const { return static_cast<const Config&>(Machine::config()); }

    /// Homes the axes of the mask (bit 0 X, 1 Y, 2 Z; 0 means all). False when the motion queue is full.
    bool home(unsigned mask) { return moves.home(mask, now()); }
    /// Runs a procedure of the profile. False when there is none of that name or the motion queue is full.
    bool run(std::string_view procedure) { return moves.run(procedure, now()); }
    void motors_off() { motion.set_motors(false); }
    /// M2105 S2/S3/S5. A nozzle below the extrusion minimum raises `filament.too_cold` and nothing moves.
    void feed(Feeder::Mode mode);
    void feed_once();
    void set_filament(bool present);
    void seek_job(double byte) override;
    bool resume_job() override;
    bool moving() const override { return motion.busy(); }
    bool waiting() const override { return wait.active(); }
    /// The job, whatever its state, has come to its end; the profile sees to heaters and motions.
    void end_job();
    /// The fan of the control board, percent; what M106 P2 sets holds until it changes by itself.
    int board_fan_percent() const;
    void set_board_fan(int percent) { fan_order_ = FanOrder{percent, own_fan_percent()}; }
    /// The controller of a heater is tuned at `c`, until stop_tuning() or a reset: it is hot meanwhile.
    void start_tuning(HeaterId heater, double c);
    void stop_tuning();
    /// The nozzle counts as too cold for filament below `c`, if that is more than the machine's own bound.
    void chill(double c);
    /// Filament state as L3 tells it: 255 detector off, else 1 with and 0 without filament.
    int filament_code() const { return !filament.detector ? 255 : filament.present ? 1 : 0; }

    Thermal thermal;
    Settings settings;
    Leveling leveling;
    Motion motion;
    Procedures moves;
    Feeder feeder;
    HeatingWait wait;
    Mixer mixer;
    AddOns addons;
    Fans fans;
    Filament filament;
    GcodeModal modal;
    Autotune autotuned;  ///< what M303 found last
    GcodeMachine gcode;  ///< all that codes act on
    JobRunner runner;
    HostCommands host;
    Reports reports;
    ExtrusionGuard guard;
    ToldText told;
    ScreenSide screen;
    Steppers steppers;
    Recovery recovery;
    FilamentPath filament_path;
    bool tuning = false;  ///< of a heater's controller

  private:
    void power_on_parts(SimTime now) override;
    void let_pass(SimTime now) override { thermal.advance(now); }
    void run_parts(SimTime now) override;
    SimTime next_of_parts() const override;
    bool restless_parts() const override;
    void hang_parts(bool powered) override;
    void forget_file() override { runner.stop(); }
    void job_gives_way() override;
    void job_starts() override { runner.start(now()); }
    void job_pauses(bool park) override;
    void job_goes_on() override { runner.resume(now()); }
    void job_stops() override;
    void job_ends() override;
    void all_off(bool had_job) override;

    SimTime next_of_job() const;
    void emit_after_motion();
    void pause_now();
    void rest_motors(SimTime now);
    int own_fan_percent() const;
    void raise_alarms();
    void follow_filament();
    bool too_cold_to_extrude() const;

    struct FanOrder {
        int percent = 0;
        int instead_of = 0;  ///< what the fan did by itself then
    };
    std::optional<FanOrder> fan_order_;
    SimTime motors_rest_ = never;  ///< when the motors switch themselves off
    SimTime power_on_{0};
    double chilled_c_ = 0;
    HeaterId tuned_ = HeaterId::nozzle;
};

}  // namespace fauxboard::filament
