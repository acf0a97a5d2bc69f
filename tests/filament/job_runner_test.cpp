// Jobs executed by the machine alone: no board, no frames.

#include "emulator/filament/job_runner.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/printer.h"
#include "tests/support/reference_time.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard::filament;
using fauxboard::testing::make_sliced_file;
using fauxboard::testing::MemoryDisk;
using fauxboard::testing::reference_seconds;
using fauxboard::testing::SlicedFile;

namespace {

std::shared_ptr<const Config> config() {
    auto made = std::make_shared<Config>();
    ProcedureStep lift;
    lift.kind = ProcedureStep::Kind::by;
    lift.values[2] = 5;
    lift.feed_mm_s = 20;
    ProcedureStep aside;
    aside.kind = ProcedureStep::Kind::to;
    aside.values = {0, 300, std::nullopt, std::nullopt};
    aside.feed_mm_s = 100;
    made->motion.procedures["park"] = {lift, aside};
    ProcedureStep home;
    home.kind = ProcedureStep::Kind::homed;
    home.values = {0, 0, 0, std::nullopt};
    home.seconds = 30;
    made->motion.procedures["home"] = {home};
    return made;
}

struct Machine {
    MemoryDisk disk;
    Printer printer;
    std::vector<EventId> raised;

    explicit Machine(const std::string& content, const std::shared_ptr<const Config>& of = config())
        : printer(of, {&disk, nullptr, nullptr}, 1) {
        disk.put("x.gcode", content);
        printer.power_on(SimTime{0});
        printer.select_file("x.gcode");
        printer.start_or_resume_job();
    }

    void take_events() {
        while (const auto event = printer.events.take()) {
            raised.push_back(*event);
        }
    }
    /// Runs from event to event until `seconds`, or until nothing more comes.
    void run_until(double seconds) {
        const SimTime end = from_seconds(seconds);
        while (printer.next_event() <= end) {
            printer.advance(printer.next_event());
            take_events();
        }
        printer.advance(end);
        take_events();
    }
    /// Runs to the end of the job; gives the seconds printed.
    double finish(double limit = 1e6) {
        while (printer.job.status() == JobStatus::printing) {
            const SimTime next = printer.next_event();
            REQUIRE(next != never);
            REQUIRE(to_seconds(next) < limit);
            printer.advance(next);
            take_events();
        }
        return to_seconds(printer.job.elapsed(printer.now()));
    }
    std::ptrdiff_t count(EventId id) const { return std::count(raised.begin(), raised.end(), id); }
    double position(Axis axis) const { return printer.motion.position(axis); }
};

double moves_of(const std::string& content) {
    Machine machine(content);
    return machine.finish();
}

}  // namespace

TEST_CASE("job time: within 1 % of the reference on files of three different characters") {
    // The reference itself, held against PrusaSlicer 2.5 on three sliced files (a box, a wave, 25 pins, with
    // these settings), differs from it by 0.2, 0.3 and 0.6 %; the planner by 0.2, 0.3 and 0.7 %.
    for (const SlicedFile::Shape shape :
         {SlicedFile::Shape::infill, SlicedFile::Shape::curves, SlicedFile::Shape::towers}) {
        CAPTURE(static_cast<int>(shape));
        SlicedFile wishes;
        wishes.shape = shape;
        wishes.moves = 20'000;
        wishes.layers = 20;
        const std::string text = make_sliced_file(wishes);
        Machine machine(text);
        const double reference = reference_seconds(text, machine.printer.settings);
        CHECK(reference > 300);
        CHECK(machine.finish() == doctest::Approx(reference).epsilon(0.01));
        CHECK(machine.printer.job.layer == 20);
        CHECK(machine.printer.runner.counts().moves >= 20'000);
        CHECK(machine.printer.runner.counts().unknown_codes == 0);
    }
}

TEST_CASE("job time: print speed counts for the moves read after it") {
    const std::string way = "G1 X0 F1800\nG1 X200\nG1 X0\n";
    const double whole = moves_of(way);
    CHECK(moves_of("M220 S50\n" + way) == doctest::Approx(2 * whole).epsilon(0.02));
    CHECK(moves_of("M220 S200\n" + way) == doctest::Approx(whole / 2).epsilon(0.08));
}

TEST_CASE("job codes: inches, relative and absolute, G92, E of its own") {
    Machine machine(
        "G21\nG90\nG1 X10 Y10 F6000\nG91\nG1 X5\nG1 X5 Y-3\nG90\nG20\nG1 Y1\nG21\nG92 X100\nG1 X110\n"
        "M83\nG1 E2\nG1 E2\nM82\nG1 E10\nG92 E0\nG1 E1\nG92\n");
    machine.finish();
    CHECK(machine.position(Axis::x) == 0);  // a bare G92 is all zeros
    Machine other(
        "G1 X10 F6000\nG91\nG1 X5\nG1 X5\nG90\nG20\nG1 Y1\nG21\nG92 X100\nG1 X110\nM83\nG1 E2\nG1 E2\n");
    other.finish();
    CHECK(other.position(Axis::x) == 110);
    CHECK(other.position(Axis::y) == doctest::Approx(25.4));
    CHECK(other.position(Axis::e) == 4);
}

TEST_CASE("job codes: moves stay inside the build volume; arcs end where they should") {
    Machine machine("G1 X-5 Y900 Z2 F6000\n");
    machine.finish();
    CHECK(machine.position(Axis::x) == 0);
    CHECK(machine.position(Axis::y) == 320);
    Machine arcs("G1 X100 Y100 F3000\nG2 X120 Y100 I10 J0\nG3 X120 Y140 R20\n");
    arcs.finish();
    CHECK(arcs.position(Axis::x) == 120);
    CHECK(arcs.position(Axis::y) == 140);
    CHECK(arcs.printer.runner.counts().moves == 3);
}

TEST_CASE("job codes: a dwell, M400 and homing wait for the moves before them") {
    const double way = moves_of("G1 X100 F3000\n");
    CHECK(moves_of("G1 X100 F3000\nG4 S7\n") == doctest::Approx(way + 7).epsilon(0.001));
    CHECK(moves_of("G1 X100 F3000\nG4 P1500\nM400\n") == doctest::Approx(way + 1.5).epsilon(0.001));
    Machine machine("G1 X100 F3000\nG28\nG1 X100\n");
    CHECK(machine.finish() >= way + 30);
    CHECK(machine.printer.motion.homed());
}

TEST_CASE("job codes: heaters, fans, mixing, settings") {
    Machine machine(
        "M106 S128\nM104 S200\nM140 S50\nM165 A1 B1 C0\nM203 Z7\nM201 X300\nM204 S400 T450\nM205 X5 S2\n"
        "M92 E400\nM221 S90\nM106 P2 S255\nG4 S1\nT2\n");
    machine.run_until(0.5);
    Printer& p = machine.printer;
    CHECK(p.thermal.target_c(HeaterId::nozzle) == 200);
    CHECK(p.thermal.target_c(HeaterId::bed) == 50);
    CHECK(p.fans.part_percent == 50);
    CHECK(p.fans.second_percent == 100);
    CHECK(p.mixer.ratio() == Ratio{50, 50, 0});
    CHECK(p.settings.velocity_mm_s[2] == 7);
    CHECK(p.settings.max_acceleration_mm_s2[0] == 300);
    CHECK(p.settings.acceleration_mm_s2 == 400);
    CHECK(p.settings.retract_acceleration_mm_s2 == 450);
    CHECK(p.settings.jerk_mm_s[0] == 5);
    CHECK(p.settings.min_velocity_mm_s == 2);
    CHECK(p.settings.steps_per_mm[3] == 400);
    CHECK(p.motion.flow_percent() == 90);
    machine.finish();
    CHECK(p.mixer.tool() == 2);
    Machine weights("M163 S0 P1\nM163 S2 P3\nM164\nM104 S200\nM104 S0 T1\n");
    weights.finish();
    CHECK(weights.printer.mixer.ratio() == Ratio{25, 0, 75});
    CHECK(weights.printer.thermal.target_c(HeaterId::nozzle) == 200);  // T1 is not the one that prints
}

TEST_CASE("job codes: M109 waits for the nozzle, then goes on") {
    Machine machine("M109 S60\nG1 X10 F3000\n");
    machine.run_until(5);
    CHECK(machine.printer.wait.active());
    CHECK(machine.position(Axis::x) == 0);
    CHECK(machine.finish(300) > 10);
    CHECK(machine.position(Axis::x) == 10);
    CHECK(machine.printer.thermal.temperature_c(HeaterId::nozzle) > 50);
    // The wait is broken off from outside (M108): the job goes on, and does not stand still for ever.
    Machine cut("M109 S200\nG1 X10 F3000\n");
    cut.run_until(5);
    cut.printer.wait.cancel(cut.printer.events);
    CHECK(cut.finish(10) < 7);
}

TEST_CASE("job codes: unknown ones are skipped and counted, known ones without effect are not") {
    Machine machine("M900 K0.1\nM105\nG5 X1\nhello\nM117 hi\nM115\n%\n");
    machine.finish();
    CHECK(machine.printer.runner.counts().unknown_codes == 3);
    CHECK(machine.printer.runner.counts().lines == 7);
}

TEST_CASE("job: messages come one by one, each while it is the job's message") {
    Machine machine("M117 one\nM117 two ; said\nM117\n" + std::string("M117 ") + std::string(200, 'x') +
                    "\n");
    std::vector<std::string> messages;
    while (machine.printer.job.status() == JobStatus::printing) {
        machine.printer.advance(machine.printer.next_event());
        while (const auto taken = machine.printer.events.take()) {
            if (*taken == event("job.message")) {
                messages.push_back(machine.printer.job.message);
            }
        }
    }
    CHECK(messages == std::vector<std::string>{"one", "two", "", std::string(60, 'x')});
}

TEST_CASE("job: a pause finishes what is planned, parks, and the job goes on where it was") {
    std::string text = "G1 Z1 F1200\n";
    for (int i = 0; i < 200; ++i) {
        text += i % 2 == 0 ? "G1 X100 Y50 E1 F3000\n" : "G1 X50 Y50 E2\n";
    }
    const double whole = moves_of(text);
    Machine machine(text);
    machine.run_until(20);
    machine.printer.pause_job();
    CHECK(machine.printer.job.pausing());
    CHECK(machine.printer.job.status() == JobStatus::printing);
    machine.run_until(60);
    CHECK(machine.printer.job.status() == JobStatus::paused);
    CHECK(machine.count(event("job.paused")) == 1);
    CHECK(machine.position(Axis::y) == 300);
    CHECK(machine.position(Axis::z) == 6);
    const std::uint64_t byte = machine.printer.job.byte();
    machine.run_until(600);
    CHECK(machine.printer.job.byte() == byte);
    CHECK(machine.printer.start_or_resume_job());
    machine.run_until(620);
    CHECK(machine.position(Axis::z) == 1);
    CHECK(machine.position(Axis::y) == 50);
    machine.finish();
    CHECK(machine.printer.runner.counts().moves == 201);
    CHECK(to_seconds(machine.printer.job.elapsed(machine.printer.now())) < whole + 25);
    CHECK(machine.printer.job.progress_percent() == 100);
}

TEST_CASE("job: a stop ends it at once, and nothing of it comes after") {
    Machine machine("G1 X300 F600\nG1 X0\nM109 S200\n");
    machine.run_until(5);
    CHECK(machine.printer.stop_job());
    CHECK_FALSE(machine.printer.motion.busy());
    machine.run_until(6);  // the wait for the nozzle, read ahead of the moves, finds it switched off
    CHECK(machine.printer.next_event() == never);
    machine.run_until(100);
    CHECK(machine.printer.job.status() == JobStatus::idle);
    CHECK(machine.count(event("job.finished")) == 0);
}

TEST_CASE("job: at its end it is finished for a while, then the machine is idle") {
    Machine machine("G1 X10 F3000\n");
    machine.finish();
    CHECK(machine.printer.job.status() == JobStatus::finished);
    CHECK(machine.count(event("job.finished")) == 1);
    CHECK_FALSE(machine.printer.motion.busy());
    machine.run_until(60);
    CHECK(machine.printer.job.status() == JobStatus::idle);
    CHECK(machine.count(event("job.closed")) == 1);
    CHECK(machine.printer.next_event() == never);
}

TEST_CASE("job: an empty file, and one of comments only, are finished soon") {
    CHECK(moves_of("") == 0);
    std::string comments;
    for (int i = 0; i < 10'000; ++i) {
        comments += "; nothing but words\n";
    }
    const double seconds = moves_of(comments);
    CHECK(seconds > 0.1);  // but the board gets its breath back in between
    CHECK(seconds < 2);
}

TEST_CASE("job: no step of the machine reads more than a few thousand bytes") {
    std::string text;
    for (int i = 0; i < 50'000; ++i) {
        text += "G92 E0\n";
    }
    Machine machine(text);
    std::uint64_t before = machine.printer.runner.counts().lines;
    while (machine.printer.job.status() == JobStatus::printing) {
        machine.printer.advance(machine.printer.next_event());
        const std::uint64_t lines = machine.printer.runner.counts().lines;
        REQUIRE(lines - before <= 4096 / 7 + 2);
        before = lines;
    }
}

TEST_CASE("job: however fast the moves between them, no more than 4 KiB are read in 10 ms") {
    std::string text = "M205 X1000000\nM203 X1000000\nM201 X1000000\nM204 S1000000\nG0 F99999999\n";
    for (int i = 0; i < 1000; ++i) {
        text += (i % 2 == 0 ? "G1 X3\n" : "G1 X0\n") + std::string(180, '\n');
    }
    Machine machine(text);
    for (std::uint64_t before = 0; machine.printer.job.status() == JobStatus::printing;) {
        machine.run_until(to_seconds(machine.printer.now()) + 0.01);
        const std::uint64_t lines = machine.printer.runner.counts().lines;
        REQUIRE(lines - before <= 2 * 4096 + 2);  // two such times may begin in these 10 ms
        before = lines;
    }
    CHECK(machine.printer.runner.counts().moves == 1001);
}

TEST_CASE("job: a dwell lasts as long as it says, wherever it stands in the file") {
    for (const std::size_t before : {0U, 4080U, 4090U, 4095U, 4096U, 5000U}) {
        CAPTURE(before);
        CHECK(moves_of(std::string(before, '\n') + "G4 S20\n") == doctest::Approx(20).epsilon(0.002));
    }
}

TEST_CASE("job: paused again and again while the head is still on its way back, it keeps its place") {
    Machine machine("G91\nG1 X10 F3000\nG4 S1000\nG4 S5\n");
    machine.run_until(10);
    const std::uint64_t place = machine.printer.job.place();
    double now = 10;
    for (int i = 0; i < 40; ++i) {
        machine.printer.pause_job();
        machine.run_until(now += 30);
        REQUIRE(machine.printer.job.status() == JobStatus::paused);
        machine.printer.start_or_resume_job();
        machine.run_until(now += 0.1);
        REQUIRE(machine.printer.motion.busy());
        CHECK(machine.printer.job.place() == place);
    }
    machine.finish();
    CHECK(machine.printer.runner.counts().moves == 1);
    CHECK(machine.position(Axis::x) == 10);
}

TEST_CASE("job: progress never goes back, and layers come in their order") {
    SlicedFile wishes;
    wishes.moves = 2'000;
    wishes.layers = 10;
    for (const SlicedFile::Slicer slicer : {SlicedFile::Slicer::cura, SlicedFile::Slicer::prusa,
                                            SlicedFile::Slicer::simplify3d, SlicedFile::Slicer::ideamaker}) {
        CAPTURE(static_cast<int>(slicer));
        wishes.slicer = slicer;
        Machine machine(make_sliced_file(wishes));
        machine.run_until(0.001);
        CHECK(machine.printer.job.layers == 10);
        int progress = 0;
        int layer = 0;
        while (machine.printer.job.status() == JobStatus::printing) {
            machine.printer.advance(machine.printer.next_event());
            const Job& job = machine.printer.job;
            REQUIRE(job.progress_percent() >= progress);
            REQUIRE(job.layer >= layer);
            REQUIRE(job.layer <= layer + 1);
            REQUIRE(machine.printer.runner.executed_byte() <= job.place());
            progress = job.progress_percent();
            layer = job.layer;
        }
        CHECK(progress == 100);
        CHECK(layer == 10);
    }
}

TEST_CASE("job: moves that waited before it began say nothing of its place") {
    auto at_once = std::make_shared<Config>(*config());
    at_once->job.pause_at_once = true;
    Machine machine("M82\nG1 X20 Y20 F6000\nG1 X10 Y10\n", at_once);
    machine.printer.stop_job();
    machine.printer.motion.stream({200, 0, 0, 0}, 1, 77);  // of the job before, or of a host
    machine.printer.select_file("x.gcode");
    machine.printer.start_or_resume_job();
    machine.run_until(1);
    CHECK(machine.printer.runner.executed_byte() == 4);
    machine.printer.pause_job();
    CHECK(machine.printer.job.status() == JobStatus::paused);
    CHECK(machine.printer.job.place() == 4);
    machine.printer.start_or_resume_job();
    machine.finish();
    CHECK(machine.printer.runner.counts().moves == 4);  // two were thrown away with the pause
}

TEST_CASE("job: a paused job that is sought elsewhere goes on there, also where it is taken up anew") {
    auto anew = std::make_shared<Config>(*config());
    anew->job.pause_at_once = anew->job.resume_homes_first = true;
    Machine machine("G1 X20 F600\nG1 X30\nG1 X40\n", anew);
    machine.run_until(0.5);
    machine.printer.pause_job();
    CHECK(machine.printer.job.place() == 0);
    machine.printer.seek_job(19);
    machine.printer.start_or_resume_job();
    machine.run_until(300);
    CHECK(machine.count(event("job.finished")) == 1);
    CHECK(machine.printer.runner.counts().moves == 1);
    CHECK(machine.position(Axis::x) == 40);
}

TEST_CASE("job: an arc comes to its end, however much filament it asks for") {
    Machine machine("G2 I5 J5 E12676795308826984226 F6000\nG1 X1\n");
    CHECK(machine.finish() < 86'400);
    CHECK(machine.position(Axis::x) == 1);
}

TEST_CASE("job: an arc that a pause cuts off is made anew, once, and what was held behind it") {
    auto at_once = std::make_shared<Config>(*config());
    at_once->job.pause_at_once = true;
    Machine machine("G1 X50 Y50 F600\nG2 X50 Y50 I20 J0\nM400\nG1 X60\n", at_once);
    machine.run_until(10);
    machine.printer.pause_job();
    CHECK(machine.printer.job.place() == 16);
    machine.printer.start_or_resume_job();
    machine.finish();
    CHECK(machine.printer.runner.counts().moves == 4);
    CHECK(machine.position(Axis::x) == 60);
    CHECK(machine.position(Axis::y) == 50);
}

TEST_CASE("job: a file that vanishes pauses the job; back again, it goes on and every move is made") {
    std::string text;
    for (int i = 0; i < 5000; ++i) {
        text += i % 2 == 0 ? "G1 X20 Y20 F6000\n" : "G1 X10 Y10\n";
    }
    for (const bool out : {false, true}) {
        CAPTURE(out);
        Machine machine(text);
        machine.run_until(10);
        out ? machine.printer.remove_card(0) : machine.disk.set_failing(true);
        machine.run_until(400);
        CHECK(machine.printer.job.status() == JobStatus::paused);
        CHECK(machine.count(event("job.file_lost")) == 1);
        CHECK(machine.printer.start_or_resume_job());
        machine.run_until(500);
        CHECK(machine.printer.job.status() == JobStatus::paused);
        CHECK(machine.count(event("job.file_lost")) == 2);
        machine.printer.insert_card(0);
        machine.disk.set_failing(false);
        CHECK(machine.printer.start_or_resume_job());
        machine.finish();
        CHECK(machine.printer.runner.counts().moves == 5000);
    }
}

TEST_CASE("job: M0, M1 and M600 wait for the user") {
    for (const std::string code : {"M0", "M1", "M600"}) {
        CAPTURE(code);
        Machine machine("G1 X20 Y20 F6000\n" + code + "\nG1 X30\n");
        machine.run_until(60);
        CHECK(machine.printer.job.status() == JobStatus::paused);
        CHECK(machine.printer.job.waits_for_user);
        CHECK(machine.count(event("job.waits_for_user")) == 1);
        CHECK(machine.position(Axis::y) == (code == "M600" ? 300 : 20));
        CHECK(machine.printer.start_or_resume_job());
        CHECK_FALSE(machine.printer.job.waits_for_user);
        machine.finish();
        CHECK(machine.position(Axis::x) == 30);
        CHECK(machine.position(Axis::y) == 20);
    }
}

TEST_CASE("job: M26 begins, and goes on, in the middle of the file") {
    Machine machine("G1 X10 F6000\nG1 X20\nG1 X30\n");
    machine.printer.stop_job();
    machine.printer.select_file("x.gcode");
    machine.printer.seek_job(20);  // the beginning of the third line
    machine.printer.start_or_resume_job();
    machine.finish();
    CHECK(machine.printer.runner.counts().moves == 1);
    CHECK(machine.position(Axis::x) == 30);
}

TEST_CASE("job: another file cannot be selected while one is under way") {
    Machine machine("G1 X300 F600\n");
    machine.disk.put("y.gcode", "G1 X1\n");
    machine.run_until(1);
    machine.printer.select_file("y.gcode");
    machine.take_events();
    CHECK(machine.count(event("job.refused")) == 1);
    CHECK(machine.printer.job.path() == "x.gcode");
    CHECK(machine.printer.job.status() == JobStatus::printing);
}

TEST_CASE("job: any way of calling advance() gives the same print") {
    SlicedFile wishes;
    wishes.moves = 300;
    wishes.layers = 3;
    const std::string text = make_sliced_file(wishes) + "G4 P33\nG2 X20 I5\n";
    Machine by_event(text);
    const double seconds = by_event.finish();
    Machine by_step(text);
    Machine at_once(text);
    for (SimTime now{0}; by_step.printer.job.status() == JobStatus::printing; now += SimTime{12'345}) {
        by_step.printer.advance(now);
        by_step.take_events();
    }
    at_once.printer.advance(from_seconds(seconds + 1));
    CHECK(to_seconds(by_step.printer.job.elapsed(by_step.printer.now())) == seconds);
    CHECK(to_seconds(at_once.printer.job.elapsed(at_once.printer.now())) == seconds);
    CHECK(by_step.position(Axis::x) == by_event.position(Axis::x));
    CHECK(at_once.position(Axis::y) == by_event.position(Axis::y));
}
