#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/filament/gcode_codes.h"
#include "emulator/filament/gcode_line.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

/// What the commands of the USB side do, one after the other: each begins when the one before it is over, and
/// a move when the planner has room for it. That is how a host that waits for every `ok` is kept at the
/// printer's pace. Shares the modal state (units, feed) with a job, as in the firmware.
///
/// While a file that the host began (M28) is open, its lines are written to it instead, until M29.
class HostCommands {
  public:
    explicit HostCommands(Printer& printer) : source_{printer} {}

    void power_on();

    /// Whether `command` may begin now. None may while one runs.
    bool ready(std::string_view command);
    /// It begins. Ends by over(), however it is carried out.
    void begin(std::string_view command, SimTime now);
    /// Carries out the command begun by the table of codes; false when the table has no such code.
    bool run_code();
    bool running() const { return running_; }
    /// Whether the command begun still does something: a wait, a dwell, an arc, moves it is to wait for.
    bool under_way() const;
    /// It is done; raises `host.done`, unless it was acknowledged already.
    void over();
    /// What answered it was its acknowledgement as well ("ok T:..").
    void acknowledge() { acknowledged_ = true; }

    /// Whether a file of the host's is open, so that lines are kept and not carried out. Also when it can no
    /// longer be written: a host that goes on sending it must not have it printed instead.
    bool writing() const { return writing_; }
    /// The command begun becomes a line of the file that is open. False when there is none, or it is the one
    /// that ends it: it is to be carried out then. Raises `host.write_failed`, once for a file, when the disk
    /// takes no more; nothing of the file will stand under its name then.
    bool write(std::string_view command, SimTime now);
    /// After a command that may have begun or ended a file: looks at the transfer.
    void follow_transfer();

    void advance(SimTime now);
    SimTime next_event() const {
        const bool idle = busy_ == never && source_.wake == SimTime{0} && !source_.arc.active();
        return idle ? never : next_of_command();
    }

    std::int64_t last_line = 0;                              ///< number of the last good line
    std::uint64_t resends = 0;                               ///< lines asked for again, since power-on
    std::uint64_t commands = 0;                              ///< carried out, since power-on
    const std::string& command() const { return command_; }  ///< the last one begun, at most 96 bytes of it
    std::uint64_t moves() const { return source_.moves; }

  private:
    /// What the board collects before it writes: a block of the card.
    static constexpr std::size_t block_bytes = 512;

    void parse(std::string_view command);
    void flush(SimTime now);
    void stream();
    SimTime next_of_command() const;

    GcodeSource source_;
    GcodeLine line_;
    std::string parsed_;  ///< what line_ was parsed from and points into
    std::string command_;
    const GcodeCode* code_ = nullptr;  ///< of parsed_
    bool running_ = false;
    bool acknowledged_ = false;
    bool writing_ = false;
    std::string unwritten_;  ///< of the file; less than a block and a line
    SimTime busy_ = never;   ///< when the host is told next that it has to wait
};

}  // namespace fauxboard::machine
