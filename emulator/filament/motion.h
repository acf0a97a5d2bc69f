#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "emulator/filament/config.h"
#include "emulator/filament/names.h"
#include "emulator/filament/planner.h"
#include "emulator/filament/probe_series.h"
#include "emulator/filament/state.h"
#include "emulator/filament/travel.h"

namespace fauxboard::filament {

/// A G0/G1 as it stands on the line.
struct MoveRequest {
    AxisTargets values{};               ///< mm, absolute or relative as G90/G91 say
    std::optional<double> feed_mm_min;  ///< F; stays in force for later moves
    bool feed_passes = false;           ///< it does not
    bool force_relative = false;        ///< move by `values` whatever G90/G91 say
    bool limits = true;                 ///< keep inside the build volume (software end stops)
};

/// What is wrong with motors and switches. Physical: it outlives a reset.
struct MotionFaults {
    std::array<bool, 3> dead_endstops{};  ///< X, Y, Z: never trigger; Z is the probe's
    bool dead_motors = false;             ///< no current: nothing moves, whatever the board believes
    bool probe_alarm = false;             ///< the probe is stuck, and says so
};

enum class MoveOutcome : std::uint8_t { accepted, clamped, queue_full };

/// Moves, homing and probing in closed form: every step knows its end when it starts, nothing ticks in
/// between. Single moves and procedures wait in a queue and go from rest to rest; the moves of a job stream
/// through the Planner, which looks ahead. The two never run at once: what was asked for first comes first.
///
/// What a board of this family reports is the destination of the last move *accepted into the planner*, and
/// the feed of the move being *executed*; so the position runs ahead of the feed by the planner's buffer.
class Motion {
  public:
    Motion(const MotionConfig& config, const Settings& settings, std::uint64_t seed = 0);

    /// The board forgets where it is; the head stays where it stands.
    void power_on();

    /// Carries out everything that ends at or before `now`.
    void advance(SimTime now, EventQueue& events);
    /// When the step or block under way ends; `never` when idle.
    SimTime next_event() const {
        return planner_.running() ? planner_.end() : count_ != 0 ? step_end_ : never;
    }

    MoveOutcome move(const MoveRequest& request, SimTime now, EventQueue& events);
    /// Queues a procedure. False when the queue has no room for it; then nothing is queued.
    bool run(const Procedure& procedure, SimTime now, EventQueue& events);
    /// Drops what is queued and stops the step under way where it stands.
    void abort();

    /// Whether stream() may be called: the queue is empty and the planner has room.
    bool can_stream() const { return count_ == 0 && !planner_.full(); }
    /// A move of a job, absolute, kept inside the build volume. `byte` is where its line begins in the file.
    void stream(const AxisValues& target, double feed_mm_s, std::uint64_t byte);
    /// Starts the planner's next block, if none is under way: after stream(), and after advance() to a
    /// block's end.
    void start_stream(SimTime now);
    /// Where in its file the job's move under way begins; `otherwise` when no move of the job waits.
    std::uint64_t streamed_byte(std::uint64_t otherwise) const { return planner_.byte(otherwise); }
    /// A job begins, or goes on elsewhere in its file: the moves that wait are none of its.
    void disown_streamed() { planner_.disown(); }

    /// Moves that the planner takes, one block always kept as Marlin does.
    std::size_t planner_free() const {
        const std::size_t most = config_.planner_blocks > 0 ? config_.planner_blocks - 1 : 0;
        return most - std::min(most, planner_.size());
    }

    void set_relative(bool relative) { relative_ = relative; }
    bool relative() const { return relative_; }
    /// M82, M83: E alone; G91 makes it relative as well.
    void set_relative_e(bool relative) { relative_e_ = relative; }
    bool relative_e() const { return relative_ || relative_e_; }
    bool relative_e_alone() const { return relative_e_; }
    void set_position(const AxisTargets& values);  // G92
    void set_motors(bool on);
    bool motors() const { return motors_ && !faults_.dead_motors; }
    MotionFaults& faults() { return faults_; }
    /// Told of each move of a job in the plane when it has been done, from inside advance(); must not call
    /// back.
    void on_travel(std::function<void(const Travel&)> told) { travelled_ = std::move(told); }
    /// Filament that the extruder was turned for since the machine was made, mm.
    double extruded_mm() const { return extruded_; }
    bool homed() const { return (homed_ & 7U) == 7U; }
    /// The axes are being run into their end stops.
    bool homing() const {
        return step_end_ != never && count_ != 0 && ring_[head_].what.kind == ProcedureStep::Kind::home;
    }
    bool busy() const { return count_ != 0 || !planner_.empty(); }
    /// End of everything asked for, mm.
    const AxisValues& planned() const { return planned_; }
    /// Where the move under way began, or where the head stands, mm.
    const AxisValues& executed() const { return executed_; }
    /// Destination of the last accepted move, mm.
    double position(Axis axis) const { return accepted_[static_cast<std::size_t>(axis)]; }
    /// Feed of the move being executed, mm/s; keeps its last value when idle.
    double feed_mm_s() const { return shown_feed_; }
    void show_feed(double feed_mm_s) { shown_feed_ = feed_mm_s; }
    double babystep_mm() const { return babystep_; }
    void set_babystep(double mm) { babystep_ = mm; }
    int speed_percent() const { return speed_percent_; }
    void set_speed_percent(int percent) { speed_percent_ = percent; }
    int flow_percent() const { return flow_percent_; }
    void set_flow_percent(int percent) { flow_percent_ = percent; }
    /// What was measured of the bed: heights at 3 x 3 points, X first, from the front; kept in the EEPROM.
    struct Mesh {
        bool valid = false;
        std::array<double, 9> mm{};
    };
    Mesh mesh;
    /// The point that was probed last: where the probe touched, and the height it found there, mm.
    const std::array<double, 3>& probed_mm() const { return probed_; }
    ProbeSeries series;  ///< the touches of M48
    /// Rounds that the schedule is to leave out; asking takes them.
    int take_lost_rounds();

  private:
    struct Step {
        ProcedureStep what;
        AxisValues target{};    ///< where it ends, mm
        bool buffered = false;  ///< a plain move: the planner takes it ahead of its turn
        bool accepted = false;
    };
    static constexpr std::size_t capacity = 64;

    Step& at(std::size_t i) { return ring_[(head_ + i) % capacity]; }
    void enqueue(const ProcedureStep& step, bool buffered);
    void accept_ahead();
    void begin(SimTime now, EventQueue& events);
    void finish(EventQueue& events);
    void note_probed(const Step& step, EventQueue& events);
    /// Whether the step under way ends without its switch having triggered; then all is dropped.
    bool fails(const Step& step, EventQueue& events);
    bool dead_endstop(std::size_t axis) const { return faults_.dead_motors || faults_.dead_endstops[axis]; }
    double duration_s(const Step& step) const;
    double homing_s(const ProcedureStep& step) const;
    void tell_travel(const AxisValues& to) const;
    double bed_height_mm(double x, double y) const;

    const MotionConfig& config_;
    const Settings& settings_;
    Planner planner_;
    std::array<Step, capacity> ring_{};
    std::size_t head_ = 0;
    std::size_t count_ = 0;
    SimTime step_end_ = never;
    AxisValues planned_{};            ///< end of everything queued
    AxisValues accepted_{};           ///< what L1 shows
    AxisValues executed_{};           ///< where the head is, between steps
    std::array<double, 3> offset_{};  ///< head minus logical position: unknown to the board until homed
    double modal_feed_;
    double shown_feed_ = 0;
    double babystep_ = 0;
    int speed_percent_ = 100;
    int flow_percent_ = 100;
    int lost_rounds_ = 0;
    std::uint8_t homed_ = 0;
    bool relative_ = false;
    bool relative_e_ = false;
    bool motors_ = false;
    MotionFaults faults_;
    std::function<void(const Travel&)> travelled_;
    double extruded_ = 0;
    std::array<double, 3> probed_{};
};

}  // namespace fauxboard::filament
