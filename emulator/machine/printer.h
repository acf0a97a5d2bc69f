#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/filament/feeder.h"
#include "emulator/filament/heating_wait.h"
#include "emulator/filament/host_commands.h"
#include "emulator/filament/job_runner.h"
#include "emulator/filament/mixer.h"
#include "emulator/filament/motion.h"
#include "emulator/filament/recovery.h"
#include "emulator/filament/thermal.h"
#include "emulator/machine/breakdowns.h"
#include "emulator/machine/eeprom_image.h"
#include "emulator/machine/events.h"
#include "emulator/machine/job.h"
#include "emulator/machine/machine_config.h"
#include "emulator/machine/sim_time.h"
#include "emulator/machine/state.h"
#include "emulator/machine/storage.h"
#include "emulator/machine/transfer.h"
#include "emulator/resin/resin.h"

namespace fauxboard::machine {

/// Where the board's EEPROM lives. The image is text, one `path value` a line; who stores it need not read
/// it.
class EepromStore {
  public:
    virtual ~EepromStore() = default;
    /// The stored image; nothing when none was ever stored or it is broken.
    virtual std::optional<std::string> load() = 0;
    /// Stores the whole image so that a kill at any moment leaves the old one or the new one. False when it
    /// could not.
    virtual bool save(std::string_view image) = 0;
};

/// What the world lends to a machine. Everything may be null: no such disk, EEPROM in memory only.
struct Services {
    Volume* sd = nullptr;
    Volume* udisk = nullptr;
    EepromStore* eeprom = nullptr;
    JobPlaceStore* job_place = nullptr;
};

/// The machine behind the board: parts, their state, and the time they share. Knows no messages and does no
/// I/O but through Services.
class Printer {
  public:
    /// `config` is shared by all boards of a profile and must not change.
    Printer(std::shared_ptr<const MachineConfig> config, Services services, std::uint64_t seed);
    Printer(const Printer&) = delete;
    Printer& operator=(const Printer&) = delete;

    /// Switches the board on, or resets it: everything in RAM takes its default, what is physical stays as it
    /// is (real temperatures, where the head stands, filament, cards).
    void power_on(SimTime now);

    /// Brings everything up to `now` and raises the events due. Steps may have any length.
    void advance(SimTime now);
    /// When advance() must next be called because an event falls due; `never` if nothing is under way.
    SimTime next_event() const;
    /// Whether anything the board shows may change by the mere passing of time.
    bool restless() const;
    SimTime now() const { return now_; }
    const MachineConfig& config() const { return *config_; }

    // Actions that touch more than one part.
    // ------------------------------------------------------------------------
    enum class HomeAxes : std::uint8_t { x = 1, y = 2, z = 4, all = 7 };
    /// Homes the axes of the mask (bit 0 X, 1 Y, 2 Z; 0 means all). False when the motion queue is full.
    bool home(unsigned mask);
    /// Runs a procedure of the profile. False when there is none of that name or the motion queue is full.
    bool run(std::string_view procedure);
    void motors_off();
    /// M2105 S2/S3/S5. A nozzle below the extrusion minimum raises `filament.too_cold` and nothing moves.
    void feed(Feeder::Mode mode);
    void feed_once();
    void set_filament(bool present);
    void insert_card(int disk);
    void remove_card(int disk);
    /// The stick that was put into a resin board can be read from now on.
    void mount_stick();
    /// The disk stays where it is and can no longer be read; insert_card() puts a good one in.
    void fail_card(int disk);
    void select_file(std::string_view name);
    bool start_or_resume_job();
    /// False when there is no paused job.
    bool resume_job();
    /// Finishes the moves that are planned, then parks the head if it is to.
    void pause_job(bool park = true);
    /// M26: where the file goes on; the place of a job that is under way changes at once.
    void seek_job(double byte);
    bool stop_job();
    bool finish_job();
    /// The job that Recovery has made ready prints.
    void continue_recovered_job();
    /// A finished job is no longer shown. False when there is none.
    bool close_job();
    /// M112: job, heaters and motors off at once.
    void emergency_stop();
    /// M0, M108: a job that waits for the user goes on, and so does a board that waits without one.
    void user_continues();
    /// The controller of a heater is tuned at `c`, until stop_tuning() or a reset: it is hot meanwhile.
    void start_tuning(HeaterId heater, double c);
    void stop_tuning();
    /// The nozzle counts as too cold for filament below `c`, if that is more than the machine's own bound.
    void chill(double c);

    // A board that stands still, and one that starts anew.
    // ------------------------------------------------------------------------
    /// The board's program stops, until power_on(): nothing is read, moved or raised. Heaters keep what they
    /// were given, or (`powered` false) get nothing.
    void hang(bool powered);
    bool hung() const { return hung_; }
    /// The board is to be reset, by whoever owns it; asking takes it.
    void request_reset() { reset_ = true; }
    bool take_reset();
    /// The USB side has said something.
    void hear_host(SimTime now);
    /// It has within the last seconds: somebody prints through the board.
    bool host_active() const;
    /// Filament state as L3 tells it: 255 detector off, else 1 with and 0 without filament.
    int filament_code() const { return !filament.detector ? 255 : filament.present ? 1 : 0; }
    /// Both disks as L2 tells them: SD in the low nibble, U-disk in the high one when the board has such a
    /// port.
    int disk_code() const;
    /// The entries to show now; the buffer is reused.
    const std::vector<CardEntry>& listing();

    Thermal thermal;
    Settings settings;
    Motion motion;
    Feeder feeder;
    HeatingWait wait;
    Mixer mixer;
    AddOns addons;
    Fans fans;
    Leveling leveling;
    Filament filament;
    Storage storage;
    Transfer transfer{storage};
    Job job;
    JobRunner runner;
    GcodeModal modal;
    HostCommands host;
    ScreenSide screen;
    Wifi wifi;
    Steppers steppers;
    Recovery recovery;
    EventQueue events;
    std::unique_ptr<Resin> resin;  ///< null on boards of other printers
    FilamentPath filament_path;
    Breakdowns breakdowns{*this};
    bool refusing = false;  ///< files are not selected or started, as while a job is under way
    bool tuning = false;    ///< of a heater's controller

    /// What the EEPROM holds, and what it is written to.
    EepromImage eeprom_image;
    /// The same for a machine fresh from the factory (M502).
    std::string factory_image;
    EepromStore* eeprom_store() const { return services_.eeprom; }
    /// Time for which the main loop stands still because of a write (M500); asking takes it.
    SimTime take_stall();
    void stall(SimTime time) { stall_ += time; }
    /// A number in [0, 1) of this machine's own sequence.
    double random();

  private:
    void emit_after_motion();
    void put_in(int disk);
    void raise_alarms();
    SimTime next_of_job() const;
    void follow_filament();
    bool too_cold_to_extrude() const;

    std::shared_ptr<const MachineConfig> config_;
    Services services_;
    std::optional<BuiltInVolume> built_in_;
    std::vector<CardEntry> listing_;
    const Volume* listed_ = nullptr;  ///< what listing_ shows, and which folder of it, if it cannot change
    std::string listed_folder_;
    SimTime now_{0};
    SimTime card_check_ = never;  ///< when the board finds out that there is no card
    SimTime stall_{0};
    double chilled_c_ = 0;
    HeaterId tuned_ = HeaterId::nozzle;
    bool hung_ = false;
    bool reset_ = false;
    std::optional<SimTime> host_heard_;
    std::uint64_t random_state_;
};

}  // namespace fauxboard::machine
