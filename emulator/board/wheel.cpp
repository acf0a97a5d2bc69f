#include "emulator/board/wheel.h"

#include <algorithm>
#include <limits>

namespace fauxboard::board {

using behaviour::Scope;
using behaviour::Slot;
using printer::never;

void Wheel::reload(const behaviour::Profile& profile) {
    profile_ = &profile;
    slots_.resize(profile.schedule.slots.size());
    watch_from_.clear();
    std::size_t from = 0;
    for (const behaviour::Frame& frame : profile.frames) {
        watch_from_.push_back(from);
        from += frame.watched.size();
    }
    // "Never sent" differs from every value.
    watched_.assign(from, std::numeric_limits<double>::quiet_NaN());
    index_ = slots_.empty() ? 0 : index_ % slots_.size();
    if (slots_.empty()) {
        next_ = never;
    }
}

void Wheel::power_on(SimTime now) {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        slots_[i] = {profile_->schedule.slots[i].first_round, 0};
    }
    std::fill(watched_.begin(), watched_.end(), std::numeric_limits<double>::quiet_NaN());
    index_ = 0;
    round_ = 0;
    frozen_ = false;
    next_ = slots_.empty() ? never : now + profile_->schedule.first;
}

bool Wheel::changed(const std::vector<std::size_t>& which, std::size_t frame,
                    const printer::Printer& machine) const {
    const auto& fields = profile_->frames[frame].watched;
    return std::any_of(which.begin(), which.end(), [&](std::size_t i) {
        return !(fields[i]->get(machine).number == watched_[watch_from_[frame] + i]);
    });
}

void Wheel::sent(std::size_t frame, const printer::Printer& machine) {
    const auto& fields = profile_->frames[frame].watched;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        watched_[watch_from_[frame] + i] = fields[i]->get(machine).number;
    }
}

bool Wheel::sent_this_round(std::size_t frame) const {
    const auto& slots = profile_->schedule.slots;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (slots[i].frame == frame && slots_[i].last_sent == round_ + 1) {
            return true;
        }
    }
    return false;
}

bool Wheel::conditions_hold(std::size_t index, const Scope& scope) const {
    const Slot& slot = profile_->schedule.slots[index];
    return behaviour::all_hold(slot.when, scope) &&
           (slot.when_changed.empty() || changed(slot.when_changed, *slot.frame, scope.printer));
}

const Slot* Wheel::turn(const Scope& scope) {
    const behaviour::Schedule& schedule = profile_->schedule;
    if (!schedule.frozen_while.empty() && behaviour::all_hold(schedule.frozen_while, scope)) {
        frozen_ = true;
        next_ = never;
        return nullptr;
    }
    const std::size_t index = index_;
    const Slot& slot = schedule.slots[index];
    SlotState& state = slots_[index];
    const std::uint64_t round = round_;
    bool due = false;
    if (slot.frame) {
        due = round >= state.base && (round - state.base) % slot.every_rounds == 0;
        if (!slot.or_changed.empty() && changed(slot.or_changed, *slot.frame, scope.printer)) {
            due = true;
            state.base = round;  // the pause counts anew from here
        }
        due = due && (!slot.only_with || sent_this_round(*slot.only_with)) && conditions_hold(index, scope);
        if (due) {
            state.last_sent = round + 1;
        }
    }
    next_ += schedule.slot;
    if (++index_ == slots_.size()) {
        index_ = 0;
        ++round_;
    }
    return due ? &slot : nullptr;
}

SimTime Wheel::next_due(const Scope& scope, bool volatile_state) const {
    if (next_ == never) {
        return never;
    }
    const behaviour::Schedule& schedule = profile_->schedule;
    const std::size_t n = slots_.size();
    SimTime best = never;
    for (std::size_t i = 0; i < n; ++i) {
        const Slot& slot = schedule.slots[i];
        if (!slot.frame) {
            continue;
        }
        const bool passed = i < index_;
        const std::size_t ahead = passed ? i + n - index_ : i - index_;
        const std::uint64_t round = round_ + (passed ? 1 : 0);
        SimTime at = next_ + static_cast<SimTime::rep>(ahead) * schedule.slot;
        const bool may_now = volatile_state || (!slot.or_changed.empty() &&
                                                changed(slot.or_changed, *slot.frame, scope.printer));
        if (!may_now) {
            if (!slot.always && !conditions_hold(i, scope)) {
                continue;
            }
            const std::uint64_t base = slots_[i].base;
            const std::uint64_t every = slot.every_rounds;
            const std::uint64_t wait = round < base ? base - round : (every - (round - base) % every) % every;
            at += static_cast<SimTime::rep>(wait * n) * schedule.slot;
        }
        best = std::min(best, at);
    }
    return best;
}

void Wheel::lose_rounds(int rounds) {
    if (next_ != never) {
        next_ += rounds * static_cast<SimTime::rep>(slots_.size()) * profile_->schedule.slot;
    }
}

void Wheel::stall(SimTime time) {
    if (next_ != never) {
        next_ += time;
    }
}

void Wheel::thaw(SimTime now) {
    frozen_ = false;
    next_ = now + profile_->schedule.slot;
}

}  // namespace fauxboard::board
