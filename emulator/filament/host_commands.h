#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/filament/config.h"
#include "emulator/filament/gcode_codes.h"
#include "emulator/filament/gcode_line.h"
#include "emulator/filament/names.h"
#include "emulator/machine/host_side.h"

namespace fauxboard::filament {

/// What the commands of the USB side do, one after the other: each begins when the one before it is over, and
/// a move when the planner has room for it. That is how a host that waits for every `ok` is kept at the
/// printer's pace. Shares the modal state (units, feed) with a job, as in the firmware.
///
/// While a file that the host began (M28) is open, its lines are written to it instead, until M29.
class HostCommands final : public machine::HostSide {
  public:
    HostCommands(GcodeMachine& on, Transfer& transfer, const HostConfig& config)
        : HostSide(on.events), transfer_(transfer), config_(config), source_{on} {}

    void power_on() override;
    bool ready(std::string_view command) override;
    void begin(std::string_view command, SimTime now) override;
    bool run_code() override;
    bool under_way(SimTime now) const override;
    void over() override;

    /// Whether a file of the host's is open, so that lines are kept and not carried out. Also when it can no
    /// longer be written: a host that goes on sending it must not have it printed instead.
    bool writing() const { return writing_; }
    /// The command begun becomes a line of the file that is open. False when there is none, or it is the one
    /// that ends it: it is to be carried out then. Raises `host.write_failed`, once for a file, when the disk
    /// takes no more; nothing of the file will stand under its name then.
    bool write(std::string_view command, SimTime now) override;
    void follow_transfer() override;

    void advance(SimTime now);
    SimTime next_event(SimTime now) const {
        const bool idle = busy_ == never && source_.wake == SimTime{0} && !source_.arc.active();
        return idle ? never : next_of_command(now);
    }

    std::uint64_t moves() const { return source_.moves; }

  private:
    /// What the board collects before it writes: a block of the card.
    static constexpr std::size_t block_bytes = 512;

    void parse(std::string_view command);
    void flush(SimTime now);
    void stream();
    SimTime next_of_command(SimTime now) const;

    Transfer& transfer_;
    const HostConfig& config_;
    GcodeSource source_;
    GcodeLine line_;
    std::string parsed_;               ///< what line_ was parsed from and points into
    const GcodeCode* code_ = nullptr;  ///< of parsed_
    bool writing_ = false;
    std::string unwritten_;  ///< of the file; less than a block and a line
    SimTime busy_ = never;   ///< when the host is told next that it has to wait
};

}  // namespace fauxboard::filament
