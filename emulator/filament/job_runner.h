#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "emulator/filament/config.h"
#include "emulator/filament/gcode_codes.h"
#include "emulator/filament/gcode_line.h"
#include "emulator/filament/gcode_reader.h"
#include "emulator/filament/names.h"
#include "emulator/filament/slicer_comments.h"

namespace fauxboard::filament {

/// What a job's file was found to hold, since the start of the job.
struct JobCounts {
    std::uint64_t lines = 0;          ///< read, comments included
    std::uint64_t moves = 0;          ///< G0 to G3 carried out
    std::uint64_t unknown_codes = 0;  ///< skipped
    std::uint64_t lines_cut = 0;      ///< too long to be read to their ends
};

/// Executes the file of a job: reads its lines as the planner has room, carries out their codes on the
/// machine, and keeps the Job's place, layers and end.
///
/// It runs in virtual time and does nothing between events: it goes on when a block of the planner ends, a
/// procedure or a wait is over. A line costs no time, but in 10 ms no more than 4 KiB are read, and the line
/// in which they end (400 KB/s, what such boards read from a card), so that no file can hold the board up.
class JobRunner : public machine::BegunCommand {
  public:
    JobRunner(GcodeMachine& on, const Storage& storage, const JobConfig& config)
        : on_(on), storage_(storage), config_(config), source_{on, true} {}

    void power_on();
    /// The job starts, at its place().
    void start(SimTime now);
    /// The job pauses: remembers where the head is to be when it goes on. To be called before it is moved.
    void pause();
    /// What was read and not carried out is read anew when the job goes on at its place().
    void drop_line();
    /// It goes on: the head goes back, and the file is opened anew.
    void resume(SimTime now);
    /// The place in the file was changed (M26).
    void seek();
    /// The job is over, one way or other.
    void stop();
    /// The job is at its end: it is shown for a while.
    void finished(SimTime now);

    void advance(SimTime now);
    SimTime next_event(SimTime now) const;
    /// A finished job is still shown, for a while.
    bool shows_finished() const { return close_ != never; }

    bool run_code(bool by_rule) override;

    JobCounts counts() const { return {lines_, source_.moves, unknown_codes_, lines_cut_}; }
    /// The layer as a board tells it that goes by the nozzle's height, (Z - 0.1 mm) / layer height; that of
    /// the file's comments where none at its head says how high a layer is. 0 without a job.
    int layer_by_height() const;
    /// The byte in the file at which the move under way begins: what a power cut loses begins here.
    std::uint64_t executed_byte() const;

  private:
    bool reading() const;
    SimTime wake() const { return std::max(wake_, source_.wake); }
    bool piece();
    bool fetch();
    void take_comment();
    void execute();
    void read_tail();
    void scout(std::uint64_t bytes);
    void lose_file();

    GcodeMachine& on_;
    const Storage& storage_;
    const JobConfig& config_;
    GcodeReader reader_;
    GcodeLine line_;
    std::string_view text_;            ///< what line_ was parsed from
    const GcodeCode* code_ = nullptr;  ///< of line_
    SlicerNotes notes_;
    GcodeReader scout_;  ///< runs ahead to count layers, where no comment tells their number
    SlicerNotes scout_notes_;
    GcodeSource source_;  ///< its byte: where line_ begins
    std::uint64_t lines_ = 0;
    std::uint64_t unknown_codes_ = 0;
    std::uint64_t lines_cut_ = 0;
    std::uint64_t cut_ = 0;  ///< of the reader, as far as told
    bool held_ = false;      ///< line_ is still to be carried out, once nothing moves
    bool ended_ = false;     ///< the file is at its end; the moves are not
    SimTime wake_{0};        ///< not to go on before
    SimTime breath_end_{0};  ///< of the 10 ms in which no more is read than up to enough_byte_
    std::uint64_t enough_byte_ = 0;
    SimTime close_ = never;  ///< when the finished job is no longer shown
    AxisValues paused_at_{};
};

}  // namespace fauxboard::filament
