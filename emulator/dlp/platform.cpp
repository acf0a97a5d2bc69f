#include "emulator/dlp/platform.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::dlp {

void Platform::power_on() {
    count_ = 0;
    from_ = 0;
    switches_ = false;
}

double Platform::true_way(double way) const {
    const double wanted = true_ + way * (1 - trouble_.lost_share);
    return std::clamp(wanted, std::min(true_, -config_.overtravel_mm),
                      std::max(true_, config_.travel_mm + config_.overtravel_mm)) -
           true_;
}

double Platform::true_position(SimTime now) const {
    return true_ + true_way(way_at(now));
}

double Platform::target() const {
    return busy() ? moves_[(head_ + count_ - 1) % most_moves].mm : from_;
}

void Platform::call_it(double mm, SimTime now) {
    stop(now);
    from_ = mm;
}

/// When the move under way ends: at its target, or at the switch that it runs into.
void Platform::find_end() {
    hits_ = false;
    double total_s = ramp_.total_s();
    const bool down = direction_ < 0;
    const SwitchState state = down ? trouble_.lower : trouble_.upper;
    if (switches_ && state != SwitchState::never_closes) {
        const double ahead = down ? true_ : config_.travel_mm - true_;
        const double share = std::max(1 - trouble_.lost_share, 1e-9);
        const double way = state == SwitchState::never_opens ? 0 : std::max(ahead, 0.0) / share;
        if (way <= ramp_.way()) {
            hits_ = true;
            total_s = ramp_.when(way);
        }
    }
    // Rounded up, so that a switch is reached when the time has come.
    end_ = begin_ + SimTime{static_cast<SimTime::rep>(std::ceil(total_s * 1e6))};
}

void Platform::begin(SimTime now) {
    const Move& move = moves_[head_];
    const double way = move.mm - from_;
    direction_ = way < 0 ? -1 : 1;
    ramp_ = Ramp(std::abs(way), std::min(move.mm_s, static_cast<double>(planner_limit)), move.mm_s2);
    begin_ = now;
    find_end();
}

bool Platform::move(const Move& move, bool switches, SimTime now) {
    constexpr double farthest_mm = 100'000;  // settings may say infinity
    if (count_ == most_moves || std::isnan(move.mm)) {
        return false;
    }
    moves_[(head_ + count_++) % most_moves] = {std::clamp(move.mm, -farthest_mm, farthest_mm), move.mm_s,
                                               move.mm_s2};
    switches_ = switches;
    if (count_ == 1) {
        begin(now);
    }
    return true;
}

/// The move under way is over after `way`, and no other begins.
void Platform::settle(double way) {
    true_ += true_way(way);
    from_ += way;
}

void Platform::stop(SimTime now) {
    if (busy()) {
        settle(way_at(now));
        count_ = 0;
    }
}

void Platform::advance(SimTime now) {
    while (busy() && end_ <= now) {
        const SimTime end = end_;
        if (hits_) {
            stop(end);
            return;
        }
        settle(moves_[head_].mm - from_);
        head_ = (head_ + 1) % most_moves;
        if (--count_ != 0) {
            begin(end);
        }
    }
}

void Platform::set_trouble(const PlatformTrouble& trouble, SimTime now) {
    if (trouble == trouble_) {
        return;
    }
    if (!busy()) {
        trouble_ = trouble;
        return;
    }
    // From here on the rest of the way goes by the new rules; its times stay.
    const double done = way_at(now);
    const double true_now = true_ + true_way(done);
    trouble_ = trouble;
    true_ = true_now - done * (1 - trouble_.lost_share);
    find_end();
    end_ = std::max(end_, now);
}

}  // namespace fauxboard::dlp
