#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "emulator/dlp/platform_config.h"
#include "emulator/dlp/ramp.h"
#include "emulator/dlp/settings.h"
#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

enum class SwitchState : std::uint8_t { works, never_closes, never_opens };

/// What goes wrong with it.
struct PlatformTrouble {
    SwitchState lower = SwitchState::works;
    SwitchState upper = SwitchState::works;
    double lost_share = 0;  ///< of each way, 0 to 1: the motor loses steps

    bool operator==(const PlatformTrouble&) const = default;
};

/// The motor's moves, one after the other, closed in time; the place that the board counts, and the place
/// where the platform really is.
class Platform {
  public:
    explicit Platform(const PlatformConfig& config) : config_(config), true_(config.start_mm) {}

    /// The board forgets the place and counts from 0; the platform stays where it is.
    void power_on();

    struct Move {
        double mm = 0;  ///< where to, as the board counts
        double mm_s = 1;
        double mm_s2 = 1;
    };
    /// Goes on from where the moves before end. False when too many wait. With switches on, a switch that
    /// closes ahead ends all moves.
    bool move(const Move& move, bool switches, SimTime now);
    /// Stands still where it is; the place is that.
    void stop(SimTime now);
    void advance(SimTime now);
    SimTime next_event() const { return busy() ? end_ : never; }

    bool busy() const { return count_ != 0; }
    double position(SimTime now) const { return from_ + way_at(now); }
    /// Over the lower switch.
    double true_position(SimTime now) const;
    /// Of the move under way at its best, mm/s; with its sign. 0 when it stands.
    double speed() const { return busy() ? direction_ * ramp_.top_speed() : 0; }
    /// Where the last move that waits ends.
    double target() const;
    /// From now on the board takes its place for this one.
    void call_it(double mm, SimTime now);
    bool lower_closed(SimTime now) const { return closed(trouble_.lower, true_position(now) <= touch_mm); }
    bool upper_closed(SimTime now) const {
        return closed(trouble_.upper, true_position(now) >= config_.travel_mm - touch_mm);
    }
    /// Takes effect on the move under way, too.
    void set_trouble(const PlatformTrouble& trouble, SimTime now);
    const PlatformTrouble& trouble() const { return trouble_; }

  private:
    static constexpr std::size_t most_moves = 64;
    static constexpr double touch_mm = 1e-5;  ///< a switch gives way so far
    static bool closed(SwitchState state, bool pressed) {
        return state == SwitchState::works ? pressed : state == SwitchState::never_opens;
    }
    double way_at(SimTime now) const { return busy() ? direction_ * ramp_.at(to_seconds(now - begin_)) : 0; }
    double true_way(double way) const;
    void begin(SimTime now);
    void find_end();
    void settle(double way);

    PlatformConfig config_;
    PlatformTrouble trouble_;
    std::array<Move, most_moves> moves_{};
    std::size_t head_ = 0;
    std::size_t count_ = 0;
    double from_ = 0;  ///< where the move under way began, as the board counts
    double true_;      ///< and really
    double direction_ = 1;
    Ramp ramp_;
    bool switches_ = false;
    bool hits_ = false;  ///< the move under way ends at a switch
    SimTime begin_{0};
    SimTime end_{0};
};

}  // namespace fauxboard::dlp
