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
    /// Before its end. False when there is none.
    virtual bool stop_job() = 0;
    /// Where the file goes on.
    virtual void seek_job(double byte) = 0;
    /// The board waits for its user, or so many seconds; 0: for ever.
    virtual void wait_for_user(double seconds) = 0;
    /// M112: emergency_stop(), and nothing more after what the event `board.killed` makes it say.
    virtual void kill() = 0;
};

}  // namespace fauxboard::machine
