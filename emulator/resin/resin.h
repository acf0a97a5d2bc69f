#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/machine/sim_time.h"
#include "emulator/machine/storage.h"
#include "emulator/resin/resin_axis.h"
#include "emulator/resin/resin_config.h"
#include "emulator/resin/resin_job.h"
#include "emulator/resin/resin_settings.h"

namespace fauxboard::machine {

class Printer;

/// The part of a machine that only resin printers have. Printer makes one where the profile says so.
class Resin {
  public:
    /// What became of a file that was asked for.
    enum class Outcome : std::uint8_t {
        opened,
        no_name,
        no_stick,
        missing,
        busy,
        unprintable,
        written,
        not_written,
        removed,
        not_removed
    };

    explicit Resin(Printer& printer);

    void power_on(SimTime now);
    void advance(SimTime now);
    SimTime next_event() const;
    bool restless() const;

    /// Settings as they are edited, and as the machine uses them (M8510).
    ResinSettings edited;
    ResinSettings used;
    void use_settings() { used = edited; }

    ResinAxis axis;
    ResinJob job;

    /// Opens a file of the stick as the job's (M23, M6030): by its path, or by the last part of the path of
    /// the file that was opened before. Quotes and the colon of an absolute path are taken off. Raises
    /// file.selected, file.missing or file.unreadable.
    void choose(std::string_view name);
    /// Starts the file chosen, or goes on with a paused job. False, and `outcome` says why, when neither is
    /// possible.
    bool start();
    /// Removes a file of the stick (M30); not the one being printed.
    void remove(std::string_view name);
    /// Writes a file onto the stick (M8512, M8093); not over the one being printed.
    void write(std::string_view name, std::string_view bytes);
    Outcome outcome = Outcome::opened;
    /// The file that was written replaced another one.
    bool replaced = false;
    /// The name that was asked for last, without quotes, colon and leading slash.
    std::string asked;
    /// The file chosen as the board tells it: its name, or "/folder/name". Stays when the job is over.
    std::string file;
    std::uint64_t file_bytes = 0;

    /// M106: a speed of 0 to 256, from then on; without one the settings rule.
    std::optional<int> fan;
    int led_fan() const;
    int board_fan() const;
    bool led() const;

    /// A pause was asked for: it shows later.
    void pause(SimTime now);

    /// A stick was put in: the board can read it only later.
    void put_stick_in(SimTime now);
    void take_stick_out() { stick_due_ = never; }

    /// Raises board.reboot_due after a time.
    void reboot_in(SimTime wait, SimTime now) { reboot_due_ = now + wait; }

    std::string wifi_password;
    std::string network_name;

  private:
    bool on_by(double rule) const;
    std::string_view take_name(std::string_view name);
    bool in_print(const Storage::Found& found) const;

    Printer& printer_;
    const ResinConfig& config_;
    SimTime stick_due_ = never;
    SimTime reboot_due_ = never;
};

/// "no_stick": for conditions.
std::string_view to_string(Resin::Outcome outcome);

/// A name as requests bring it, without blanks, quotes and the colon of an absolute path: 'a.ctb', ':a.ctb'
/// and
/// :'a.ctb' all become a.ctb.
std::string_view bare_name(std::string_view name);

}  // namespace fauxboard::machine
