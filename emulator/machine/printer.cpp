#include "emulator/machine/printer.h"

#include <algorithm>
#include <utility>

namespace fauxboard::machine {
namespace {

/// After power-on the board looks for the card in its main loop, not before: the recorded boot without a card
/// tells of it between the first real temperatures (0.85 s) and the first L21 (1.75 s).
constexpr SimTime card_check_delay{1'200'000};

}  // namespace

Printer::Printer(std::shared_ptr<const MachineConfig> config, Services services, std::uint64_t seed)
    : thermal(config->thermal, seed),
      motion(config->motion, settings),
      feeder(config->filament),
      runner(*this),
      host(*this),
      recovery(*this),
      config_(std::move(config)),
      services_(services),
      random_state_(seed ^ 0x9E3779B97F4A7C15ULL) {
    if (services_.sd == nullptr && config_->card.present) {
        built_in_.emplace(config_->card.entries);
    }
    recovery.load(services_.job_place);
    storage.configure(config_->card.way_back, config_->card.ignore_case);
    if (config_->resin) {
        resin = std::make_unique<Resin>(*this);
    }
    put_in(0);
    if (config_->udisk_port) {
        put_in(1);
    }
    events.clear();
}

void Printer::power_on(SimTime now) {
    now_ = now;
    thermal.power_on(now);
    settings = Settings{};
    motion.power_on();
    feeder.power_on();
    wait.power_on();
    mixer.power_on();
    addons = AddOns{};
    fans = Fans{};
    leveling = Leveling{};
    leveling.manual_z_mm = config_->manual_level_start_mm;
    filament.detector = Filament{}.detector;  // whether filament is in it is physical and stays
    storage.choose(0);
    transfer.power_on();
    job.power_on();
    runner.power_on();
    modal = {};
    host.power_on();
    recovery.power_on();
    screen = ScreenSide{};
    wifi = Wifi{};
    steppers = Steppers{};
    events.clear();
    refusing = tuning = hung_ = reset_ = false;
    host_heard_.reset();
    stall_ = SimTime{0};
    card_check_ = storage.usable(0) ? never : now + card_check_delay;
    if (resin) {
        resin->power_on(now);
    }
}

void Printer::advance(SimTime now) {
    // Events must come in their order, so time moves from one to the next.
    for (SimTime next = next_event(); next <= now; next = next_event()) {
        now_ = next;
        thermal.advance(next);
        breakdowns.advance(next);
        if (hung_) {
            continue;
        }
        raise_alarms();
        const bool was_moving = motion.busy();
        motion.faults().probe_alarm = leveling.probe_alarm;
        motion.advance(next, events);
        feeder.advance(next, events);
        wait.advance(next, thermal, events);
        if (card_check_ <= next) {
            card_check_ = never;
            events.raise(EventId::card_missing);
        }
        resin ? resin->advance(next) : runner.advance(next);
        host.advance(next);
        recovery.advance(next);
        motion.start_stream(next);
        recovery.keep();
        follow_filament();
        if (was_moving) {
            emit_after_motion();
        }
    }
    thermal.advance(now);
    now_ = now;
    breakdowns.advance(now);  // what somebody has seen to is over
}

SimTime Printer::next_event() const {
    if (hung_) {
        return breakdowns.next_event();
    }
    return std::min({motion.next_event(), feeder.next_event(), wait.next_event(), next_of_job(),
                     host.next_event(), recovery.next_event(), card_check_, thermal.next_alarm_check(),
                     breakdowns.next_event()});
}

SimTime Printer::next_of_job() const {
    if (resin) {
        return resin->next_event();
    }
    // Asked several times for each request; most boards print nothing.
    return job.status() == JobStatus::printing || runner.shows_finished() ? runner.next_event() : never;
}

bool Printer::restless() const {
    return !hung_ &&
           (motion.busy() || feeder.mode() != Feeder::Mode::idle || wait.active() || !thermal.settled() ||
            job.status() == JobStatus::printing || (resin && resin->restless()));
}

void Printer::emit_after_motion() {
    if (job.pausing() && !motion.busy()) {
        job.pause(now_);
        events.raise(EventId::job_paused);
    }
}

bool Printer::home(unsigned mask) {
    if (mask == 0 || mask == static_cast<unsigned>(HomeAxes::all)) {
        return run("home");
    }
    constexpr std::array<std::string_view, 3> names{"home_x", "home_y", "home_z"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if ((mask & (1U << i)) != 0 && !run(names[i])) {
            return false;
        }
    }
    return true;
}

bool Printer::run(std::string_view procedure) {
    const auto& known = config_->motion.procedures;
    const auto hit = known.find(procedure);
    motion.faults().probe_alarm = leveling.probe_alarm;
    return hit != known.end() && motion.run(hit->second, now_, events);
}

void Printer::motors_off() {
    motion.set_motors(false);
}

void Printer::feed(Feeder::Mode mode) {
    if (too_cold_to_extrude()) {
        events.raise(EventId::filament_too_cold);
        return;
    }
    motion.set_motors(true);
    motion.show_feed(config_->filament.feed_mm_s);
    feeder.start(mode, now_);
}

void Printer::feed_once() {
    if (too_cold_to_extrude()) {
        events.raise(EventId::filament_too_cold);
        return;
    }
    motion.set_motors(true);
    motion.show_feed(config_->filament.feed_mm_s);
    feeder.feed_once(now_);
}

void Printer::set_filament(bool present) {
    if (filament.present == present) {
        return;
    }
    filament.present = present;
    events.raise(present ? EventId::filament_inserted : EventId::filament_removed);
    if (!present && filament.detector && job.status() == JobStatus::printing) {
        events.raise(EventId::filament_out);
    }
}

void Printer::insert_card(int disk) {
    if (disk == 1 && !config_->udisk_port) {
        return;
    }
    if (disk == 0 && resin) {
        resin->put_stick_in(now_);
        return;
    }
    put_in(disk);
}

void Printer::mount_stick() {
    put_in(0);
}

void Printer::put_in(int disk) {
    Volume* volume = disk == 1 ? services_.udisk : services_.sd;
    if (volume == nullptr && disk == 0 && built_in_) {
        volume = &*built_in_;
    }
    const bool was_there = storage.usable(disk);
    storage.attach(disk, volume);
    if (storage.usable(disk) && !was_there) {
        events.raise(EventId::card_inserted);
    }
}

void Printer::remove_card(int disk) {
    const bool was_there = storage.usable(disk);
    if (disk == 0 && resin) {
        resin->take_stick_out();
    }
    storage.attach(disk, nullptr);
    if (was_there) {
        events.raise(EventId::card_removed);
    }
}

void Printer::fail_card(int disk) {
    const bool was_there = storage.usable(disk);
    if (storage.state(disk) != DiskState::removed) {
        storage.set_state(disk, DiskState::failed);
    }
    if (was_there) {
        events.raise(EventId::card_failed);
    }
}

void Printer::select_file(std::string_view name) {
    if (job.active() || refusing) {
        events.raise(EventId::job_refused);
        return;
    }
    Storage::Found found = storage.find(name);
    switch (found.kind) {
        case Volume::Kind::file:
            runner.stop();
            job.select(storage.chosen(), std::move(found.path), found.bytes);
            events.raise(EventId::file_selected);
            break;
        case Volume::Kind::folder:
        case Volume::Kind::unreadable:
            events.raise(EventId::file_unreadable);
            break;
        case Volume::Kind::missing:
            events.raise(EventId::file_missing);
            break;
    }
}

bool Printer::resume_job() {
    if (!job.resume(now_)) {
        return false;
    }
    resin ? resin->job.resume(now_) : runner.resume(now_);
    events.raise(EventId::job_resumed);
    return true;
}

bool Printer::start_or_resume_job() {
    if (resume_job()) {
        return true;
    }
    if (refusing && job.selected() && !job.active()) {
        events.raise(EventId::job_refused);
        return true;
    }
    if (resin && !resin->job.open()) {
        return false;
    }
    if (job.start(now_)) {
        resin ? resin->job.start(now_) : runner.start(now_);
        events.raise(EventId::job_started);
        return true;
    }
    return false;
}

void Printer::seek_job(double byte) {
    if (resin) {
        return;  // its place is a layer's end, and nothing between
    }
    job.set_byte(byte);
    if (job.active()) {
        runner.seek();
    }
}

void Printer::pause_job(bool park) {
    if (job.pausing()) {
        events.raise(EventId::job_pausing);
        return;
    }
    if (!job.begin_pause()) {
        return;
    }
    if (resin) {
        resin->pause(now_);
        return;
    }
    runner.pause();
    if (park) {
        run("park");
    }
    emit_after_motion();
}

bool Printer::stop_job() {
    if (!job.stop()) {
        return false;
    }
    runner.stop();
    recovery.abort();
    recovery.drop();
    if (resin) {
        resin->job.stop(now_);
    }
    motion.abort();
    thermal.set_target(HeaterId::nozzle, 0);
    thermal.set_target(HeaterId::bed, 0);
    events.raise(EventId::job_stopped);
    return true;
}

bool Printer::finish_job() {
    if (!job.finish(now_)) {
        return false;
    }
    if (resin) {
        resin->job.stop(now_);
        events.raise(EventId::job_finished);
        return close_job();  // such a board shows no finished print: it is idle at once
    }
    runner.finished(now_);
    recovery.drop();
    events.raise(EventId::job_finished);
    return true;
}

void Printer::continue_recovered_job() {
    job.go_on(now_);
    runner.start(now_);
    events.raise(EventId::job_started);
}

bool Printer::close_job() {
    if (!job.close()) {
        return false;
    }
    runner.stop();
    events.raise(EventId::job_closed);
    return true;
}

void Printer::emergency_stop() {
    if (job.stop()) {
        recovery.abort();
        recovery.drop();
    }
    runner.stop();
    if (resin) {
        resin->job.halt(now_);
    }
    feeder.power_on();
    wait.cancel(events);
    thermal.set_target(HeaterId::nozzle, 0);
    thermal.set_target(HeaterId::bed, 0);
    motors_off();
}

int Printer::disk_code() const {
    const int sd = static_cast<int>(storage.state(0));
    return config_->udisk_port ? sd + 16 * static_cast<int>(storage.state(1)) : sd;
}

const std::vector<CardEntry>& Printer::listing() {
    const Volume* const fixed = storage.fixed_volume();
    if (fixed == nullptr || fixed != listed_ || storage.folder() != listed_folder_) {
        storage.listing(listing_, config_->card.max_listed);
        listed_ = fixed;
        listed_folder_ = storage.folder();
    }
    return listing_;
}

SimTime Printer::take_stall() {
    const SimTime time = stall_;
    stall_ = SimTime{0};
    return time;
}

double Printer::random() {
    // splitmix64
    std::uint64_t z = random_state_ += 0x9E3779B97F4A7C15ULL;
    z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ z >> 27U) * 0x94D049BB133111EBULL;
    return static_cast<double>((z ^ z >> 31U) >> 11U) * 0x1.0p-53;
}

}  // namespace fauxboard::machine
