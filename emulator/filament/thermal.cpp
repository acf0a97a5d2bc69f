#include "emulator/filament/thermal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/filament/names.h"
#include "emulator/filament/thermal_crosstalk.h"
#include "emulator/filament/thermal_fold.h"

namespace fauxboard::filament {

namespace {

constexpr double rest_within_k = 0.005;
constexpr double near_max_k = 50;
constexpr double reading_error_k = 2;  // quantised and folded, it is less than this from the truth
constexpr double longest_look_s = 600;
// A change of exactly 1.0 counts, also where it is made of two sevenths of a degree.
constexpr double report_change_c = 1.0 - 1e-9;

}  // namespace

Thermal::Thermal(const ThermalConfig& config, std::uint64_t seed)
    : config_(&config),
      seed_(seed),
      heaters_{Heater(config.nozzle, config.period, ThermalChannel::t0),
               Heater(config.bed, config.period, ThermalChannel::bed)} {}

void Thermal::power_on(SimTime now) {
    SimTime elapsed{0};
    if (next_ != never) {
        advance(now);
        elapsed = now - (next_ - config_->period);
    }
    for (Heater& h : heaters_) {
        h.plant.step_partly(elapsed, real_power(h), h.commanded);
        h.pid.reset();
        h.protection.reset();
        h.alarmed = false;
        h.target_c = 0;
        h.output = 0;
        h.commanded = false;
    }
    printed_ = {};
    reported_ = {};
    next_ = now + config_->period;
    since_power_on_ = 0;
    moved_ = false;
    at_rest_ = false;
    frozen_ = false;
    powered_ = true;
    plan_alarm_check();
}

void Thermal::advance(SimTime now) {
    while (next_ <= now) {
        if (settled()) {
            const SimTime::rep due = (now - next_) / config_->period + 1;
            index_ += static_cast<std::uint64_t>(due);
            since_power_on_ += static_cast<std::uint64_t>(due);
            next_ += due * config_->period;
            alarm_check_ = never;
            return;
        }
        const bool looked_for = next_ >= alarm_check_;
        measure();
        next_ += config_->period;
        if (looked_for) {
            plan_alarm_check();
        }
    }
}

bool Thermal::settled() const {
    return at_rest_ && !heating(HeaterId::nozzle) && !heating(HeaterId::bed);
}

SimTime Thermal::next_measurement() const {
    return settled() ? never : next_;
}

bool Thermal::set_target(HeaterId id, double c) {
    Heater& h = heater(id);
    h.target_c = c > 0 ? h.config->clamps ? std::min(c, h.config->max_target_c) : c : 0.0;
    plan_alarm_check();
    return h.target_c != c;
}

bool Thermal::reached(HeaterId id) const {
    const Heater& h = heater(id);
    return printed_c(h.channel) >= h.target_c - h.config->done_within_c;
}

bool Thermal::above(HeaterId id) const {
    const Heater& h = heater(id);
    return printed_c(h.channel) > h.target_c + h.config->done_within_c;
}

void Thermal::mark_reported() {
    reported_ = printed_;
    moved_ = false;
}

void Thermal::set_temperature(HeaterId id, double c) {
    heater(id).plant.set_temperature(c);
    at_rest_ = false;
    plan_alarm_check();
}

void Thermal::set_ambient(double c) {
    for (Heater& h : heaters_)
        h.plant.set_ambient(c);
    at_rest_ = false;
    plan_alarm_check();
}

void Thermal::measure() {
    if (frozen_ || since_power_on_ < config_->warm_up_measurements) {
        for (Heater& h : heaters_)
            h.plant.step(powered_ ? real_power(h) : 0.0, h.commanded);
        ++index_;
        ++since_power_on_;
        return;
    }
    watch();
    const bool first = since_power_on_ == config_->warm_up_measurements;
    bool at_rest = !first;  // the first reading may be off
    for (Heater& h : heaters_) {
        h.plant.step(real_power(h), h.commanded);
        at_rest &= h.plant.settle(rest_within_k);
        read_sensor(h);
        control(h);
        at_rest &= !h.commanded;
    }
    protect();
    read_input(ThermalChannel::t1, config_->t1);
    read_input(ThermalChannel::t2, config_->t2);
    if (first || at_rest) {
        watch();
    }
    at_rest_ = at_rest;
    ++index_;
    ++since_power_on_;
}

/// What really warms it: more, or less, than the board gives when it is broken.
double Thermal::real_power(const Heater& h) {
    return std::max(h.trouble.stuck, share_of_full(h) * h.trouble.strength);
}

double Thermal::sensed_c(const Heater& h) {
    if (h.trouble.open || h.trouble.shorted) {
        const ProtectionConfig& ends = h.config->protection;
        return h.trouble.open ? ends.open_reads_c : ends.shorted_reads_c;
    }
    const double c = h.plant.sensor_c();
    return h.trouble.contact == 1 ? c : h.plant.ambient_c() + (c - h.plant.ambient_c()) * h.trouble.contact;
}

void Thermal::set_trouble(HeaterId id, const HeaterTrouble& trouble) {
    heater(id).trouble = trouble;
    at_rest_ = false;
    plan_alarm_check();
}

std::optional<HeaterId> Thermal::take_alarm() {
    for (const HeaterId id : {HeaterId::nozzle, HeaterId::bed}) {
        if (std::exchange(heater(id).alarmed, false)) {
            return id;
        }
    }
    return std::nullopt;
}

/// From what is now until `heater` may be found broken, as long as nobody touches it: never too early to ask
/// again at, and never too late.
SimTime Thermal::earliest_alarm(const Heater& h) const {
    const ProtectionConfig& limits = h.config->protection;
    if (h.target_c == 0 && !h.commanded && !(h.trouble.stuck > 0)) {
        // What is still under way heats it by less than that.
        return sensed_c(h) > limits.max_c - near_max_k ? next_ : never;
    }
    if (h.trouble != HeaterTrouble{} || !h.protection.watches(h.target_c)) {
        return next_;
    }
    if (h.plant.coldest_c() < limits.min_c + reading_error_k) {
        return next_;
    }
    // No sensor reads more than the warmest there is, and that rises no faster than full power makes it.
    const double room_k = limits.max_c - reading_error_k - h.plant.warmest_c();
    const double hot_s = room_k / h.config->plant.heating_k_per_s;
    if (!(hot_s > 0)) {
        return next_;
    }
    return std::min(next_ + from_seconds(std::min(hot_s, longest_look_s)), h.protection.earliest(next_));
}

void Thermal::plan_alarm_check() {
    if (settled() || frozen_) {
        alarm_check_ = never;
        return;
    }
    const SimTime earliest = std::min(earliest_alarm(heaters_[0]), earliest_alarm(heaters_[1]));
    const SimTime period = config_->period;
    alarm_check_ = earliest == never   ? never
                   : earliest <= next_ ? next_
                                       : next_ + (earliest - next_ + period - SimTime{1}) / period * period;
}

void Thermal::freeze(bool powered) {
    frozen_ = true;
    powered_ = powered;
    at_rest_ = false;
    alarm_check_ = never;
}

/// Looks at what was just read. A heater that is found to be broken puts both off, with this measurement.
void Thermal::protect() {
    bool off = false;
    for (Heater& h : heaters_) {
        const bool found = h.protection.check(next_, h.target_c, printed_c(h.channel));
        h.alarmed = h.alarmed || found;
        off = off || found;
    }
    if (off) {
        for (Heater& h : heaters_) {
            h.target_c = 0;
            control(h);
        }
    }
}

void Thermal::read_sensor(Heater& h) {
    const PlantConfig& plant = h.config->plant;
    const double offset_c =
        since_power_on_ == config_->warm_up_measurements ? plant.first_reading_offset_c : 0.0;
    const double noise_c =
        h.commanded && plant.noise_c > 0
            ? plant.noise_c * measurement_noise(seed_, static_cast<unsigned>(h.channel), index_)
            : 0.0;
    print(h.channel, quantise(sensed_c(h) + offset_c + noise_c, plant.counts_per_c));
}

void Thermal::control(Heater& h) {
    h.commanded = h.target_c != 0;
    if (h.commanded) {
        h.output = h.pid.update(h.target_c, printed_c(h.channel));
    } else {
        h.pid.off(printed_c(h.channel));
        h.output = 0;
    }
}

void Thermal::read_input(ThermalChannel channel, const SensorlessInputConfig& input) {
    double c = cross_talk_c(input, temperature_c(HeaterId::nozzle));
    if (heater(HeaterId::nozzle).commanded) {
        const double stretch = std::max(1.0, std::floor(input.noise_wander_s / to_seconds(config_->period)));
        c += input.noise_c * wandering_noise(seed_, static_cast<unsigned>(channel), index_,
                                             static_cast<std::uint64_t>(stretch));
    }
    print(channel, quantise(c, input.counts_per_c));
}

void Thermal::print(ThermalChannel channel, double read_c) {
    printed_[static_cast<std::size_t>(channel)] = config_->fold ? fold_temperature(read_c) : read_c;
}

void Thermal::watch() {
    moved_ = false;
    for (std::size_t i = 0; i < printed_.size(); ++i) {
        moved_ = moved_ || std::fabs(printed_[i] - reported_[i]) >= report_change_c;
    }
}

}  // namespace fauxboard::filament
