#include "emulator/host/clock.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "emulator/link/event_loop.h"

namespace fauxboard::host {

using machine::never;

Alarm::Alarm(Clock& clock, std::function<void()> on_ring)
    : clock_(clock), on_ring_(std::make_shared<const std::function<void()>>(std::move(on_ring))) {
    clock_.alarms_.push_back(this);
}

Alarm::~Alarm() {
    std::erase(clock_.alarms_, this);
}

void Alarm::at(SimTime when) {
    when_ = when;
    if (!clock_.ringing_) {  // else the clock arms once, after the last of them
        clock_.arm(when);
    }
}

SimTime Clock::earliest() const {
    SimTime first = never;
    for (const Alarm* alarm : alarms_) {
        first = std::min(first, alarm->when_);
    }
    return first;
}

void Clock::ring_round(SimTime now) {
    ringing_ = true;
    ++round_;
    while (true) {
        Alarm* next = nullptr;
        for (Alarm* alarm : alarms_) {
            if (alarm->when_ <= now && alarm->round_ != round_ &&
                (next == nullptr || alarm->when_ < next->when_)) {
                next = alarm;
            }
        }
        if (next == nullptr) {
            break;
        }
        next->when_ = never;
        next->round_ = round_;
        const auto on_ring = next->on_ring_;  // kept, should the alarm be destroyed by its own call
        (*on_ring)();
    }
    ringing_ = false;
}

void Clock::ring_due() {
    ring_round(now());
    arm(earliest());
}

void Clock::skip(SimTime by) {
    if (ringing_) {
        throw std::logic_error("time is skipped from inside an alarm");
    }
    constexpr SimTime latest = never / 2;  // so that sums of times stay in range
    const SimTime from = now();
    const SimTime end = from + std::clamp(by, SimTime{0}, std::max(latest - from, SimTime{0}));
    skipping_at_ = from;
    for (SimTime next = earliest(); next <= end; next = earliest()) {
        skipping_at_ = std::max(skipping_at_, next);
        ring_round(skipping_at_);
    }
    skipping_at_ = never;
    skipped(end - from);
    arm(earliest());
}

void Clock::hold(bool held) {
    if (held != held_) {
        held_ = held;
        hold_changed();
        arm(earliest());
    }
}

namespace {

class RealClock final : public Clock {
  public:
    RealClock(link::EventLoop& loop, double speed)
        : loop_(loop), timer_(loop, [this] { ring(); }), speed_(speed) {}

    void start() override {
        origin_ = std::chrono::steady_clock::now();
        started_ = true;
        arm(earliest());
    }

    void run() override { loop_.run(); }

  private:
    static constexpr double longest_wait_us = 3e15;  // 95 years

    SimTime time() const override { return held() ? held_at_ : running(); }
    SimTime running() const {
        if (!started_) {
            return skipped_;
        }
        const auto passed = std::chrono::steady_clock::now() - origin_;
        if (speed_ == 1) {
            return std::chrono::duration_cast<SimTime>(passed) + skipped_;
        }
        const double scaled = std::chrono::duration<double, std::micro>(passed).count() * speed_;
        return SimTime{static_cast<SimTime::rep>(scaled)} + skipped_;
    }

    void arm(SimTime when) override {
        // A timer that rings too early costs one turn of the loop; moving it costs a system call each time,
        // and most requests move the next thing due to and fro.
        if (when >= armed_ || !started_ || (held() && when > held_at_)) {
            return;
        }
        const double real_us =
            held() ? 0 : std::ceil(static_cast<double>((when - skipped_).count()) / speed_);
        if (real_us > longest_wait_us) {
            return;
        }
        armed_ = when;
        timer_.at(origin_ + std::chrono::microseconds(static_cast<std::int64_t>(std::max(real_us, 0.0))));
    }

    void ring() {
        armed_ = never;
        ring_due();
    }

    void skipped(SimTime by) override {
        (held() ? held_at_ : skipped_) += by;
        armed_ = never;  // the timer is for a moment that comes sooner now
    }

    void hold_changed() override {
        if (held()) {
            held_at_ = running();
        } else {
            skipped_ += held_at_ - running();
            armed_ = never;
        }
    }

    link::EventLoop& loop_;
    link::Timer timer_;
    double speed_;
    std::chrono::steady_clock::time_point origin_;
    bool started_ = false;
    SimTime skipped_{0};
    SimTime held_at_{0};
    SimTime armed_ = never;
};

class JumpingClock final : public Clock {
  public:
    explicit JumpingClock(link::EventLoop& loop) : loop_(loop) {}

    void start() override {}

    void run() override {
        SimTime next = never;
        while (!loop_.stopped()) {
            next = next_jump();
            for (int i = 0; i < steps_per_poll && next != never && !loop_.stopped(); ++i) {
                now_ = std::max(now_, next);
                ring_due();
                next = next_jump();
            }
            if (loop_.stopped()) {
                return;
            }
            if (next == never) {
                if (!loop_.run_one()) {
                    return;
                }
            } else {
                loop_.poll();
            }
        }
    }

  private:
    static constexpr int steps_per_poll = 64;

    /// Held, it does not jump; what is due by now rings.
    SimTime next_jump() const {
        const SimTime next = earliest();
        return held() && next > now_ ? never : next;
    }
    SimTime time() const override { return now_; }
    void arm(SimTime) override {}
    void skipped(SimTime by) override { now_ += by; }

    link::EventLoop& loop_;
    SimTime now_{0};
};

}  // namespace

std::unique_ptr<Clock> make_clock(link::EventLoop& loop, Speed speed) {
    if (speed.max) {
        return std::make_unique<JumpingClock>(loop);
    }
    return std::make_unique<RealClock>(loop, speed.factor);
}

SimTime real_time() {
    return std::chrono::duration_cast<SimTime>(std::chrono::steady_clock::now().time_since_epoch());
}

SimTime time_since_epoch() {
    return std::chrono::duration_cast<SimTime>(std::chrono::system_clock::now().time_since_epoch());
}

}  // namespace fauxboard::host
