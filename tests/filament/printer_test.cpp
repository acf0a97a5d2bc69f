// The printer as a whole: parts that touch one another.

#include "emulator/filament/printer.h"

#include <doctest/doctest.h>

#include <set>

#include "emulator/filament/event_rows.h"

using namespace fauxboard::filament;

namespace {

std::shared_ptr<Config> config() {
    auto out = std::make_shared<Config>();
    ProcedureStep home;
    home.kind = ProcedureStep::Kind::homed;
    home.values = {0, 0, 0, {}};
    ProcedureStep park;
    park.kind = ProcedureStep::Kind::to;
    park.values[1] = 100;
    park.feed_mm_s = 50;
    out->motion.procedures["home"] = {home};
    out->motion.procedures["park"] = {park};
    out->card.entries = {{"a.gco", false, "12345", {}}};
    return out;
}

struct Bench {
    Printer machine{config(), {}, 1};
    Bench() { machine.power_on(SimTime{0}); }
    void pass(double s) { machine.advance(machine.now() + from_seconds(s)); }
    bool raised(EventId id) {
        bool found = false;
        while (const auto taken = machine.events.take()) {
            found = found || *taken == id;
        }
        return found;
    }
    void print() {
        machine.select_file("a.gco");
        machine.start_or_resume_job();
        machine.events.clear();
    }
};

}  // namespace

TEST_CASE("printer: a procedure that the profile lacks is not run") {
    Bench bench;
    CHECK(bench.machine.home(0));
    CHECK(bench.machine.home(7));
    CHECK_FALSE(bench.machine.home(2));
    CHECK_FALSE(bench.machine.run("nothing"));
}

TEST_CASE("printer: a pause parks, and is there when the head has come to rest") {
    Bench bench;
    bench.print();
    bench.machine.pause_job();
    CHECK(bench.machine.job.pausing());
    CHECK(bench.machine.job.status() == JobStatus::printing);
    bench.pass(10);
    CHECK(bench.raised(event("job.paused")));
    CHECK(bench.machine.job.status() == JobStatus::paused);
    CHECK(bench.machine.motion.position(Axis::y) == 100);
    CHECK(bench.machine.start_or_resume_job());
    CHECK(bench.raised(event("job.resumed")));
}

TEST_CASE("printer: a pause is done at once where there is no parking") {
    auto bare = config();
    bare->motion.procedures.clear();
    Printer machine(bare, {}, 1);
    machine.power_on(SimTime{0});
    machine.select_file("a.gco");
    machine.start_or_resume_job();
    machine.pause_job();
    CHECK(machine.job.status() == JobStatus::paused);
}

TEST_CASE("printer: stopping a job switches its heaters off and drops its moves") {
    Bench bench;
    CHECK_FALSE(bench.machine.stop_job());
    bench.print();
    bench.machine.thermal.set_target(HeaterId::nozzle, 200);
    bench.machine.run("park");
    CHECK(bench.machine.stop_job());
    CHECK(bench.machine.thermal.target_c(HeaterId::nozzle) == 0);
    CHECK_FALSE(bench.machine.motion.busy());
    CHECK(bench.raised(event("job.stopped")));
}

TEST_CASE("printer: filament runs out only while printing, and only for a detector that is on") {
    for (const bool printing : {false, true}) {
        for (const bool detector : {false, true}) {
            Bench bench;
            bench.machine.set_filament(true);
            bench.machine.filament.detector = detector;
            if (printing) {
                bench.print();
            }
            bench.machine.events.clear();
            bench.machine.set_filament(false);
            CHECK(bench.raised(event("filament.out")) == (printing && detector));
        }
    }
}

TEST_CASE("printer: disks as L2 tells them, the U-disk in the high nibble where there is a port") {
    Bench bench;
    CHECK(bench.machine.disk_code() == 0);
    bench.machine.remove_card(0);
    CHECK(bench.machine.disk_code() == 1);
    bench.machine.storage.set_state(0, fauxboard::machine::DiskState::failed);
    CHECK(bench.machine.disk_code() == 2);
    auto with_port = config();
    with_port->udisk_port = true;
    Printer two(with_port, {}, 1);
    two.power_on(SimTime{0});
    CHECK(two.disk_code() == 16);
    two.remove_card(0);
    CHECK(two.disk_code() == 17);
}

TEST_CASE("printer: a missing card is found out some time after power-on, once") {
    auto empty = config();
    empty->card.present = false;
    Printer machine(empty, {}, 1);
    machine.power_on(SimTime{0});
    CHECK(machine.next_event() > from_seconds(0.9));
    machine.advance(from_seconds(0.9));
    CHECK(machine.events.empty());
    machine.advance(from_seconds(60));
    CHECK(machine.events.take() == event("card.missing"));
    CHECK(machine.events.empty());
    machine.insert_card(0);  // there is no card to put in
    CHECK(machine.disk_code() == 1);
}

TEST_CASE("printer: what may change by itself is told, so that nobody need look at a machine at rest") {
    Bench bench;
    bench.pass(5);
    CHECK_FALSE(bench.machine.restless());
    CHECK(bench.machine.next_event() == never);
    bench.machine.run("park");
    CHECK(bench.machine.restless());
    bench.pass(60);
    CHECK_FALSE(bench.machine.restless());
    bench.machine.thermal.set_target(HeaterId::bed, 50);
    CHECK(bench.machine.restless());
    bench.machine.thermal.set_target(HeaterId::bed, 0);
    bench.print();
    CHECK(bench.machine.restless());
}

TEST_CASE("printer: an emergency stop ends all that moves and heats") {
    Bench bench;
    bench.machine.thermal.set_temperature(HeaterId::nozzle, 200);
    bench.pass(0.4);
    bench.print();
    bench.machine.thermal.set_target(HeaterId::nozzle, 250);
    bench.machine.wait.start(HeaterId::nozzle, bench.machine.now(), bench.machine.events);
    bench.machine.feed(Feeder::Mode::load);
    bench.machine.run("park");
    bench.machine.emergency_stop();
    CHECK(bench.machine.next_event() == never);
    CHECK(bench.machine.thermal.target_c(HeaterId::nozzle) == 0);
    CHECK(bench.machine.job.status() == JobStatus::idle);
    CHECK_FALSE(bench.machine.motion.motors());
}

TEST_CASE("printer: its random numbers are its seed's, and lie in [0, 1)") {
    Printer one(config(), {}, 7);
    Printer same(config(), {}, 7);
    Printer other(config(), {}, 8);
    bool differs = false;
    for (int i = 0; i < 1000; ++i) {
        const double r = one.random();
        REQUIRE(r >= 0);
        REQUIRE(r < 1);
        REQUIRE(r == same.random());
        differs = differs || r != other.random();
    }
    CHECK(differs);
}
