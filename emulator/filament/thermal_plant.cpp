#include "emulator/filament/thermal_plant.h"
#include "emulator/filament/names.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::filament {

namespace {

constexpr std::size_t order = 4;  // three temperatures and the heater's output
using Matrix = std::array<std::array<double, order>, order>;

Matrix multiply(const Matrix& a, const Matrix& b) {
    Matrix product{};
    for (std::size_t i = 0; i < order; ++i) {
        for (std::size_t k = 0; k < order; ++k) {
            for (std::size_t j = 0; j < order; ++j)
                product[i][j] += a[i][k] * b[k][j];
        }
    }
    return product;
}

/// exp(a * seconds) by scaling and squaring: 20 terms at a norm below 1/2 are exact to the last bits.
Matrix exponential(const Matrix& a, double seconds) {
    double norm = 0;
    for (const auto& row : a) {
        double sum = 0;
        for (const double value : row)
            sum += std::fabs(value) * seconds;
        norm = std::max(norm, sum);
    }
    int squarings = 0;
    for (; norm > 0.5 && squarings < 40; norm /= 2)
        ++squarings;
    const double scale = std::ldexp(seconds, -squarings);
    Matrix result{};
    for (std::size_t i = 0; i < order; ++i)
        result[i][i] = 1;
    Matrix term = result;
    for (int n = 1; n <= 20; ++n) {
        term = multiply(term, a);
        for (std::size_t i = 0; i < order; ++i) {
            for (std::size_t j = 0; j < order; ++j) {
                term[i][j] *= scale / n;
                result[i][j] += term[i][j];
            }
        }
    }
    for (int i = 0; i < squarings; ++i)
        result = multiply(result, result);
    return result;
}

}  // namespace

ThermalPlant::ThermalPlant(const PlantConfig& config, SimTime period)
    : config_(config), ambient_c_(config.ambient_c), period_s_(to_seconds(period)) {
    config_.dead_time_s = std::clamp(config.dead_time_s, 0.0, 60.0);
    config_.sensor_lag_s = std::max(config.sensor_lag_s, 0.01);
    delay_periods_ = static_cast<std::size_t>(config_.dead_time_s / period_s_);
    delay_rest_s_ = std::max(0.0, config_.dead_time_s - static_cast<double>(delay_periods_) * period_s_);
    on_ = discretise(period_s_, true);
    off_ = discretise(period_s_, false);
    powers_.assign(delay_periods_ + 2, 0.0);
    idle_periods_ = powers_.size();
}

ThermalPlant::Step ThermalPlant::discretise(double seconds, bool commanded) const {
    const double loss = commanded ? config_.loss_on_per_s : config_.loss_off_per_s;
    const double a = config_.exchange_a_per_s;
    const double b = config_.exchange_b_per_s;
    const double s = 1.0 / config_.sensor_lag_s;
    const Matrix rates{{{-a - loss, a, 0, config_.heating_k_per_s},
                        {b, -b - config_.loss_behind_per_s, 0, 0},
                        {s, 0, -s, 0},
                        {0, 0, 0, 0}}};
    const double early_s = std::min(delay_rest_s_, seconds);
    const Matrix early = exponential(rates, early_s);
    const Matrix late = exponential(rates, seconds - early_s);
    const Matrix whole = multiply(late, early);
    Step step;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            step.transition[i][j] = whole[i][j];
        step.late[i] = late[i][3];
        step.early[i] = whole[i][3] - late[i][3];
    }
    return step;
}

void ThermalPlant::apply(const Step& step, double early_power, double late_power) {
    const State old = state_;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& row = step.transition[i];
        state_[i] = row[0] * old[0] + row[1] * old[1] + row[2] * old[2] + step.early[i] * early_power +
                    step.late[i] * late_power;
    }
}

double& ThermalPlant::past_power(std::size_t age) {
    return powers_[newest_ >= age ? newest_ - age : newest_ + powers_.size() - age];
}

void ThermalPlant::push_power(double power) {
    newest_ = newest_ + 1 == powers_.size() ? 0 : newest_ + 1;
    powers_[newest_] = power;
    idle_periods_ = power != 0.0 ? 0 : std::min(idle_periods_ + 1, powers_.size());
}

void ThermalPlant::step(double power, bool commanded) {
    push_power(power);
    apply(commanded ? on_ : off_, past_power(delay_periods_ + 1), past_power(delay_periods_));
}

void ThermalPlant::step_partly(SimTime elapsed, double power, bool commanded) {
    const double seconds = to_seconds(elapsed);
    if (!(seconds > 0)) return;
    push_power(power);
    apply(discretise(seconds, commanded), past_power(delay_periods_ + 1), past_power(delay_periods_));
    // The last `seconds` of each old period fall into the new period after it.
    const double share = std::min(1.0, seconds / period_s_);
    for (std::size_t age = 0; age <= delay_periods_; ++age) {
        past_power(age) = (1 - share) * past_power(age + 1) + share * past_power(age);
    }
    idle_periods_ = idle_periods_ == powers_.size() ? idle_periods_ : 0;
}

bool ThermalPlant::settle(double within_k) {
    if (idle_periods_ < powers_.size()) return false;
    for (const double above : state_) {
        if (std::fabs(above) > within_k) return false;
    }
    state_ = {};
    return true;
}

void ThermalPlant::set_temperature(double c) {
    state_.fill(c - ambient_c_);
}

void ThermalPlant::set_ambient(double c) {
    for (double& above : state_)
        above += ambient_c_ - c;
    ambient_c_ = c;
}

}  // namespace fauxboard::filament
