#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/machine/eeprom_image.h"
#include "emulator/machine/events.h"
#include "emulator/machine/faults.h"
#include "emulator/machine/host_side.h"
#include "emulator/machine/job.h"
#include "emulator/machine/job_control.h"
#include "emulator/machine/kind.h"
#include "emulator/machine/machine_config.h"
#include "emulator/machine/main_loop.h"
#include "emulator/machine/services.h"
#include "emulator/machine/sim_time.h"
#include "emulator/machine/storage.h"
#include "emulator/machine/transfer.h"
#include "emulator/machine/wifi.h"

namespace fauxboard::machine {

/// The machine behind the board, as far as all kinds are alike: time, events, disks, transfers, the job, the
/// EEPROM, faults, standing still and starting anew. A kind derives from it and brings its parts. Knows no
/// messages and does no I/O but through Services.
class Machine : public JobControl {
  public:
    ~Machine() override = default;
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    const Kind& kind() const { return kind_; }
    const MachineConfig& config() const { return *config_; }

    /// Switches the board on, or resets it: everything in RAM takes its default, what is physical stays as it
    /// is (temperatures, where things stand, disks, what is broken).
    void power_on(SimTime now);

    /// Brings everything up to `now` and raises the events due. Steps may have any length.
    void advance(SimTime now);
    /// The same where next_event() is known to be later than `now`.
    void pass(SimTime now);
    /// When advance() must next be called because an event falls due; `never` if nothing is under way.
    SimTime next_event() const;
    /// Whether anything the board shows may change by the mere passing of time.
    bool restless() const;
    /// Whether moves that somebody asked for are still to be done.
    virtual bool moving() const { return false; }
    /// Whether something is waited for because somebody asked for that.
    virtual bool waiting() const { return false; }
    SimTime now() const { return now_; }

    // Disks: 0 the SD card (or the stick of a board that has one slot), 1 the U-disk.
    // ------------------------------------------------------------------------
    virtual void insert_card(int disk);
    virtual void remove_card(int disk);
    /// The disk stays where it is and can no longer be read; insert_card() puts a good one in.
    void fail_card(int disk);
    /// Both disks in one number: SD in the low nibble, U-disk in the high one when the board has such a port.
    int disk_code() const;
    /// The entries to show now; the buffer is reused.
    const std::vector<CardEntry>& listing();
    /// A card was read in, or taken out, since card_told().
    bool card_news() const { return card_news_; }
    void card_told() { card_news_ = false; }
    /// Every file of the chosen disk; the buffer is reused.
    const std::vector<CardEntry>& files();

    // The job. What a kind does at each turn of it is among the functions it overrides.
    // ------------------------------------------------------------------------
    /// Raises file.selected, file.missing or file.unreadable. `replaces`: a job that is under way is dropped
    /// for it, instead of the file being refused.
    void select_file(std::string_view name, bool replaces = false);
    bool start_or_resume_job();
    /// False when there is no paused job.
    virtual bool resume_job();
    void pause_job(bool park) override;
    void pause_job() { pause_job(true); }
    /// M26: where the file goes on; the place of a job that is under way changes at once.
    void seek_job(double byte) override = 0;
    bool stop_job() override;
    bool finish_job() override;
    /// A finished job is no longer shown. False when there is none.
    bool close_job() override;
    /// M112: the job and all that moves, shines or heats, off at once.
    void emergency_stop() override;
    void wait_for_user(double seconds) override;
    void kill() override;
    /// Called when what the board says at its end has been said.
    void die_if_told();
    /// M0, M108: a job that waits for the user goes on, and so does a board that waits without one.
    void user_continues();

    // A board that stands still, and one that starts anew.
    // ------------------------------------------------------------------------
    /// The board's program stops, until power_on(): nothing is read, moved or raised. What is switched on
    /// stays so, or (`powered` false) gets no more current.
    void hang(bool powered);
    bool hung() const { return hung_; }
    /// A request that the machine makes of itself, for the board to carry out without an answer: a line of a
    /// file. Nothing when there is none; it may be empty. That one comes due is an event of the machine's.
    virtual std::optional<std::string> take_request() { return std::nullopt; }
    /// The board is to be reset, by whoever owns it; asking takes it.
    void request_reset(int why) {
        reset_ = true;
        restart = why;
    }
    /// Why the board started: 0 switched on, 1 its reset, 2 the supply, 3 its watchdog.
    int restart = 0;
    bool take_reset();
    /// Raises timer.over after a time; a timer that runs is set anew.
    void start_timer(SimTime time) { timer_ = now_ + time; }
    /// The USB side has said something.
    void hear_host(SimTime now) { host_heard_ = now; }
    /// It has within the last seconds: somebody prints through the board.
    bool host_active() const;

    /// The commands of a computer on the USB port.
    HostSide& host_side() { return host_side_; }
    const HostSide& host_side() const { return host_side_; }

    EventQueue events;
    Storage storage;
    Transfer transfer{storage};
    Job job;
    MainLoop loop;
    Commands commands;
    Wifi wifi;
    Faults faults{*this};
    bool refusing = false;  ///< files are not selected or started, as while a job is under way

    /// What the EEPROM holds, and what it is written to.
    EepromImage eeprom_image;
    /// The same for a machine fresh from the factory (M502).
    std::string factory_image;
    EepromStore* eeprom_store() const { return services_.eeprom; }
    /// A number in [0, 1) of this machine's own sequence.
    double random();

  protected:
    /// `config` is shared by all boards of a profile and must not change. `host_side` is a part of the kind.
    Machine(const Kind& kind, std::shared_ptr<const MachineConfig> config, const Services& services,
            std::uint64_t seed, HostSide& host_side);

    const Services& services() const { return services_; }
    /// The disk that belongs into a slot is in it from now on.
    void put_in(int disk);

    // What a kind brings. Each is called at its time by the functions above.
    // ------------------------------------------------------------------------
    /// Its parts take their defaults.
    virtual void power_on_parts(SimTime now) = 0;
    /// What goes on by itself, whether or not the board's program runs: warmth. Called with every time.
    virtual void let_pass(SimTime /*now*/) {}
    /// What the board's program does at `now`, one of the times that next_of_parts() gave.
    virtual void run_parts(SimTime now) = 0;
    virtual SimTime next_of_parts() const = 0;
    virtual bool restless_parts() const = 0;
    /// The program stands still: see hang().
    virtual void hang_parts(bool powered) = 0;

    /// Another file is selected in place of one that is being printed.
    virtual void job_gives_way() {}
    /// Another file is selected, or none is any more: what was read of the one before is forgotten.
    virtual void forget_file() {}
    /// Whether the selected file can be printed.
    virtual bool ready_to_print() { return true; }
    virtual void job_starts() = 0;
    /// A pause was asked for. Ends, at once or later, with job.pause() and the event job.paused.
    virtual void job_pauses(bool park) = 0;
    virtual void job_goes_on() = 0;
    /// Before its end, by whoever stops it.
    virtual void job_stops() = 0;
    virtual void job_ends() = 0;
    /// All off; `had_job`: one was broken off by it.
    virtual void all_off(bool had_job) = 0;

  private:
    void look_after_card(SimTime now);

    const Kind& kind_;
    std::shared_ptr<const MachineConfig> config_;
    Services services_;
    HostSide& host_side_;
    std::optional<BuiltInVolume> built_in_;
    std::vector<CardEntry> listing_;
    std::vector<CardEntry> files_;
    const Volume* listed_ = nullptr;  ///< what listing_ shows, and which folder of it, if it cannot change
    std::string listed_folder_;
    SimTime now_{0};
    SimTime card_check_ = never;  ///< when the board finds out whether there is a card
    SimTime card_rescan_ = never;
    SimTime timer_ = never;
    bool card_news_ = false;
    SimTime user_until_ = never;  ///< when the user is no longer waited for
    bool dying_ = false;
    bool hung_ = false;
    bool reset_ = false;
    std::optional<SimTime> host_heard_;
    std::uint64_t random_state_;
};

/// The machine as one of kind M, which names its row `kind_row`; null when it is of another kind.
template <class M>
const M* as(const Machine& machine) {
    return &machine.kind() == &M::kind_row() ? static_cast<const M*>(&machine) : nullptr;
}
template <class M>
M* as(Machine& machine) {
    return &machine.kind() == &M::kind_row() ? static_cast<M*>(&machine) : nullptr;
}

}  // namespace fauxboard::machine
