#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/resin/config.h"
#include "emulator/resin/names.h"
#include "emulator/resin/resin_settings.h"

namespace fauxboard::resin {

/// The Z axis of a resin printer: a platform on a screw, with an end stop. Moves wait in a queue of fixed
/// size; each is closed in time (constant acceleration up and down), so that the place at any moment is
/// computed and nothing ticks.
///
/// Two coordinates: the height over the end stop, which is physical, and the place that the board shows,
/// which is 0 at power-on wherever the platform stands, and true after homing.
class ResinAxis {
  public:
    ResinAxis(const ResinConfig& config, const ResinSettings& settings)
        : config_(config), settings_(settings), height_(config.power_on_mm) {}

    /// The board forgets where the platform is, and shows 0.
    void power_on();

    /// What the board shows, mm.
    double position(SimTime now) const { return height(now) - zero_; }
    bool homed() const { return homed_; }
    /// It is to be, of what is under way or waits.
    bool homing() const;
    bool busy() const { return count_ != 0; }
    bool motors() const { return motors_; }
    bool relative = false;  ///< G91

    /// Goes to a place, or by a distance, as far as limits let it. `mm_min` 0 or less: at the starting speed.
    /// False when the queue is full.
    bool move(double mm, bool by, double mm_min, SimTime now);
    /// Runs to the end stop twice, fast and slowly, and from there to zero, if the settings say so; raises
    /// motion.homed. False when the queue is full.
    bool home(SimTime now);
    /// Up and down, `cycles` times (G29). False when the queue is full.
    bool stir(int cycles, SimTime now);
    /// Stands still where it is, and drops what waits.
    void abort(SimTime now);
    void motors_off(SimTime now);

    void advance(SimTime now, EventQueue& events);
    /// When the move under way ends; `never` when none is.
    SimTime next_event() const { return busy() ? end_ : never; }

  private:
    struct Step {
        enum class Kind : std::uint8_t { to, by, end_stop, zero, homed };
        Kind kind = Kind::to;
        double mm = 0;
        double mm_s = 0;
    };
    static constexpr std::size_t most_steps = 128;

    double height(SimTime now) const;
    bool push(const Step& step);
    void begin(SimTime now);
    double target(const Step& step) const;
    double top() const;

    const ResinConfig& config_;
    const ResinSettings& settings_;
    std::array<Step, most_steps> steps_{};
    std::size_t head_ = 0;
    std::size_t count_ = 0;
    double height_;     ///< where the step under way began; over the end stop
    double way_ = 0;    ///< of the step under way, up is positive
    double speed_ = 1;  ///< of the step under way, mm/s
    double zero_ = 0;   ///< height of what is shown as 0
    bool homed_ = false;
    bool motors_ = false;
    SimTime start_{0};
    SimTime end_{0};
};

}  // namespace fauxboard::resin
