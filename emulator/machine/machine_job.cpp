// The job as every kind has it: selected, started, paused, over. What moves by it is the kind's business.

#include <utility>

#include "emulator/machine/event_rows.h"
#include "emulator/machine/machine.h"

namespace fauxboard::machine {

void Machine::select_file(std::string_view name, bool replaces) {
    storage.asked = name.substr(name.rfind('/') + 1);
    if (replaces && !refusing && job.stop()) {
        forget_file();
        job_gives_way();
        events.raise(event("job.replaced"));
    }
    if (job.active() || refusing) {
        events.raise(event("job.refused"));
        return;
    }
    Storage::Found found = storage.find(name);
    switch (found.kind) {
        case Volume::Kind::file:
            forget_file();
            job.select(storage.chosen(), std::move(found.path), found.bytes);
            job.call_it(std::move(found.shown));
            events.raise(event("file.selected"));
            break;
        case Volume::Kind::folder:
        case Volume::Kind::unreadable:
            events.raise(event("file.unreadable"));
            break;
        case Volume::Kind::missing:
            events.raise(event("file.missing"));
            break;
    }
}

bool Machine::resume_job() {
    if (!job.resume(now_)) {
        return false;
    }
    job_goes_on();
    events.raise(event("job.resumed"));
    return true;
}

bool Machine::start_or_resume_job() {
    if (resume_job()) {
        return true;
    }
    if (refusing && job.selected() && !job.active()) {
        events.raise(event("job.refused"));
        return true;
    }
    if (!ready_to_print() || !job.start(now_)) {
        return false;
    }
    job_starts();
    events.raise(event("job.started"));
    return true;
}

void Machine::pause_job(bool park) {
    if (job.pausing()) {
        events.raise(event("job.pausing"));
        return;
    }
    if (job.begin_pause()) {
        job_pauses(park);
    }
}

bool Machine::stop_job() {
    if (!job.stop()) {
        return false;
    }
    forget_file();
    job_stops();
    events.raise(event("job.stopped"));
    return true;
}

bool Machine::finish_job() {
    if (!job.finish(now_)) {
        return false;
    }
    job_ends();
    events.raise(event("job.finished"));
    return true;
}

bool Machine::close_job() {
    if (!job.close()) {
        return false;
    }
    forget_file();
    events.raise(event("job.closed"));
    return true;
}

void Machine::emergency_stop() {
    all_off(job.stop());
}

void Machine::wait_for_user(double seconds) {
    job.waits_for_user = true;
    user_until_ = seconds > 0 ? now_ + from_seconds(seconds) : never;
}

void Machine::user_continues() {
    user_until_ = never;
    if (job.waits_for_user && !resume_job()) {
        job.waits_for_user = false;
    }
}

}  // namespace fauxboard::machine
