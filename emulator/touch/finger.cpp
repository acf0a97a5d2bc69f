#include "emulator/touch/finger.h"

#include <algorithm>

namespace fauxboard::touch {

void Finger::power_on(SimTime now) {
    power_on_ = now;
    ticks_ = 0;
    fresh_ = true;
    pressed_ = press_due_ = release_due_ = false;
    next_look_ = machine::never;
    next_tick_ =
        waiting_.empty() ? machine::never : after(std::max(now, waiting_.front().from), timing_.tick);
}

/// The first time of that period, counted from power-on, that is not before `at`.
SimTime Finger::after(SimTime at, SimTime period) const {
    const SimTime since = std::max(at - power_on_, SimTime{0});
    return power_on_ + (since + period - SimTime{1}) / period * period;
}

std::optional<SimTime> Finger::touch(SimTime now, int x, int y, SimTime how_long) {
    if (waiting_.size() >= most_waiting) {
        return std::nullopt;
    }
    // Between two contacts the program must see the glass free, and its page must look.
    const SimTime apart = timing_.tick + 2 * timing_.look;
    const SimTime from =
        waiting_.empty() ? std::max(now, felt_.until + apart) : std::max(now, waiting_.back().until + apart);
    waiting_.push_back({x, y, from, from + how_long});
    if (next_tick_ == machine::never) {
        next_tick_ = after(from, timing_.tick);
    }
    return from + how_long + apart;
}

std::optional<Contact> Finger::contact(SimTime now) const {
    const bool down = !waiting_.empty() && waiting_.front().from <= now && now < waiting_.front().until;
    return down ? std::optional(waiting_.front()) : std::nullopt;
}

SimTime Finger::lasted(SimTime now) const {
    return std::min(now, felt_.until) - felt_.from;
}

SimTime Finger::next_due() const {
    return std::min(next_tick_, next_look_);
}

void Finger::tick(SimTime now) {
    next_tick_ = now + timing_.tick;
    if (waiting_.empty()) {
        next_tick_ = machine::never;
        return;
    }
    const Contact here = waiting_.front();
    if (now < here.until) {
        ticks_ = fresh_ ? 1 : ticks_ + 1;
        fresh_ = false;
        if (ticks_ == timing_.press_ticks) {
            pressed_ = press_due_ = true;
            felt_ = here;
            next_look_ = after(now, timing_.look);
        }
        return;
    }
    felt_ = here;
    waiting_.pop_front();
    next_tick_ = waiting_.empty() ? machine::never
                                  : after(std::max(now + timing_.tick, waiting_.front().from), timing_.tick);
    fresh_ = true;
    if (pressed_) {
        release_due_ = true;
        pressed_ = false;
        next_look_ = press_due_ ? next_look_ : after(now, timing_.look);
    }
}

Finger::Felt Finger::look() {
    if (press_due_) {
        press_due_ = false;
        next_look_ += timing_.look;
        return Felt::press;
    }
    if (release_due_) {
        release_due_ = false;
        next_look_ = machine::never;
        return Felt::release;
    }
    next_look_ += timing_.look;
    return Felt::held;
}

Finger::Felt Finger::advance(SimTime now) {
    if (next_tick_ <= now) {
        tick(now);
        return Felt::nothing;
    }
    return next_look_ <= now ? look() : Felt::nothing;
}

}  // namespace fauxboard::touch
