#pragma once

#include <cstdint>
#include <optional>

#include "emulator/filament/config.h"
#include "emulator/filament/job_place.h"
#include "emulator/filament/names.h"
#include "emulator/filament/thermal.h"
#include "emulator/machine/services.h"

namespace fauxboard::filament {

class JobRunner;

/// Keeps the place of the job under way, and after a power loss takes the job up again there: heats the bed,
/// then the nozzle, homes X and Y (the part stands in Z's way), goes to where the head was, and prints on.
/// Which of these steps a real board takes, and in which order, is not recorded.
class Recovery {
  public:
    Recovery(GcodeMachine& on, const Storage& storage, JobRunner& runner, const JobConfig& config)
        : on_(on), storage_(storage), runner_(runner), config_(config) {}

    /// Looks for a job that was cut off before this machine was made.
    void load(machine::JobPlaceStore* store);
    void power_on() { step_ = Step::none; }

    /// A job that was cut off and neither taken up nor dropped.
    const JobPlace* saved() const;
    /// Takes it up. False when there is none, or a job is under way; raises file.missing when its file is
    /// gone or has another size.
    bool begin();
    /// Drops it.
    void drop();
    /// It stands paused, as if the user had paused it.
    void stand_paused();
    /// The file of what goes on is there, and has its size.
    bool file_there() const;
    /// The job was stopped while it was being taken up.
    void abort() { step_ = Step::none; }

    /// To be called when the job may have come further.
    void keep(SimTime now);
    /// The job goes on elsewhere in its file, and so would one that is taken up.
    void seek();
    void advance(SimTime now);
    SimTime next_event(SimTime now) const { return step_ == Step::none ? never : next_step(now); }
    bool active() const { return step_ != Step::none; }

  private:
    void store();
    enum class Step : std::uint8_t { none, bed, nozzle, home, travel, print };

    SimTime next_step(SimTime now) const;
    Step after(Step step) const;
    void heat(HeaterId heater, double c, SimTime now);
    void travel(SimTime now);
    void print(SimTime now);

    GcodeMachine& on_;
    const Storage& storage_;
    JobRunner& runner_;
    const JobConfig& config_;
    machine::JobPlaceStore* store_ = nullptr;
    std::optional<JobPlace> place_;
    std::string kept_;        ///< the place as bytes; the buffer is reused
    Step step_ = Step::none;  ///< what comes next
};

}  // namespace fauxboard::filament
