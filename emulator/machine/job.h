#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

/// Print status as L3 tells it (PS).
enum class JobStatus : std::uint8_t { idle = 0, printing = 1, paused = 2, recovery = 3, finished = 4 };

/// The print job: what is selected, how it stands. Executing the file's G-code is the business of JobRunner,
/// which moves `byte` and `layer` on.
class Job {
  public:
    void power_on() { *this = Job{}; }

    void select(int volume, std::string path, std::uint64_t bytes);
    bool selected() const { return !path_.empty(); }
    /// False when nothing is selected or a job is already under way. Begins where set_byte() said, else at
    /// the file's start.
    bool start(SimTime now);
    bool begin_pause();
    void pause(SimTime now);
    bool resume(SimTime now);
    /// The selected file is taken up at `byte` again, after a power loss; go_on() then prints.
    void recover(std::uint64_t byte, SimTime elapsed);
    void go_on(SimTime now);
    /// False when there is no job.
    bool stop();
    bool finish(SimTime now);
    /// A finished job is no longer shown. False when there is none.
    bool close();
    /// A job that a power loss cut off stands paused.
    void stand_paused(std::uint64_t byte, SimTime elapsed);
    /// Whatever there is, it has come to its end, where it is; a new one must be selected.
    void end(SimTime now);

    JobStatus status() const { return status_; }
    /// Printing, paused, or being taken up after a power loss.
    bool active() const {
        return status_ == JobStatus::printing || status_ == JobStatus::paused ||
               status_ == JobStatus::recovery;
    }
    bool pausing() const { return pausing_; }
    int volume() const { return volume_; }
    /// Path on its disk.
    const std::string& path() const { return path_; }
    /// The file that was printed last, or is; it stays when the print is over.
    const std::string& shown() const { return shown_; }
    /// What the file is called where it is shown, if that is not its path.
    void call_it(std::string name) { name_ = std::move(name); }
    const std::string& called() const { return name_.empty() ? path_ : name_; }
    std::uint64_t byte() const { return active() ? byte_ : 0; }
    std::uint64_t bytes() const { return active() ? bytes_ : 0; }
    /// Size of the file selected.
    std::uint64_t file_bytes() const { return bytes_; }
    /// Where the job begins, or goes on: in the file selected, whatever its state.
    std::uint64_t place() const { return byte_; }
    /// M26; beyond the end is the end.
    void set_byte(double byte);
    int progress_percent() const;
    /// Time printed so far, pauses left out.
    SimTime elapsed(SimTime now) const;
    /// The same; of the job before, when there is none.
    SimTime shown_elapsed(SimTime now) const;
    /// PG, decimals included.
    double progress() const;
    int layer = 0;
    int layers = 0;
    double estimate_s = 0;  ///< what the slicer thinks it takes; 0 when it did not say
    std::string message;    ///< of the last M117
    /// A part of the file that is done more than once (M808): where it begins, and how often still; 0: for
    /// ever.
    struct Loop {
        std::uint64_t byte = 0;
        int times = 0;
    };
    std::vector<Loop> loops;
    bool waits_for_user = false;  ///< M0, M1, M600
    bool stands_by = false;  ///< a command of the screen's is carried out to its end; the file is not read

  private:
    void forget();

    JobStatus status_ = JobStatus::idle;
    bool pausing_ = false;
    int volume_ = 0;
    std::string path_;
    std::string name_;
    std::string shown_;
    SimTime shown_elapsed_{0};
    std::uint64_t byte_ = 0;
    std::uint64_t bytes_ = 0;
    SimTime before_{0};  ///< printed up to the last pause
    SimTime since_{0};   ///< start of the running stretch
};

}  // namespace fauxboard::machine
