#include "emulator/board/schedule_runner.h"

#include <algorithm>
#include <limits>

namespace fauxboard::board {

using behaviour::Scope;
using behaviour::Slot;
using machine::never;

void ScheduleRunner::reload(const behaviour::Profile& profile, SimTime now) {
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
    const std::vector<Slot>& slots = profile.schedule.slots;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        std::size_t ahead = 0;
        while (ahead < slots.size() && !slots[(i + ahead) % slots.size()].frame) {
            ++ahead;
        }
        slots_[i].to_frame = ahead == slots.size() ? no_frame : ahead;
    }
    index_ = slots_.empty() ? 0 : index_ % slots_.size();
    if (slots_.empty()) {
        next_ = never;
        frozen_ = false;
    } else if (next_ == never && !frozen_) {
        next_ = now + profile.schedule.slot;
    }
}

void ScheduleRunner::power_on(SimTime now) {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        slots_[i].base = profile_->schedule.slots[i].first_round;
        slots_[i].last_sent = 0;
    }
    std::fill(watched_.begin(), watched_.end(), std::numeric_limits<double>::quiet_NaN());
    index_ = 0;
    round_ = 0;
    frozen_ = false;
    next_ = slots_.empty() ? never : now + profile_->schedule.first;
}

void ScheduleRunner::take_as_told(const machine::Machine& machine) {
    for (const Slot& slot : profile_->schedule.slots) {
        if (slot.frame && slot.starts_told) {
            remember(*slot.frame, machine);
        }
    }
}

bool ScheduleRunner::changed(const std::vector<std::size_t>& which, std::size_t frame,
                             const machine::Machine& machine) const {
    const auto& fields = profile_->frames[frame].watched;
    return std::any_of(which.begin(), which.end(), [&](std::size_t i) {
        return !(fields[i]->get(machine).number == watched_[watch_from_[frame] + i]);
    });
}

void ScheduleRunner::remember(std::size_t frame, const machine::Machine& machine) {
    const auto& fields = profile_->frames[frame].watched;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        watched_[watch_from_[frame] + i] = fields[i]->get(machine).number;
    }
}

bool ScheduleRunner::sent_this_round(std::size_t frame) const {
    const auto& slots = profile_->schedule.slots;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (slots[i].frame == frame && slots_[i].last_sent == round_ + 1) {
            return true;
        }
    }
    return false;
}

bool ScheduleRunner::conditions_hold(std::size_t index, const Scope& scope) const {
    const Slot& slot = profile_->schedule.slots[index];
    return behaviour::all_hold(slot.when, scope) &&
           (slot.when_changed.empty() || changed(slot.when_changed, *slot.frame, scope.machine));
}

const Slot* ScheduleRunner::turn(const Scope& scope) {
    const behaviour::Schedule& schedule = profile_->schedule;
    if (schedule.frozen(scope)) {
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
        if (!slot.or_changed.empty() && changed(slot.or_changed, *slot.frame, scope.machine)) {
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

SimTime ScheduleRunner::next_due(const Scope& scope, bool volatile_state) const {
    if (next_ == never) {
        return never;
    }
    if (volatile_state) {
        const std::size_t ahead = slots_[index_].to_frame;
        return ahead == no_frame ? never : next_ + static_cast<SimTime::rep>(ahead) * profile_->schedule.slot;
    }
    const std::vector<Slot>& slots = profile_->schedule.slots;
    const std::size_t n = slots_.size();
    SimTime best = never;
    SimTime at = next_;
    for (std::size_t ahead = 0, i = index_; ahead < n && at < best; ++ahead, at += profile_->schedule.slot) {
        const Slot& slot = slots[i];
        const std::size_t index = i;
        const std::uint64_t round = round_ + (index < index_ ? 1 : 0);
        i = i + 1 == n ? 0 : i + 1;
        if (!slot.frame) {
            continue;
        }
        if (!slot.or_changed.empty() && changed(slot.or_changed, *slot.frame, scope.machine)) {
            return std::min(best, at);
        }
        if (!slot.always && !conditions_hold(index, scope)) {
            continue;
        }
        const std::uint64_t base = slots_[index].base;
        const std::uint64_t every = slot.every_rounds;
        const std::uint64_t wait = round < base ? base - round : (every - (round - base) % every) % every;
        best = std::min(best, at + static_cast<SimTime::rep>(wait * n) * profile_->schedule.slot);
    }
    return best;
}

void ScheduleRunner::lose_rounds(int rounds) {
    if (next_ != never) {
        next_ += rounds * static_cast<SimTime::rep>(slots_.size()) * profile_->schedule.slot;
    }
}

void ScheduleRunner::stall(SimTime time) {
    if (next_ != never) {
        next_ += time;
    }
}

void ScheduleRunner::thaw(SimTime now) {
    frozen_ = false;
    next_ = now + profile_->schedule.slot;
}

}  // namespace fauxboard::board
