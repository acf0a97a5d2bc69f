#pragma once

#include <algorithm>

#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

/// The UV lamp and the fan that cools it. The lamp is switched off by a countdown in milliseconds.
class Lamp {
  public:
    void power_on() {
        off_due_ = fan_off_due_ = never;
        on_ = fan_ = false;
        lit_ = SimTime{0};
    }
    /// Lights it for so long; for no time at all it stays dark. A dead one does, too, but the countdown runs.
    void light_for(SimTime time, SimTime now) {
        off(now);
        if (time > SimTime{0}) {
            on_ = !dead;
            counting_ = true;
            since_ = begun_ = now;
            off_due_ = now + time;
        }
    }
    /// Lights it, and nothing counts down.
    void light_on(SimTime now) {
        off(now);
        on_ = !dead;
        since_ = begun_ = now;
    }
    void off(SimTime now) {
        if (on_) {
            lit_ += now - since_;
            last_ = now - begun_;
        }
        on_ = counting_ = false;
        off_due_ = never;
    }
    /// It breaks: dark, while the countdown goes on.
    void fail(SimTime now) {
        dead = true;
        if (on_) {
            lit_ += now - since_;
            on_ = false;
        }
    }
    void fan_for(SimTime time, SimTime now) {
        fan_ = true;
        fan_off_due_ = time == never ? never : now + time;
    }
    /// The fan goes on for a while.
    void fan_off_in(SimTime time, SimTime now) {
        if (fan_) {
            fan_off_due_ = now + time;
        }
    }
    void advance(SimTime now) {
        if (off_due_ <= now) {
            off(off_due_);
        }
        if (fan_off_due_ <= now) {
            fan_ = false;
            fan_off_due_ = never;
        }
    }
    SimTime next_event() const { return std::min(off_due_, fan_off_due_); }

    bool on() const { return on_; }
    /// The countdown runs, as it does when the lamp is dead, too.
    bool counting() const { return counting_; }
    bool fan() const { return fan_; }
    SimTime left(SimTime now) const { return off_due_ == never ? SimTime{0} : off_due_ - now; }
    /// Of the last light that ended.
    SimTime last() const { return last_; }
    /// All light so far, since taken.
    SimTime take_lit(SimTime now) {
        const SimTime all = lit_ + (on_ ? now - since_ : SimTime{0});
        lit_ = SimTime{0};
        since_ = now;
        return all;
    }

    bool dead = false;

  private:
    bool on_ = false;
    bool counting_ = false;
    bool fan_ = false;
    SimTime begun_{0};  ///< this light
    SimTime since_{0};  ///< what of it is not in lit_ yet
    SimTime lit_{0};
    SimTime last_{0};
    SimTime off_due_ = never;
    SimTime fan_off_due_ = never;
};

}  // namespace fauxboard::dlp
