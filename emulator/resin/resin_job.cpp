#include "emulator/resin/resin_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "emulator/machine/disk_source.h"
#include "emulator/resin/event_rows.h"
#include "emulator/resin/names.h"
#include "emulator/resin/printer.h"

namespace fauxboard::resin {
namespace {

using Setting = ResinSetting;

/// A picture is read and unpacked while the resin rests. It also keeps a file whose layers take no time from
/// being printed in none.
constexpr SimTime picture_time{10'000};
/// Records bring any number; no layer takes longer than a day.
constexpr double longest_s = 86400;

SimTime time_of(double seconds) {
    return from_seconds(std::isfinite(seconds) ? std::clamp(seconds, 0.0, longest_s) : 0);
}

}  // namespace

std::string_view to_string(ResinJob::Phase phase) {
    constexpr std::array<std::string_view, 10> names{"idle",      "homing",   "reading", "approaching",
                                                     "resting",   "exposing", "lifting", "waiting",
                                                     "finishing", "held"};
    return names[static_cast<std::size_t>(phase)];
}

void ResinJob::power_on() {
    phase_ = held_ = Phase::idle;
    file_.reset();
    pause_due_ = never;
    exposure_left_ = SimTime{0};
    stopped_ = false;
    layer_ = {};
}

bool ResinJob::open() {
    const Volume* volume = storage_.volume(job_.volume());
    if (volume == nullptr || !job_.selected()) {
        return false;
    }
    auto opened = sliced::SlicedFile::open(machine::DiskSource(*volume, job_.path()));
    if (!opened) {
        return false;
    }
    file_ = std::move(*opened);
    return true;
}

std::optional<ResinJob::Place> ResinJob::place() const {
    const Volume* volume = storage_.volume(job_.volume());
    if (!file_ || volume == nullptr || !job_.active()) {
        return std::nullopt;
    }
    return Place{*file_, *volume, job_.path(), index_};
}

void ResinJob::start(SimTime now) {
    axis_.abort(now);
    pause_due_ = never;
    stopped_ = false;
    index_ = 0;
    layer_ = {};
    dark_since_ = now;
    job_.layers = static_cast<int>(file_->header().layers);
    job_.estimate_s = file_->header().print_time_s;
    phase_ = Phase::homing;
    axis_.home(now);
}

void ResinJob::stop(SimTime now) {
    pause_due_ = never;
    if (phase_ == Phase::idle || stopped_) {
        return;
    }
    stopped_ = true;
    axis_.abort(now);
    finish(now);
}

void ResinJob::halt(SimTime now) {
    axis_.motors_off(now);
    power_on();
}

bool ResinJob::exposed_all() const {
    const bool lifts = phase_ == Phase::lifting || phase_ == Phase::waiting;
    return phase_ == Phase::finishing || (lifts && index_ + 1 >= file_->header().layers);
}

void ResinJob::cut_end(SimTime now) {
    axis_.abort(now);
    finished(now);
}

bool ResinJob::moves() const {
    return phase_ == Phase::homing || phase_ == Phase::approaching || phase_ == Phase::lifting ||
           phase_ == Phase::finishing;
}

SimTime ResinJob::next_event() const {
    // A move's end is the axis's event.
    const bool timed = phase_ == Phase::resting || phase_ == Phase::exposing || phase_ == Phase::waiting;
    return std::min(pause_due_, timed ? until_ : never);
}

void ResinJob::advance(SimTime now) {
    while (step(now)) {
    }
}

bool ResinJob::step(SimTime now) {
    if (pause_due_ <= now) {
        hold(now);
        return true;
    }
    if (moves()) {
        if (axis_.busy()) {
            return false;
        }
        after_move(now);
        return true;
    }
    if (next_event() <= now) {
        after_time(now);
        return true;
    }
    return false;
}

void ResinJob::after_move(SimTime now) {
    switch (phase_) {
        case Phase::homing:
            begin_layer(now);
            break;
        case Phase::approaching:
            phase_ = Phase::resting;
            until_ = std::max(now + picture_time, dark_since_ + time_of(layer_.light_off_s));
            break;
        case Phase::lifting:
            phase_ = Phase::waiting;
            until_ = now + time_of(settings_[Setting::lift_wait] / 1000);
            break;
        default:
            finished(now);
            break;
    }
}

void ResinJob::after_time(SimTime now) {
    switch (phase_) {
        case Phase::resting:
            phase_ = Phase::exposing;
            until_ = now + exposure_left_;
            break;
        case Phase::exposing:
            end_exposure(now);
            break;
        default:
            ++index_;
            begin_layer(now);
            break;
    }
}

void ResinJob::begin_layer(SimTime now) {
    if (index_ >= file_->header().layers) {
        finish(now);
        return;
    }
    phase_ = Phase::reading;
    const Volume* volume = storage_.volume(job_.volume());
    if (volume == nullptr) {
        lose_file(event("job.file_lost"), now);
        return;
    }
    const machine::DiskSource source(*volume, job_.path());
    auto layer = file_->layer(source, index_);
    if (!layer) {
        lose_file(source.size() == 0 ? event("job.file_lost") : event("job.file_unreadable"), now);
        return;
    }
    layer_ = *layer;
    exposure_left_ = time_of(layer_.exposure_s);
    approach(now);
}

void ResinJob::approach(SimTime now) {
    const double own = layer_.lift ? layer_.lift->retract_mm_min : 0;
    phase_ = Phase::approaching;
    axis_.move(layer_.z_mm, false, own > 0 ? own : settings_[Setting::lift_fast_speed] * 60, now);
}

void ResinJob::end_exposure(SimTime now) {
    dark_since_ = now;
    exposure_left_ = SimTime{0};
    job_.set_byte(static_cast<double>(layer_.end()));
    job_.layer = static_cast<int>(index_ + 1);
    events_.raise(event("job.layer_done"));
    lift(now);
}

void ResinJob::lift(SimTime now) {
    phase_ = Phase::lifting;
    if (layer_.lift) {
        axis_.move(layer_.lift->mm, true, layer_.lift->mm_min, now);
        return;
    }
    const double slowly = std::min(settings_[Setting::lift_slow], settings_[Setting::lift]);
    axis_.move(slowly, true, settings_[Setting::lift_slow_speed] * 60, now);
    axis_.move(settings_[Setting::lift] - slowly, true, settings_[Setting::lift_fast_speed] * 60, now);
}

void ResinJob::finish(SimTime now) {
    phase_ = Phase::finishing;
    const double action = settings_[Setting::after_print];
    if (action == 2) {
        axis_.home(now);
    } else if (action == 3 && axis_.homed()) {
        axis_.move(settings_[Setting::max_height], false, settings_[Setting::lift_fast_speed] * 60, now);
    }
}

void ResinJob::finished(SimTime now) {
    phase_ = Phase::idle;
    pause_due_ = never;
    if (settings_[Setting::after_print] != 1) {
        axis_.motors_off(now);
    }
    if (!stopped_) {
        control_.finish_job();
    }
    stopped_ = false;
}

/// The pause shows: dark from here on. What an exposure still lacks is made up for later.
void ResinJob::hold(SimTime now) {
    pause_due_ = never;
    if (phase_ == Phase::idle || phase_ == Phase::held || stopped_) {
        return;
    }
    held_ = phase_;
    if (phase_ == Phase::exposing) {
        exposure_left_ = until_ - now;
        dark_since_ = now;
    }
    phase_ = Phase::held;
    axis_.abort(now);
    if (axis_.homed()) {
        axis_.move(config_.pause_lift_mm, true, settings_[Setting::lift_fast_speed] * 60, now);
    }
    job_.pause(now);
    events_.raise(event("job.paused"));
}

void ResinJob::lose_file(EventId why, SimTime now) {
    pause_due_ = never;
    held_ = Phase::reading;
    phase_ = Phase::held;
    job_.pause(now);
    events_.raise(why);
}

void ResinJob::resume(SimTime now) {
    if (phase_ != Phase::held) {
        return;
    }
    axis_.abort(now);
    switch (held_) {
        case Phase::homing:
            phase_ = Phase::homing;
            axis_.home(now);
            break;
        case Phase::approaching:
        case Phase::resting:
        case Phase::exposing:
            approach(now);
            break;
        case Phase::lifting:
        case Phase::waiting:
            ++index_;
            begin_layer(now);
            break;
        case Phase::finishing:
            finish(now);
            break;
        default:
            begin_layer(now);
            break;
    }
}

int ResinJob::light() const {
    if (!exposing()) {
        return 0;
    }
    const sliced::Header& header = file_->header();
    return std::min<int>(index_ < header.bottom_layers ? header.bottom_pwm : header.pwm, 255);
}

double ResinJob::exposure_left_s(SimTime now) const {
    return to_seconds(exposing() ? until_ - now : exposure_left_);
}

}  // namespace fauxboard::resin
