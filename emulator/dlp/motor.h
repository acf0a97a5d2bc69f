#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "emulator/dlp/settings.h"
#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

enum class MotorState : std::uint8_t { off, hold, run };
constexpr std::string_view to_string(MotorState state) {
    constexpr std::array<std::string_view, 3> names{"off", "hold", "run"};
    return names[static_cast<std::size_t>(state)];
}

/// Current of the motor: full while something moves or is printed, then less, then none.
class Motor {
  public:
    void power_on() {
        state_ = MotorState::off;
        hold_due_ = off_due_ = never;
        runs_ = false;
    }
    /// Told whenever it may have changed whether the platform is in use.
    void follow(bool in_use, const MotorSettings& settings, SimTime now) {
        if (in_use) {
            state_ = MotorState::run;
            hold_due_ = off_due_ = never;
        } else if (runs_) {
            hold_due_ = settings.hold_time_ms == 0 ? never : now + ms(settings.hold_time_ms);
            off_due_ = settings.off_time_ms == 0 ? never : now + ms(settings.off_time_ms);
        }
        runs_ = in_use;
    }
    /// True when it has just lost its current.
    bool advance(SimTime now) {
        if (hold_due_ <= now) {
            hold_due_ = never;
            state_ = MotorState::hold;
        }
        if (off_due_ > now) {
            return false;
        }
        off_due_ = never;
        state_ = MotorState::off;
        return true;
    }
    SimTime next_event() const { return std::min(hold_due_, off_due_); }
    MotorState state() const { return state_; }
    double current_ma(const MotorSettings& settings) const {
        return state_ == MotorState::off    ? 0
               : state_ == MotorState::hold ? static_cast<double>(settings.current_hold_vref)
                                            : static_cast<double>(settings.current_vref);
    }

  private:
    MotorState state_ = MotorState::off;
    SimTime hold_due_ = never;
    SimTime off_due_ = never;
    bool runs_ = false;
};

}  // namespace fauxboard::dlp
