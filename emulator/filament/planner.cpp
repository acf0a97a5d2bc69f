#include "emulator/filament/planner.h"
#include "emulator/filament/names.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::filament {
namespace {

/// Marlin's MINIMUM_PLANNER_SPEED, mm/s: what counts as standing still.
constexpr double standstill = 0.05;
constexpr double least_setting = 0.01;  // a setting of 0 must not stop the machine for ever
constexpr double longest_block_s = 86400;

double at_least(double value, double least) {
    return value > least ? value : least;
}

/// How much the speed of one axis jumps; turning round counts as the faster of the two (Marlin 1.1).
double speed_jump(double exit, double entry) {
    if (exit > entry) {
        return entry > 0 || exit < 0 ? exit - entry : std::max(exit, -entry);
    }
    return entry < 0 || exit > 0 ? entry - exit : std::max(-exit, entry);
}

}  // namespace

double trapezoid_seconds(double length, double from, double nominal, double to, double acceleration) {
    const double ramps = (2 * nominal * nominal - from * from - to * to) / (2 * acceleration);
    if (ramps <= length) {
        return (2 * nominal - from - to) / acceleration + (length - ramps) / nominal;
    }
    const double peak = std::sqrt(acceleration * length + (from * from + to * to) / 2);
    return (2 * std::max({peak, from, to}) - from - to) / acceleration;
}

void Planner::clear() {
    head_ = count_ = 0;
    end_ = never;
    start_speed_ = at_rest;
    last_nominal_ = 0;
}

bool Planner::add(const Move& move) {
    const AxisValues& from = count_ == 0 ? move.from : at(count_ - 1).target;
    AxisValues way;
    double steps = 0;
    for (std::size_t i = 0; i < axis_count; ++i) {
        way[i] = move.target[i] - from[i];
        steps = std::max(steps, std::abs(way[i]) * settings_->steps_per_mm[i]);
    }
    if (steps < min_steps) {
        return false;
    }
    if (count_ == 0) {
        last_nominal_ = 0;  // from standstill
    }
    const double xyz = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    const bool moves_head = xyz > 1e-4;
    Block& block = at(count_);
    block.target = move.target;
    block.byte = move.byte;
    block.length = moves_head ? xyz : std::abs(way[3]);
    const double per_mm = 1 / block.length;
    double feed =
        at_least(move.feed_mm_s, way[3] != 0 ? settings_->min_velocity_mm_s : settings_->min_travel_mm_s);
    feed = at_least(feed, least_setting);
    double acceleration =
        at_least(moves_head ? settings_->acceleration_mm_s2 : settings_->retract_acceleration_mm_s2, 1);
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double share = std::abs(way[i]) * per_mm;
        if (share == 0) {
            continue;
        }
        feed = std::min(feed, at_least(settings_->velocity_mm_s[i], least_setting) / share);
        acceleration = std::min(acceleration, at_least(settings_->max_acceleration_mm_s2[i], 1) / share);
    }
    block.nominal = feed;
    block.acceleration = acceleration;
    AxisValues speed;
    for (std::size_t i = 0; i < axis_count; ++i) {
        speed[i] = way[i] * per_mm * feed;
    }
    double safe = feed;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double jump = std::abs(speed[i]);
        const double allowed = at_least(settings_->jerk_mm_s[i], least_setting);
        // As Marlin has it: the first axis in excess bounds the speed along the way, later ones their own.
        if (jump > allowed) {
            safe = safe == feed ? allowed : std::min(safe, feed * allowed / jump);
        }
    }
    double entry = safe;
    if (last_nominal_ > 0) {
        entry = junction(speed, feed);
        if (last_safe_ > 0.99 * entry && safe > 0.99 * entry) {
            entry = safe;  // as good as stopping: then it is called that
        }
    }
    block.junction_sq = entry * entry;
    last_speed_ = speed;
    last_nominal_ = feed;
    last_safe_ = safe;
    ++count_;
    brake_backwards();
    return true;
}

/// The highest speed at which the move before may pass into one of these axis speeds.
double Planner::junction(const AxisValues& speed, double nominal) const {
    const bool slower = last_nominal_ > nominal;
    const double common = slower ? nominal : last_nominal_;
    // Marlin scales the faster move down to the slower one only when that is the one before; a slow move into
    // a fast one counts with the whole jump. Estimators (PrusaSlicer's) and the firmware agree on that.
    const double last_factor = slower ? common / last_nominal_ : 1;
    double share = 1;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double jump = speed_jump(last_speed_[i] * last_factor, speed[i]) * share;
        const double allowed = at_least(settings_->jerk_mm_s[i], least_setting);
        if (jump > allowed) {
            share *= allowed / jump;
        }
    }
    return common * share;
}

/// From the last block, behind which is standstill, back as far as something changes.
void Planner::brake_backwards() {
    double exit_sq = standstill * standstill;
    // The speed at which a block under way ends is settled, and with it that of the next one's start.
    const std::size_t first = running() ? 1 : 0;
    for (std::size_t i = count_; i-- > first;) {
        Block& block = at(i);
        const double entry_sq = std::min(block.junction_sq, exit_sq + 2 * block.acceleration * block.length);
        if (i + 1 < count_ && entry_sq == block.entry_sq) {
            return;
        }
        block.entry_sq = entry_sq;
        exit_sq = entry_sq;
    }
}

std::uint64_t Planner::byte(std::uint64_t otherwise) const {
    for (std::size_t i = 0; i < count_; ++i) {
        if (at(i).byte != no_byte) {
            return at(i).byte;
        }
    }
    return otherwise;
}

void Planner::disown() {
    for (std::size_t i = 0; i < count_; ++i) {
        at(i).byte = no_byte;
    }
}

void Planner::start(SimTime now) {
    if (count_ == 0 || running()) {
        return;
    }
    const Block& block = at(0);
    const double from = start_speed_ < 0 ? std::sqrt(block.entry_sq) : std::min(start_speed_, block.nominal);
    double to_sq = count_ > 1 ? at(1).entry_sq : standstill * standstill;
    to_sq =
        std::min({to_sq, from * from + 2 * block.acceleration * block.length, block.nominal * block.nominal});
    end_speed_ = std::sqrt(to_sq);
    const double seconds =
        trapezoid_seconds(block.length, from, block.nominal, end_speed_, block.acceleration);
    const double us = std::min(seconds, longest_block_s) * 1e6 + rest_us_;
    const double whole = std::floor(us);
    rest_us_ = us - whole;
    end_ = now + SimTime{static_cast<SimTime::rep>(whole)};
}

void Planner::finish() {
    head_ = head_ + 1 == capacity ? 0 : head_ + 1;
    --count_;
    end_ = never;
    start_speed_ = count_ == 0 ? at_rest : end_speed_;
}

void Planner::shift(std::size_t axis, double mm) {
    for (std::size_t i = 0; i < count_; ++i) {
        at(i).target[axis] += mm;
    }
}

}  // namespace fauxboard::filament
