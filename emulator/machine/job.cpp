#include "emulator/machine/job.h"

#include <utility>

namespace fauxboard::machine {

void Job::select(int volume, std::string path, std::uint64_t bytes) {
    forget();
    volume_ = volume;
    path_ = std::move(path);
    bytes_ = bytes;
}

/// All but what is still shown of the job before.
void Job::forget() {
    Job fresh;
    fresh.shown_ = std::move(shown_);
    fresh.shown_elapsed_ = active() || status_ == JobStatus::finished ? before_ : shown_elapsed_;
    *this = std::move(fresh);
}

bool Job::start(SimTime now) {
    if (!selected() || active()) {
        return false;
    }
    if (status_ == JobStatus::finished) {
        byte_ = 0;  // once more, from the start
    }
    status_ = JobStatus::printing;
    before_ = SimTime{0};
    since_ = now;
    layer = 0;
    message.clear();
    shown_ = called();
    return true;
}

bool Job::begin_pause() {
    if (status_ != JobStatus::printing || pausing_) {
        return false;
    }
    pausing_ = true;
    return true;
}

void Job::pause(SimTime now) {
    if (status_ != JobStatus::printing) {
        return;
    }
    before_ += now - since_;
    pausing_ = false;
    status_ = JobStatus::paused;
}

bool Job::resume(SimTime now) {
    if (status_ != JobStatus::paused) {
        return false;
    }
    since_ = now;
    status_ = JobStatus::printing;
    waits_for_user = false;
    return true;
}

void Job::recover(std::uint64_t byte, SimTime elapsed) {
    status_ = JobStatus::recovery;
    byte_ = byte;
    before_ = elapsed;
    shown_ = called();
}

void Job::stand_paused(std::uint64_t byte, SimTime elapsed) {
    recover(byte, elapsed);
    status_ = JobStatus::paused;
}

void Job::end(SimTime now) {
    before_ = elapsed(now);
    pausing_ = waits_for_user = false;
    status_ = JobStatus::finished;
}

void Job::go_on(SimTime now) {
    status_ = JobStatus::printing;
    since_ = now;
}

bool Job::close() {
    if (status_ != JobStatus::finished) {
        return false;
    }
    forget();
    return true;
}

bool Job::stop() {
    if (!active()) {
        return false;
    }
    forget();
    return true;
}

bool Job::finish(SimTime now) {
    if (status_ != JobStatus::printing) {
        return false;
    }
    before_ += now - since_;
    byte_ = bytes_;
    pausing_ = false;
    status_ = JobStatus::finished;
    return true;
}

void Job::set_byte(double byte) {
    byte_ = !(byte > 0) ? 0 : byte >= static_cast<double>(bytes_) ? bytes_ : static_cast<std::uint64_t>(byte);
}

int Job::progress_percent() const {
    if (status_ == JobStatus::finished) {
        return 100;
    }
    return active() && bytes_ > 0 ? static_cast<int>(byte_ * 100 / bytes_) : 0;
}

double Job::progress() const {
    if (status_ == JobStatus::finished) {
        return 100;
    }
    return active() && bytes_ > 0 ? static_cast<double>(byte_) * 100 / static_cast<double>(bytes_) : 0;
}

SimTime Job::elapsed(SimTime now) const {
    return status_ == JobStatus::printing ? before_ + (now - since_) : before_;
}

SimTime Job::shown_elapsed(SimTime now) const {
    return active() || status_ == JobStatus::finished ? elapsed(now) : shown_elapsed_;
}

}  // namespace fauxboard::machine
