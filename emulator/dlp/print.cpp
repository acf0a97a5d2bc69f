#include "emulator/dlp/print.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/dlp/checked_source.h"
#include "emulator/dlp/line_reader.h"

namespace fauxboard::dlp {
namespace {

constexpr unsigned work_bank = 0;
constexpr unsigned clean_bank = 2;
constexpr SimTime fan_after_print = ms(10'000);

/// As the board counts: whole milliseconds, cut. Files bring any number.
SimTime cut_to_ms(double seconds) {
    constexpr double longest_s = 86'400;
    return ms(static_cast<std::int64_t>(std::clamp(seconds, 0.0, longest_s) * 1000 + 1e-6));
}

}  // namespace

std::string_view to_string(PrintState state) {
    constexpr std::array<std::string_view, 13> names{
        "idle",        "homing_preup",  "homing_fast", "homing_up", "homing_slow",
        "free_moving", "move_to_layer", "light_pause", "light",     "lift",
        "drop",        "pause_lift",    "last_lift"};
    return names[static_cast<std::size_t>(state)];
}

void Print::power_on() {
    const PrintParts parts = parts_;
    const double load_factor_before = load_factor;
    std::destroy_at(this);
    std::construct_at(this, parts);
    load_factor = load_factor_before;
}

float Print::percent() const {
    return layers_ == 0 ? 0 : static_cast<float>(layer_ + 1) / static_cast<float>(layers_) * 100;
}

SimTime Print::exposure() const {
    return cut_to_ms(plan_.exposure_s) / static_cast<std::int64_t>(antialiasing()) / ms(1) * ms(1);
}

void Print::count(bool on, SimTime now) {
    elapsed_ = elapsed(now);
    counted_from_ = now;
    counts_ = on;
}

std::optional<Print::Worked> Print::take_worked() {
    return std::exchange(worked_, std::nullopt);
}

std::optional<Print::Worked> Print::worked_so_far(SimTime now) {
    if (!file_ || state_ == PrintState::last_lift) {
        return std::nullopt;
    }
    return Worked{parts_.lamp.take_lit(now), now - std::exchange(counted_to_, now)};
}

bool Print::start(const std::string& path, SimTime now) {
    if (state_ != PrintState::idle) {
        problem_ = "The platform moves, or a print is under way.";
        return false;
    }
    const auto source = parts_.stick.open(path);
    auto file = source ? PrintFile::open(*source)
                       : sliced::Outcome<PrintFile>::failure("There is no such file, or it cannot be read.");
    if (!file) {
        problem_ = file.problem();
        parts_.listener.raise(Event::print_not_opened);
        return false;
    }
    file_ = std::move(*file);
    path_ = path;
    problem_.clear();
    plan_ = file_->common();
    layers_ = file_->layers();
    layer_ = sublayer_ = bad_layers_ = 0;
    estimate_s_ = file_->estimate_s(parts_.settings.motor, parts_.firmware);
    paused_ = cancelled_ = needs_picture_ = false;
    changes = {};
    for_print_ = true;
    started_ = counted_to_ = now;
    elapsed_ = SimTime{0};
    count(false, now);
    parts_.lamp.take_lit(now);
    parts_.listener.raise(Event::print_started);
    begin_homing(now);
    advance(now);
    return true;
}

SimTime Print::next_event() const {
    return std::min(load_due_, state_ == PrintState::light_pause ? until_ : never);
}

void Print::advance(SimTime now) {
    while (step(now)) {
    }
}

/// One thing that is due, if there is one.
bool Print::step(SimTime now) {
    if (load_due_ <= now) {
        end_load(now);
        return true;
    }
    const PrintState before = state_;
    const bool stands = !parts_.platform.busy();
    switch (state_) {
        case PrintState::idle:
            return false;
        case PrintState::light_pause:
            if (until_ <= now) lights_on(now);
            break;
        case PrintState::light:
            if (!parts_.lamp.counting() && load_due_ == never) {
                end_light(now);
                return true;
            }
            break;
        case PrintState::pause_lift:
            return stands && load_due_ == never && stand_paused(now);
        case PrintState::last_lift:
            if (stands) finished(now);
            break;
        case PrintState::free_moving:
            if (stands) enter(PrintState::idle);
            break;
        case PrintState::move_to_layer:
        case PrintState::lift:
        case PrintState::drop:
            if (stands && load_due_ == never) moved(now);
            break;
        default:
            if (stands) homing_step(now);
            break;
    }
    return state_ != before;
}

void Print::moved(SimTime now) {
    if (state_ == PrintState::lift) {
        enter(PrintState::drop);
        go_down(now);
        return;
    }
    enter(PrintState::light_pause);
    until_ = now + cut_to_ms(plan_.light_off_s);
}

void Print::begin_printing(SimTime now) {
    const MotorSettings& motor = parts_.settings.motor;
    parts_.lamp.fan_for(never, now);
    count(true, now);
    enter(PrintState::move_to_layer);
    if (!read_plan(0, plan_)) {
        lose_picture(problem_, now);
        return;
    }
    go(zero() + plan_.z_mm, static_cast<double>(motor.feedrate), static_cast<double>(motor.acceleration),
       now);
    begin_load(now);
    parts_.listener.raise(Event::print_layer_begun);
}

bool Print::read_plan(std::uint32_t n, LayerPlan& plan) {
    const auto source = parts_.stick.open(path_);
    const auto read = source ? file_->layer(*source, n)
                             : sliced::Outcome<LayerPlan>::failure("The stick is gone, or the file on it.");
    if (!read) {
        problem_ = read.problem();
        return false;
    }
    plan = *read;
    if (parts_.quirks.speed_times_60 && file_->file().header().format == sliced::Format::cbddlp) {
        plan.lift_mm_s *= 60;
        plan.drop_mm_s *= 60;
    }
    apply_changes(n, plan);
    return true;
}

void Print::apply_changes(std::uint32_t n, LayerPlan& plan) const {
    const bool bottom = n < file_->bottom_layers();
    const bool individual = changes.individual.value_or(file_->individual());
    const auto change = [](double& slot, const std::optional<double>& value) { slot = value.value_or(slot); };
    if (!individual && file_->individual()) {
        plan = {plan.z_mm,
                bottom ? file_->bottom_exposure_s() : file_->common().exposure_s,
                file_->common().light_off_s,
                file_->common().lift_mm,
                file_->common().lift_mm_s,
                file_->common().drop_mm_s};
    }
    if (individual) {
        return;
    }
    change(plan.exposure_s, bottom ? changes.bottom_light_s : changes.light_s);
    change(plan.light_off_s, changes.light_pause_s);
    change(plan.lift_mm, changes.lift_mm);
    change(plan.lift_mm_s, changes.lift_mm_s);
    change(plan.drop_mm_s, changes.drop_mm_s);
    const std::uint32_t steps = parts_.settings.general.decrease_steps;
    const std::uint32_t after = n - std::min(n, file_->bottom_layers());
    if (parts_.firmware == Firmware::v008 && !bottom && file_->bottom_layers() > 0 && after < steps) {
        const double most = changes.bottom_light_s.value_or(file_->bottom_exposure_s());
        plan.exposure_s += (most - plan.exposure_s) * (steps - after) / (steps + 1);
    }
}

void Print::begin_load(SimTime now) {
    parts_.panel.command(work_bank, false, false, now);
    load_begun_ = now;
    load_due_ = now + from_seconds(picture_load_s(parts_.firmware) * load_factor);
}

void Print::end_load(SimTime now) {
    load_due_ = never;
    const auto source = parts_.stick.open(path_);
    if (!source) {
        return lose_picture("The stick is gone, or the file on it.", now);
    }
    const CheckedSource checked(*source);
    const auto runs = file_->picture(checked, layer_, sublayer_);
    if (!runs) {
        return lose_picture(runs.problem(), now);
    }
    LineReader lines(std::move(*runs));
    parts_.panel.begin_picture(work_bank);
    PanelLine line{};
    Packet packet{};
    picture_sum_ = 0;
    for (unsigned n = 0; n < panel_lines; ++n) {
        lines.next(line);
        picture_sum_ = add_line(picture_sum_, line);
        std::copy(line.begin(), line.end(), packet.begin() + 2);
        // Who listens sees the lines spread over the time that they take.
        parts_.panel.send_line(packet, n, load_begun_ + (now - load_begun_) * n / panel_lines);
    }
    if (checked.failed()) {
        return lose_picture("The stick does not give the picture: " + lines.problem(), now);
    }
    if (!lines.problem().empty()) {
        parts_.listener.note("layer " + std::to_string(layer_ + 1) + ": " + lines.problem());
    }
    const unsigned bad = parts_.quirks.last_line_unchecked ? 0 : parts_.panel.end_picture(now);
    needs_picture_ = false;
    parts_.panel.command(work_bank, true, true, now);
    if (bad != 0) {
        note_bad_lines(bad, now);
    }
    parts_.listener.raise(Event::print_displayed);
    if (state_ == PrintState::light) {
        lights_on(now);
    }
}

void Print::note_bad_lines(unsigned lines, SimTime now) {
    ++bad_layers_;
    parts_.listener.note("layer " + std::to_string(layer_ + 1) + ": the panel never took " +
                         std::to_string(lines) + " of its lines");
    if (parts_.quirks.pause_on_bad_lines) {
        set_paused(true, now);
    }
}

/// The stick did not give what is needed: the print pauses in the dark, and a resume tries again.
void Print::lose_picture(const std::string& why, SimTime now) {
    problem_ = why;
    load_due_ = never;
    parts_.panel.command(work_bank, false, false, now);
    parts_.listener.raise(Event::print_read_error);
    parts_.listener.note("layer " + std::to_string(layer_ + 1) + ": " + why);
    if (parts_.quirks.ignore_read_errors) {
        if (state_ == PrintState::light) lights_on(now);
        return;
    }
    needs_picture_ = true;
    if (!paused_) {
        paused_ = true;
        parts_.listener.raise(Event::print_paused);
    }
    if (state_ != PrintState::pause_lift) {
        begin_pause_lift(now);
    }
}

void Print::lights_on(SimTime now) {
    enter(PrintState::light);
    const SimTime time = exposure();
    if (time > SimTime{0}) {
        parts_.lamp.light_for(time, now);
        parts_.listener.raise(Event::print_exposing);
    } else if (parts_.quirks.light_zero_stays_on) {
        parts_.lamp.light_on(now);
    }
}

void Print::end_light(SimTime now) {
    if (exposure() > SimTime{0}) {
        parts_.listener.raise(Event::print_exposed);
    }
    if (++sublayer_ < antialiasing()) {
        begin_load(now);
        return;
    }
    sublayer_ = 0;
    end_layer(now);
}

void Print::end_layer(SimTime now) {
    const double top = static_cast<double>(parts_.settings.motor.max_pos_mm);
    if (layer_ + 1 >= layers_) {
        return complete(now);
    }
    LayerPlan next = plan_;
    const bool known = read_plan(layer_ + 1, next);
    if (known && zero() + next.z_mm + next.lift_mm > top + 1e-6) {
        parts_.listener.note("the model is higher than the axis: it is cropped here");
        return complete(now);
    }
    ++layer_;
    plan_ = next;
    parts_.listener.raise(Event::print_layer_begun);
    enter(PrintState::lift);
    go_up(now);
    if (!known) {
        return lose_picture(problem_, now);
    }
    begin_load(now);
    if (paused_) {
        begin_pause_lift(now);
    }
}

void Print::begin_pause_lift(SimTime now) {
    count(false, now);
    enter(PrintState::pause_lift);
    rise_told_ = false;
    go_to_pause(now);
}

/// The platform has risen. True when something happened.
bool Print::stand_paused(SimTime now) {
    if (!paused_) {
        go_on(now);
        return true;
    }
    if (rise_told_) {
        return false;
    }
    rise_told_ = true;
    if (parts_.firmware == Firmware::v008) {
        parts_.lamp.fan_off_in(SimTime{0}, now);
    }
    parts_.listener.raise(Event::print_pause_reached);
    return true;
}

bool Print::set_paused(bool paused, SimTime now) {
    if (!file_ || state_ == PrintState::last_lift || paused == paused_) {
        return false;
    }
    paused_ = paused;
    parts_.listener.raise(paused ? Event::print_paused : Event::print_resumed);
    if (paused && state_ == PrintState::lift) {
        begin_pause_lift(now);
    }
    advance(now);
    return true;
}

void Print::go_on(SimTime now) {
    if (needs_picture_) {
        if (!read_plan(layer_, plan_)) {
            return lose_picture(problem_, now);
        }
        begin_load(now);
    }
    count(true, now);
    parts_.lamp.fan_for(never, now);
    enter(PrintState::drop);
    go_back_from_pause(now);
}

bool Print::stop(SimTime now) {
    if (!file_ || state_ == PrintState::last_lift) {
        return false;
    }
    const bool was_homing = homing();
    parts_.platform.stop(now);
    cancelled_ = true;
    complete(now);
    for_print_ = was_homing && parts_.quirks.stop_homing_keeps_print;
    advance(now);
    return true;
}

/// Over, at the end or before it: dark at once, then up.
void Print::complete(SimTime now) {
    load_due_ = never;
    parts_.lamp.off(now);
    parts_.panel.sleep(now);
    parts_.panel.command(clean_bank, false, false, now);
    parts_.lamp.fan_off_in(fan_after_print, now);
    worked_ = Worked{parts_.lamp.take_lit(now), now - counted_to_};
    count(false, now);
    enter(PrintState::last_lift);
    parts_.listener.raise(Event::print_finishing);
    if (homed_) {
        go_to_end(now);
    }
}

void Print::finished(SimTime now) {
    enter(PrintState::idle);
    file_.reset();
    paused_ = false;
    wall_end_ = now;
    parts_.listener.raise(cancelled_ ? Event::print_cancelled : Event::print_finished);
}

}  // namespace fauxboard::dlp
