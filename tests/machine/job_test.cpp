#include "emulator/machine/job.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace fauxboard::machine;

namespace {

SimTime at(double s) {
    return from_seconds(s);
}

Job selected() {
    Job job;
    job.select(0, "Sub/a.gco", 1000);
    return job;
}

}  // namespace

TEST_CASE("job: nothing starts without a file, and nothing starts twice") {
    Job none;
    CHECK_FALSE(none.start(at(0)));
    CHECK_FALSE(none.stop());
    CHECK_FALSE(none.finish(at(0)));
    CHECK_FALSE(none.resume(at(0)));
    CHECK_FALSE(none.begin_pause());
    CHECK(none.status() == JobStatus::idle);
    Job job = selected();
    CHECK(job.start(at(0)));
    CHECK_FALSE(job.start(at(1)));
}

TEST_CASE("job: the time printed leaves pauses out") {
    Job job = selected();
    CHECK(job.elapsed(at(50)) == at(0));
    job.start(at(100));
    CHECK(job.elapsed(at(110)) == at(10));
    CHECK(job.begin_pause());
    CHECK(job.elapsed(at(112)) == at(12));  // still on its way to park
    job.pause(at(115));
    CHECK(job.status() == JobStatus::paused);
    CHECK_FALSE(job.pausing());
    CHECK(job.elapsed(at(200)) == at(15));
    CHECK(job.resume(at(300)));
    CHECK(job.elapsed(at(305)) == at(20));
    CHECK(job.finish(at(310)));
    CHECK(job.elapsed(at(999)) == at(25));
}

TEST_CASE("job: only one pause at a time, and only while printing") {
    Job job = selected();
    CHECK_FALSE(job.begin_pause());
    job.start(at(0));
    CHECK(job.begin_pause());
    CHECK_FALSE(job.begin_pause());
    job.pause(at(1));
    CHECK_FALSE(job.begin_pause());
    job.pause(at(99));
    CHECK(job.elapsed(at(99)) == at(1));
}

TEST_CASE("job: progress follows the byte, finished is 100, idle is 0") {
    Job job = selected();
    CHECK(job.progress_percent() == 0);
    job.set_byte(500);
    CHECK(job.progress_percent() == 0);
    CHECK(job.byte() == 0);
    job.start(at(0));
    CHECK(job.byte() == 500);  // M26 before M24: there it begins
    CHECK(job.bytes() == 1000);
    job.set_byte(509.9);
    CHECK(job.byte() == 509);
    CHECK(job.progress_percent() == 50);
    job.set_byte(-5);
    CHECK(job.byte() == 0);
    job.set_byte(std::nan(""));
    CHECK(job.byte() == 0);
    job.set_byte(std::numeric_limits<double>::infinity());
    CHECK(job.byte() == 1000);
    job.finish(at(1));
    CHECK(job.progress_percent() == 100);
    CHECK(job.byte() == 0);
    CHECK(job.path() == "Sub/a.gco");
    Job empty;
    empty.select(0, "empty.gco", 0);
    empty.start(at(0));
    CHECK(empty.progress_percent() == 0);
}

TEST_CASE("job: a finished job can start again, a stopped one is forgotten") {
    Job job = selected();
    job.start(at(0));
    job.layer = 5;
    job.finish(at(10));
    CHECK(job.start(at(20)));
    CHECK(job.layer == 0);
    CHECK(job.elapsed(at(21)) == at(1));
    CHECK(job.stop());
    CHECK_FALSE(job.selected());
    CHECK(job.status() == JobStatus::idle);
    CHECK(job.elapsed(at(99)) == at(0));
}

TEST_CASE("job: progress of a file of many gigabytes does not overflow") {
    Job job;
    job.select(1, "big", 4'000'000'000'000ULL);
    job.start(at(0));
    job.set_byte(3e12);
    CHECK(job.progress_percent() == 75);
    CHECK(job.volume() == 1);
}
