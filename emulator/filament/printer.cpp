#include "emulator/filament/printer.h"

#include <algorithm>
#include <utility>

#include "emulator/filament/event_rows.h"

namespace fauxboard::filament {

Printer::Printer(std::shared_ptr<const Config> shared, const machine::Services& services, std::uint64_t seed)
    : Machine(kind_row(), std::move(shared), services, seed, host),
      thermal(config().thermal, seed),
      motion(config().motion, settings, seed),
      moves(config().motion, leveling, motion, events, loop),
      feeder(config().filament),
      wait(config().heating),
      gcode{motion, moves, thermal,  wait, mixer, fans, settings,        modal,    job,
            events, *this, commands, host, guard, told, config().motion, autotuned},
      runner(gcode, storage, config().job),
      host(gcode, transfer, config().host),
      recovery(gcode, storage, runner, config().job) {
    recovery.load(services.job_place);
}

void Printer::power_on_parts(SimTime now) {
    thermal.power_on(now);
    settings = Settings{};
    motion.power_on();
    feeder.power_on();
    wait.power_on();
    mixer.power_on();
    addons = AddOns{};
    fans = Fans{};
    leveling = Leveling{};
    leveling.manual_z_mm = config().manual_level_start_mm;
    filament.detector = Filament{}.detector;  // whether filament is in it is physical and stays
    runner.power_on();
    reports.power_on();
    guard = {config().extrusion.guarded, false, config().filament.min_extrude_c,
             config().extrusion.longest_mm};
    told = {};
    modal = {};
    recovery.power_on();
    screen = ScreenSide{};
    steppers = Steppers{};
    tuning = false;
    motors_rest_ = never;
    fan_order_.reset();
    power_on_ = now;
    if (config().job.cut_off_is_paused) {
        recovery.stand_paused();
    }
}

void Printer::run_parts(SimTime now) {
    raise_alarms();
    const bool was_moving = motion.busy();
    moves.advance(now);
    feeder.advance(now, events);
    wait.advance(now, thermal, events);
    runner.advance(now);
    host.advance(now);
    reports.advance(now, events);
    recovery.advance(now);
    motion.start_stream(now);
    if (events.empty()) {  // what has just happened may end the job: an axis that was not found, say
        recovery.keep(now);
    }
    follow_filament();
    if (was_moving) {
        emit_after_motion();
    }
    rest_motors(now);
}

SimTime Printer::next_of_parts() const {
    return machine::earliest(motion.next_event(), feeder.next_event(), wait.next_event(), next_of_job(),
                             host.next_event(now()), recovery.next_event(now()), thermal.next_alarm_check(),
                             reports.next_event(), motors_rest_);
}

SimTime Printer::next_of_job() const {
    // Asked several times for each request; most boards print nothing.
    return job.status() == JobStatus::printing || runner.shows_finished() ? runner.next_event(now()) : never;
}

bool Printer::restless_parts() const {
    return motion.busy() || feeder.mode() != Feeder::Mode::idle || wait.active() || !thermal.settled();
}

void Printer::hang_parts(bool powered) {
    motion.abort();
    feeder.power_on();
    thermal.freeze(powered);
}

void Printer::emit_after_motion() {
    if (job.pausing() && !motion.busy()) {
        job.pause(now());
        events.raise(event("job.paused"));
    }
}

void Printer::seek_job(double byte) {
    job.set_byte(byte);
    if (job.active()) {
        runner.seek();
        recovery.seek();
    }
}

void Printer::job_pauses(bool park) {
    if (config().job.pause_at_once && park) {
        pause_now();
    } else {
        runner.pause();
    }
    if (park) {
        run("park");
    }
    emit_after_motion();
}

void Printer::job_stops() {
    recovery.abort();
    recovery.drop();
    motion.abort();
    thermal.set_target(HeaterId::nozzle, 0);
    thermal.set_target(HeaterId::bed, 0);
}

/// What is planned is thrown away: the file goes on where the move under way began.
void Printer::pause_now() {
    recovery.keep(now());
    const std::uint64_t byte = runner.executed_byte();
    motion.abort();
    runner.pause();
    runner.drop_line();
    job.set_byte(static_cast<double>(byte));
    job.pause(now());
    events.raise(event("job.paused"));
}

bool Printer::resume_job() {
    return config().job.resume_homes_first ? recovery.begin() : Machine::resume_job();
}

void Printer::job_gives_way() {
    recovery.abort();
    recovery.drop();
}

void Printer::job_ends() {
    config().ends_idle ? runner.stop() : runner.finished(now());
    recovery.drop();
}

void Printer::end_job() {
    if (job.active()) {
        job.end(now());
    }
    runner.stop();
    recovery.abort();
    recovery.drop();
    motion.abort();
    wait.cancel(events);
    events.raise(event("job.ended"));
}

void Printer::all_off(bool had_job) {
    if (had_job) {
        recovery.abort();
        recovery.drop();
    }
    runner.stop();
    feeder.power_on();
    wait.cancel(events);
    thermal.set_target(HeaterId::nozzle, 0);
    thermal.set_target(HeaterId::bed, 0);
    motors_off();
}

}  // namespace fauxboard::filament
