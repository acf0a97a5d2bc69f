#include "emulator/resin/resin.h"

#include <algorithm>
#include <array>

#include "emulator/machine/printer.h"

namespace fauxboard::machine {
namespace {

using Setting = ResinSetting;

std::string_view last_part(std::string_view path) {
    return path.substr(path.rfind('/') + 1);
}

bool quote(char c) {
    return c == '\'' || c == '"';
}

}  // namespace

std::string_view to_string(Resin::Outcome outcome) {
    constexpr std::array<std::string_view, 10> names{"opened",  "no_name",     "no_stick", "missing",
                                                     "busy",    "unprintable", "written",  "not_written",
                                                     "removed", "not_removed"};
    return names[static_cast<std::size_t>(outcome)];
}

std::string_view bare_name(std::string_view name) {
    const auto strip = [&](auto&& unwanted) {
        while (!name.empty() && unwanted(name.front())) {
            name.remove_prefix(1);
        }
    };
    strip([](char c) { return c == ' ' || c == ':'; });
    if (!name.empty() && quote(name.front())) {
        const char mark = name.front();
        name.remove_prefix(1);
        name = name.substr(0, name.rfind(mark));  // the last one: a name may hold one
    }
    strip([](char c) { return c == ':'; });
    while (name.ends_with(' ')) {
        name.remove_suffix(1);
    }
    return name;
}

Resin::Resin(Printer& printer)
    : axis(*printer.config().resin, used),
      job(printer, axis, used),
      printer_(printer),
      config_(*printer.config().resin) {}

void Resin::power_on(SimTime now) {
    axis.abort(now);
    axis.power_on();
    job.power_on();
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

SimTime Resin::next_event() const {
    return std::min({axis.next_event(), job.next_event(), stick_due_, reboot_due_});
}

bool Resin::restless() const {
    return axis.busy() || job.phase() != ResinJob::Phase::idle;
}

void Resin::advance(SimTime now) {
    axis.advance(now, printer_.events);
    job.advance(now);
    if (stick_due_ <= now) {
        stick_due_ = never;
        printer_.mount_stick();
    }
    if (reboot_due_ <= now) {
        reboot_due_ = never;
        printer_.events.raise(EventId::board_reboot_due);
    }
}

/// The name without what may stand around it; it is the one asked for, unless it is empty.
std::string_view Resin::take_name(std::string_view name) {
    const std::string_view bare = bare_name(name);
    const std::string_view plain = bare.substr(std::min(bare.find_first_not_of('/'), bare.size()));
    if (plain.empty()) {
        outcome = Outcome::no_name;
    } else {
        asked = plain;
    }
    return plain;
}

bool Resin::in_print(const Storage::Found& found) const {
    return printer_.job.active() && found.path == printer_.job.path();
}

void Resin::remove(std::string_view name) {
    const std::string_view plain = take_name(name);
    if (plain.empty()) {
        return;
    }
    const bool may = printer_.storage.usable(0) && !in_print(printer_.storage.find(plain));
    outcome = may && printer_.storage.remove(plain) ? Outcome::removed : Outcome::not_removed;
}

void Resin::write(std::string_view name, std::string_view bytes) {
    const std::string_view plain = take_name(name);
    if (plain.empty()) {
        return;
    }
    if (!printer_.storage.usable(0)) {
        outcome = Outcome::no_stick;
        return;
    }
    const Storage::Found found = printer_.storage.find(plain);
    replaced = found.kind == Volume::Kind::file;
    const bool done = !in_print(found) && printer_.storage.write(replaced ? found.path : plain, bytes);
    outcome = done ? Outcome::written : Outcome::not_written;
}

void Resin::choose(std::string_view name) {
    const std::string_view plain = take_name(name);
    if (plain.empty()) {
        return;
    }
    if (printer_.job.active() || printer_.refusing) {
        outcome = Outcome::busy;
        printer_.events.raise(EventId::job_refused);
        return;
    }
    if (!printer_.storage.usable(0)) {
        outcome = Outcome::no_stick;
        printer_.events.raise(EventId::file_missing);
        return;
    }
    Storage::Found found = printer_.storage.find(plain);
    const std::string& before = printer_.job.path();
    if (found.kind == Volume::Kind::missing && last_part(before) == last_part(plain)) {
        found = printer_.storage.find(before);  // M23 named it with its folder
    }
    if (found.kind != Volume::Kind::file || found.bytes == 0) {
        outcome = Outcome::missing;
        printer_.events.raise(found.kind == Volume::Kind::missing ? EventId::file_missing
                                                                  : EventId::file_unreadable);
        return;
    }
    outcome = Outcome::opened;
    file = found.path.find('/') == std::string::npos ? std::string(plain) : "/" + found.path;
    file_bytes = found.bytes;
    printer_.job.select(0, std::move(found.path), found.bytes);
    printer_.events.raise(EventId::file_selected);
}

bool Resin::start() {
    const bool paused = printer_.job.status() == JobStatus::paused;
    if (!paused && printer_.job.active()) {
        outcome = Outcome::busy;
        return false;
    }
    if (!paused && !job.open()) {
        outcome = !printer_.job.selected() ? Outcome::no_name : Outcome::unprintable;
        return false;
    }
    outcome = Outcome::opened;
    return printer_.start_or_resume_job();
}

void Resin::pause(SimTime now) {
    const double least = std::min(config_.pause_from_s, config_.pause_to_s);
    const double most = std::max(config_.pause_from_s, config_.pause_to_s);
    job.pause(now + from_seconds(least + (most - least) * printer_.random()));
}

void Resin::put_stick_in(SimTime now) {
    stick_due_ = now + from_seconds(config_.stick_visible_s);
}

/// The rules that fans and LED follow alike.
bool Resin::on_by(double rule) const {
    return rule == -1 || (rule == 1 && led()) || (rule == -2 && printer_.job.active());
}

bool Resin::led() const {
    const double rule = used[Setting::led];
    return rule == 1 || (rule == 2 && printer_.job.active()) || (rule == 4 && job.exposing());
}

int Resin::led_fan() const {
    constexpr int full = 256;
    return fan ? *fan : on_by(used[Setting::led_fan]) ? full : 0;
}

int Resin::board_fan() const {
    constexpr int full = 256;
    return on_by(used[Setting::board_fan]) ? full : 0;
}

}  // namespace fauxboard::machine
