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

/// What the commands of the lines do that are spoken as a host speaks, one after the other: each begins when
/// the one before it is over, and a move when the planner has room for it. That is how a host that waits for
/// every `ok` is kept at the printer's pace. Shares the modal state (units, feed) with a job, as in the
/// firmware, and the planner: while a command waits for the planner, or runs, the job's file is not read.
///
/// While a file that a host began (M28) is open, that line's commands are written to it instead, until M29.
class HostCommands final : public machine::HostSide {
  public:
    HostCommands(GcodeMachine& on, Transfer& transfer, const machine::HostConfig& config)
        : HostSide(on.events), transfer_(transfer), config_(config), source_{on} {}

    void power_on() override;
    bool ready(std::size_t from, std::string_view command, SimTime now) override;
    void begin(std::size_t from, std::string_view command, SimTime now) override;
    bool run_code(bool by_rule) override;
    void settle() override;
    bool under_way(SimTime now) const override;
    void over() override;
    /// Whether the planner is kept for a command, so that the job has to wait.
    bool holds() const { return running() || (waits_ && !yields_); }
    /// The job has had its turn in between.
    void go_on() { yields_ = false; }

    /// Also when the file can no longer be written: a host that goes on sending it must not have it printed
    /// instead.
    bool writing(std::size_t from) const override { return writing_ && writer_ == from; }
    bool writing() const { return writing_; }
    /// The command begun becomes a line of the file that is open. False when there is none, or it is the one
    /// that ends it: it is to be carried out then. Raises `host.write_failed`, once for a file, when the disk
    /// takes no more; nothing of the file will stand under its name then.
    bool write(std::string_view command, SimTime now) override;
    void follow_transfer() override;

    void advance(SimTime now);
    SimTime next_event(SimTime now) const {
        const bool idle =
            busy_ == never && wait_busy_ == never && source_.wake == SimTime{0} && !source_.arc.active();
        return idle ? never : next_of_command(now);
    }

    /// The number of the code of the last one begun ("M104": 104); -1 of a word.
    int code() const { return line_.code; }
    std::uint64_t moves() const { return source_.moves; }
    /// A command that takes longer raises `host.busy`, and again each time; 0: never.
    double busy_s() const { return busy_s_; }
    void set_busy_s(double seconds, SimTime now);

  private:
    /// What the board collects before it writes: a block of the card.
    static constexpr std::size_t block_bytes = 512;

    void parse(std::string_view command);
    void flush(SimTime now);
    void stream();
    SimTime next_of_command(SimTime now) const;

    Transfer& transfer_;
    const machine::HostConfig& config_;
    GcodeSource source_;
    GcodeLine line_;
    std::string parsed_;               ///< what line_ was parsed from and points into
    const GcodeCode* code_ = nullptr;  ///< of parsed_
    bool waits_ = false;               ///< a command for the planner
    bool yields_ = false;              ///< after each move of its own the job may put in one
    bool heater_before_ = false;       ///< what was waited for already when it began
    bool user_before_ = false;
    bool writing_ = false;
    std::size_t writer_ = 0;
    bool runs_too_ = false;  ///< what is written (M928)
    std::string unwritten_;  ///< of the file; less than a block and a line
    double busy_s_ = 0;
    SimTime busy_ = never;       ///< when the host is told next that it has to wait
    SimTime wait_busy_ = never;  ///< the same of a command that waits for the planner
};

}  // namespace fauxboard::filament
