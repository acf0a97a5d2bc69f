#pragma once

namespace fauxboard::machine {

/// What a part of a machine may do to the job under way; the machine does it.
class JobControl {
  public:
    virtual ~JobControl() = default;
    /// `park`: the head, or what stands for it, goes out of the way.
    virtual void pause_job(bool park) = 0;
    /// The job is at its end. False when none prints.
    virtual bool finish_job() = 0;
    /// A finished job is no longer shown. False when there is none.
    virtual bool close_job() = 0;
    virtual void emergency_stop() = 0;
};

}  // namespace fauxboard::machine
