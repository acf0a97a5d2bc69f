#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/machine/host_side.h"
#include "emulator/machine/machine.h"
#include "emulator/resin/config.h"
#include "emulator/resin/kind.h"
#include "emulator/resin/names.h"
#include "emulator/resin/resin_axis.h"
#include "emulator/resin/resin_commands.h"
#include "emulator/resin/resin_job.h"
#include "emulator/resin/resin_settings.h"

namespace fauxboard::resin {

/// A printer that hardens resin: its parts together, and what is done with the files of its stick.
class Printer final : public machine::Machine {
  public:
    static const machine::Kind& kind_row() { return own_kind; }

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

    Printer(std::shared_ptr<const Config> shared, const machine::Services& services, std::uint64_t seed);

    const Config& config() const { return static_cast<const Config&>(Machine::config()); }

    /// Settings as they are edited, and as the machine uses them (M8510).
    ResinSettings edited;
    ResinSettings used;
    void use_settings() { used = edited; }

    ResinAxis axis;
    ResinJob print;
    ResinCommands commands{axis};
    machine::HostSide host{events};

    /// Opens a file of the stick as the job's (M23, M6030): by its path, or by the last part of the path of
    /// the file that was opened before. Quotes and the colon of an absolute path are taken off. Raises
    /// file.selected, file.missing or file.unreadable.
    void choose(std::string_view name);
    /// Starts the file chosen, or goes on with a paused job; a .gcode file is carried out. False, and
    /// `outcome` says why, when neither is possible.
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

    // A stick that was put in can be read only later.
    void insert_card(int disk) override;
    void remove_card(int disk) override;
    std::optional<std::string> take_request() override {
        return hung() ? std::nullopt : commands.take(now());
    }
    /// The place of a print is a layer's end, and nothing between.
    void seek_job(double /*byte*/) override {}
    /// Such a board shows no finished print: it is idle at once.
    bool finish_job() override { return Machine::finish_job() && close_job(); }

    /// Raises board.reboot_due after a time.
    void reboot_in(SimTime wait) { reboot_due_ = now() + wait; }

    std::string wifi_password;
    std::string network_name;

  private:
    void power_on_parts(SimTime now) override;
    void run_parts(SimTime now) override;
    SimTime next_of_parts() const override;
    bool restless_parts() const override;
    void hang_parts(bool /*powered*/) override { axis.abort(now()); }
    bool ready_to_print() override { return print.open(); }
    void job_starts() override { print.start(now()); }
    void job_pauses(bool park) override;
    void job_goes_on() override { print.resume(now()); }
    void job_stops() override { print.stop(now()); }
    void job_ends() override { print.stop(now()); }
    void all_off(bool /*had_job*/) override {
        print.halt(now());
        commands.stop();
    }

    bool on_by(double rule) const;
    std::string_view take_name(std::string_view name);
    bool in_print(const Storage::Found& found) const;

    SimTime stick_due_ = never;
    SimTime reboot_due_ = never;
};

/// "no_stick": for conditions.
std::string_view to_string(Printer::Outcome outcome);

}  // namespace fauxboard::resin
