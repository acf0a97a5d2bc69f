#include "emulator/machine/job.h"

#include <utility>

namespace fauxboard::machine {

void Job::select(int volume, std::string path, std::uint64_t bytes) {
    *this = Job{};
    volume_ = volume;
    path_ = std::move(path);
    bytes_ = bytes;
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
}

void Job::go_on(SimTime now) {
    status_ = JobStatus::printing;
    since_ = now;
}

bool Job::close() {
    if (status_ != JobStatus::finished) {
        return false;
    }
    *this = Job{};
    return true;
}

bool Job::stop() {
    if (!active()) {
        return false;
    }
    *this = Job{};
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

SimTime Job::elapsed(SimTime now) const {
    return status_ == JobStatus::printing ? before_ + (now - since_) : before_;
}

}  // namespace fauxboard::machine
