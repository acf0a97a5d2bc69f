#include "emulator/printer/thermal.h"

#include <algorithm>
#include <cmath>

#include "emulator/printer/thermal_crosstalk.h"
#include "emulator/printer/thermal_fold.h"

namespace fauxboard::printer {

namespace {

constexpr double rest_within_k = 0.005;
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
        h.plant.step_partly(elapsed, share_of_full(h), h.commanded);
        h.pid.reset();
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
}

void Thermal::advance(SimTime now) {
    while (next_ <= now) {
        if (settled()) {
            const SimTime::rep due = (now - next_) / config_->period + 1;
            index_ += static_cast<std::uint64_t>(due);
            since_power_on_ += static_cast<std::uint64_t>(due);
            next_ += due * config_->period;
            return;
        }
        measure();
        next_ += config_->period;
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
    h.target_c = c > 0 ? std::min(c, h.config->max_target_c) : 0.0;
    return h.target_c != c;
}

bool Thermal::reached(HeaterId id) const {
    const Heater& h = heater(id);
    return printed_c(h.channel) >= h.target_c - h.config->done_within_c;
}

void Thermal::mark_reported() {
    reported_ = printed_;
    moved_ = false;
}

void Thermal::set_temperature(HeaterId id, double c) {
    heater(id).plant.set_temperature(c);
    at_rest_ = false;
}

void Thermal::set_ambient(double c) {
    for (Heater& h : heaters_)
        h.plant.set_ambient(c);
    at_rest_ = false;
}

void Thermal::measure() {
    if (since_power_on_ < config_->warm_up_measurements) {
        for (Heater& h : heaters_)
            h.plant.step(share_of_full(h), h.commanded);
        ++index_;
        ++since_power_on_;
        return;
    }
    watch();
    const bool first = since_power_on_ == config_->warm_up_measurements;
    bool at_rest = !first;  // the first reading may be off
    for (Heater& h : heaters_) {
        h.plant.step(share_of_full(h), h.commanded);
        at_rest &= h.plant.settle(rest_within_k);
        read_sensor(h);
        control(h);
        at_rest &= !h.commanded;
    }
    read_input(ThermalChannel::t1, config_->t1);
    read_input(ThermalChannel::t2, config_->t2);
    if (first || at_rest) {
        watch();
    }
    at_rest_ = at_rest;
    ++index_;
    ++since_power_on_;
}

void Thermal::read_sensor(Heater& h) {
    const PlantConfig& plant = h.config->plant;
    const double offset_c =
        since_power_on_ == config_->warm_up_measurements ? plant.first_reading_offset_c : 0.0;
    print(h.channel, quantise(h.plant.sensor_c() + offset_c, plant.counts_per_c));
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
        c += input.noise_c * measurement_noise(seed_, static_cast<unsigned>(channel), index_);
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

}  // namespace fauxboard::printer
