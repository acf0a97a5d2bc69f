#pragma once

#include <cstdint>
#include <optional>

#include "emulator/filament/job_place.h"
#include "emulator/filament/thermal.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

class Printer;

/// Keeps the place of the job under way, and after a power loss takes the job up again there: heats the bed,
/// then the nozzle, homes X and Y (the part stands in Z's way), goes to where the head was, and prints on.
/// Which of these steps a real board takes, and in which order, is not recorded.
class Recovery {
  public:
    explicit Recovery(Printer& printer) : printer_(printer) {}

    /// Looks for a job that was cut off before this machine was made.
    void load(JobPlaceStore* store);
    void power_on() { step_ = Step::none; }

    /// A job that was cut off and neither taken up nor dropped.
    const JobPlace* saved() const;
    /// Takes it up. False when there is none, or a job is under way; raises file.missing when its file is
    /// gone or has another size.
    bool begin();
    /// Drops it.
    void drop();
    /// The job was stopped while it was being taken up.
    void abort() { step_ = Step::none; }

    /// To be called when the job may have come further.
    void keep();
    void advance(SimTime now);
    SimTime next_event() const { return step_ == Step::none ? never : next_step(); }
    bool active() const { return step_ != Step::none; }

  private:
    enum class Step : std::uint8_t { none, bed, nozzle, home, travel, print };

    SimTime next_step() const;
    void heat(HeaterId heater, double c);
    void travel();
    void print();

    Printer& printer_;
    JobPlaceStore* store_ = nullptr;
    std::optional<JobPlace> place_;
    Step step_ = Step::none;  ///< what comes next
};

}  // namespace fauxboard::machine
