#include "emulator/host/clock.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "emulator/link/event_loop.h"

namespace fauxboard::host {
namespace {

using printer::never;

class RealClock final : public Clock {
  public:
    RealClock(asio::io_context& context, double speed) : context_(context), timer_(context), speed_(speed) {}

    void start(std::function<void()> on_wake) override {
        on_wake_ = std::move(on_wake);
        origin_ = std::chrono::steady_clock::now();
    }

    SimTime now() const override {
        const auto passed = std::chrono::steady_clock::now() - origin_;
        if (speed_ == 1) {
            return std::chrono::duration_cast<SimTime>(passed);
        }
        return SimTime{
            static_cast<SimTime::rep>(std::chrono::duration<double, std::micro>(passed).count() * speed_)};
    }

    void wake_at(SimTime when) override {
        // A timer that rings too early costs one turn of the loop; moving it costs a system call each time,
        // and most requests move the next thing due to and fro.
        if (when >= armed_) {
            return;
        }
        const double real_us = std::ceil(static_cast<double>(when.count()) / speed_);
        if (real_us > longest_wait_us) {
            return;
        }
        armed_ = when;
        timer_.expires_at(origin_ + std::chrono::microseconds(static_cast<std::int64_t>(real_us)));
        timer_.async_wait([this](const asio::error_code& error) {
            if (!error) {
                armed_ = never;
                on_wake_();
            }
        });
    }

    void run() override { context_.run(); }

  private:
    static constexpr double longest_wait_us = 3e15;  // 95 years

    asio::io_context& context_;
    asio::steady_timer timer_;
    double speed_;
    std::function<void()> on_wake_;
    std::chrono::steady_clock::time_point origin_;
    SimTime armed_ = never;
};

class JumpingClock final : public Clock {
  public:
    explicit JumpingClock(asio::io_context& context) : context_(context) {}

    void start(std::function<void()> on_wake) override { on_wake_ = std::move(on_wake); }
    SimTime now() const override { return now_; }
    void wake_at(SimTime when) override { wake_ = when; }

    void run() override {
        while (!context_.stopped()) {
            for (int i = 0; i < steps_per_poll && wake_ != never && !context_.stopped(); ++i) {
                now_ = std::max(now_, std::exchange(wake_, never));
                on_wake_();
            }
            if (context_.stopped()) {
                return;
            }
            if (wake_ == never) {
                context_.run_one();
            } else {
                context_.poll();
            }
        }
    }

  private:
    static constexpr int steps_per_poll = 64;

    asio::io_context& context_;
    std::function<void()> on_wake_;
    SimTime now_{0};
    SimTime wake_ = never;
};

}  // namespace

std::unique_ptr<Clock> make_clock(asio::io_context& context, Speed speed) {
    if (speed.max) {
        return std::make_unique<JumpingClock>(context);
    }
    return std::make_unique<RealClock>(context, speed.factor);
}

SimTime time_since_epoch() {
    return std::chrono::duration_cast<SimTime>(std::chrono::system_clock::now().time_since_epoch());
}

}  // namespace fauxboard::host
