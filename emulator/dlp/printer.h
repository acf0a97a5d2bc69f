#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/dlp/config.h"
#include "emulator/dlp/kind.h"
#include "emulator/dlp/mks_board.h"
#include "emulator/machine/host_side.h"
#include "emulator/machine/machine.h"

namespace fauxboard::dlp {

/// A printer with the MKS DLP board: the board, whose stick is the machine's disk and whose events are the
/// machine's.
class Printer final : public machine::Machine, private Stick, private Listener {
  public:
    static const machine::Kind& kind_row() { return own_kind; }

    Printer(std::shared_ptr<const Config> config, const machine::Services& services, std::uint64_t seed);

    const Config& config() const { return *config_; }

    /// The supply fails when so much (0 to 1) of the next writing to the EEPROM is done; nothing: it does
    /// not.
    void cut_next_write(std::optional<double> share) { cut_share_ = share; }
    bool cuts_next_write() const { return cut_share_.has_value(); }

    void insert_card(int disk) override;
    void remove_card(int disk) override;
    /// A print goes on where its layer is, and nowhere else.
    void seek_job(double /*byte*/) override {}

  private:
    std::shared_ptr<const Config> config_;  // before the board, which is made from it

  public:
    MksBoard board;
    machine::HostSide host{events};
    bool read_errors = false;  ///< of the stick
    std::string last_note;     ///< what a person would want to know

  private:
    void power_on_parts(SimTime now) override;
    void run_parts(SimTime now) override;
    SimTime next_of_parts() const override;
    bool restless_parts() const override;
    void hang_parts(bool powered) override;
    // The board has no job of the common kind: its own print is told by its own fields and events.
    bool ready_to_print() override { return false; }
    void job_starts() override {}
    void job_pauses(bool /*park*/) override {}
    void job_goes_on() override {}
    void job_stops() override {}
    void job_ends() override {}
    void all_off(bool had_job) override;

    bool present() const override { return volume() != nullptr; }
    bool list(const std::string& folder, std::vector<StickEntry>& out) const override;
    std::optional<StickEntry> look(const std::string& path) const override;
    std::unique_ptr<sliced::ByteSource> open(const std::string& path) const override;
    bool remove(const std::string& path) override;
    void raise(Event event) override;
    void note(const std::string& text) override { last_note = text; }
    /// The U-disk, else the card; null when neither is in.
    const machine::Volume* volume() const { return storage.volume(disk()); }
    int disk() const { return storage.usable(1) ? 1 : 0; }

    std::optional<double> cut_share_;
};

}  // namespace fauxboard::dlp
