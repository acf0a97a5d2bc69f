#include "emulator/resin/printer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "emulator/resin/event_rows.h"
#include "emulator/resin/names.h"

namespace fauxboard::resin {
namespace {

using Setting = ResinSetting;

std::string_view last_part(std::string_view path) {
    return path.substr(path.rfind('/') + 1);
}

}  // namespace

std::string_view to_string(Printer::Outcome outcome) {
    constexpr std::array<std::string_view, 10> names{"opened",  "no_name",     "no_stick", "missing",
                                                     "busy",    "unprintable", "written",  "not_written",
                                                     "removed", "not_removed"};
    return names[static_cast<std::size_t>(outcome)];
}

Printer::Printer(std::shared_ptr<const Config> shared, const machine::Services& services, std::uint64_t seed)
    : Machine(kind_row(), std::move(shared), services, seed, host),
      axis(config().resin, used),
      print(config().resin, axis, used, job, storage, events, *this) {}

void Printer::power_on_parts(SimTime now) {
    axis.abort(now);
    axis.power_on();
    print.power_on();
    commands.stop();
    edited = used = ResinSettings{};
    outcome = Outcome::opened;
    asked.clear();
    file.clear();
    file_bytes = 0;
    replaced = false;
    fan.reset();
    wifi_password.clear();
    network_name.clear();
    reboot_due_ = never;
}

SimTime Printer::next_of_parts() const {
    return std::min({axis.next_event(), print.next_event(), commands.next_event(), stick_due_, reboot_due_});
}

bool Printer::restless_parts() const {
    return axis.busy() || print.phase() != ResinJob::Phase::idle;
}

void Printer::run_parts(SimTime now) {
    axis.advance(now, events);
    print.advance(now);
    commands.advance(now);
    if (stick_due_ <= now) {
        stick_due_ = never;
        put_in(0);
    }
    if (reboot_due_ <= now) {
        reboot_due_ = never;
        events.raise(event("board.reboot_due"));
    }
}

void Printer::insert_card(int disk) {
    if (disk == 0) {
        stick_due_ = now() + from_seconds(config().resin.stick_visible_s);
    } else {
        Machine::insert_card(disk);
    }
}

void Printer::remove_card(int disk) {
    if (disk == 0) {
        stick_due_ = never;
        commands.stop();
    }
    Machine::remove_card(disk);
}

/// The name without what may stand around it; it is the one asked for, unless it is empty.
std::string_view Printer::take_name(std::string_view name) {
    const std::string_view bare = machine::bare_name(name);
    const std::string_view plain = bare.substr(std::min(bare.find_first_not_of('/'), bare.size()));
    if (plain.empty()) {
        outcome = Outcome::no_name;
    } else {
        asked = plain;
    }
    return plain;
}

bool Printer::in_print(const Storage::Found& found) const {
    return job.active() && found.path == job.path();
}

void Printer::remove(std::string_view name) {
    const std::string_view plain = take_name(name);
    if (plain.empty()) {
        return;
    }
    const bool may = storage.usable(0) && !in_print(storage.find(plain));
    outcome = may && storage.remove(plain) ? Outcome::removed : Outcome::not_removed;
}

void Printer::write(std::string_view name, std::string_view bytes) {
    const std::string_view plain = take_name(name);
    if (plain.empty()) {
        return;
    }
    if (!storage.usable(0)) {
        outcome = Outcome::no_stick;
        return;
    }
    const Storage::Found found = storage.find(plain);
    replaced = found.kind == Volume::Kind::file;
    const bool done = !in_print(found) && storage.write(replaced ? found.path : plain, bytes);
    outcome = done ? Outcome::written : Outcome::not_written;
}

void Printer::choose(std::string_view name) {
    const std::string_view plain = take_name(name);
    if (plain.empty()) {
        return;
    }
    if (job.active() && !refusing && print.exposed_all()) {
        print.cut_end(now());  // a host that has seen the last layer exposed prints its next file
    }
    if (job.active() || refusing || commands.running()) {
        outcome = Outcome::busy;
        events.raise(event("job.refused"));
        return;
    }
    if (!storage.usable(0)) {
        outcome = Outcome::no_stick;
        events.raise(event("file.missing"));
        return;
    }
    Storage::Found found = storage.find(plain);
    const std::string& before = job.path();
    if (found.kind == Volume::Kind::missing && last_part(before) == last_part(plain)) {
        found = storage.find(before);  // M23 named it with its folder
    }
    if (found.kind != Volume::Kind::file || found.bytes == 0) {
        outcome = Outcome::missing;
        events.raise(found.kind == Volume::Kind::missing ? event("file.missing") : event("file.unreadable"));
        return;
    }
    outcome = Outcome::opened;
    file = found.path.find('/') == std::string::npos ? std::string(plain) : "/" + found.path;
    file_bytes = found.bytes;
    job.select(0, std::move(found.path), found.bytes);
    events.raise(event("file.selected"));
}

bool Printer::start() {
    const bool paused = job.status() == JobStatus::paused;
    if (!paused && (job.active() || commands.running())) {
        outcome = Outcome::busy;
        return false;
    }
    const Volume* const stick = std::as_const(storage).volume(job.volume());
    if (!paused && stick != nullptr && job.selected() && ResinCommands::fits(job.path())) {
        outcome = Outcome::opened;
        commands.begin(*stick, job.path(), now());
        return true;
    }
    if (!paused && !print.open()) {
        outcome = !job.selected() ? Outcome::no_name : Outcome::unprintable;
        return false;
    }
    outcome = Outcome::opened;
    return start_or_resume_job();
}

void Printer::job_pauses(bool /*park*/) {
    const ResinConfig& own = config().resin;
    const double least = std::min(own.pause_from_s, own.pause_to_s);
    const double most = std::max(own.pause_from_s, own.pause_to_s);
    print.pause(now() + from_seconds(least + (most - least) * random()));
}

/// The rules that fans and LED follow alike.
bool Printer::on_by(double rule) const {
    return rule == -1 || (rule == 1 && led()) || (rule == -2 && job.active());
}

bool Printer::led() const {
    const double rule = used[Setting::led];
    return rule == 1 || (rule == 2 && job.active()) || (rule == 4 && print.exposing());
}

int Printer::led_fan() const {
    constexpr int full = 256;
    return fan ? *fan : on_by(used[Setting::led_fan]) ? full : 0;
}

int Printer::board_fan() const {
    constexpr int full = 256;
    return on_by(used[Setting::board_fan]) ? full : 0;
}

}  // namespace fauxboard::resin
