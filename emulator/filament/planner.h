#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/filament/config.h"
#include "emulator/filament/names.h"
#include "emulator/filament/state.h"

namespace fauxboard::filament {

/// The look-ahead planner of Marlin 1.x, from which the Smartto firmware descends: moves wait in a ring of
/// blocks; how fast one may pass into the next is bounded by the jerk of each axis, by what can still be
/// braked within the blocks that follow, and by standstill behind the last one. A block runs as a trapezoid
/// of constant acceleration, so its end is known in closed form when it starts; nothing ticks.
///
/// Unlike Marlin's, the pass forwards is not made again for each block: the speed at which a block ends is
/// settled when it starts, from the speed it starts with and what the next block can take then.
class Planner {
  public:
    static constexpr std::size_t capacity = 64;
    /// Marlin leaves out moves of fewer steps than this on every axis; their way is not lost, it is part of
    /// the next move's.
    static constexpr double min_steps = 6;

    /// Of a move that is not of the job: of a host, or of the job before.
    static constexpr std::uint64_t no_byte = ~std::uint64_t{0};

    /// One straight move as its line asks for it.
    struct Move {
        AxisValues from{};    ///< mm; looked at only when nothing waits, else the last block's end counts
        AxisValues target{};  ///< mm
        double feed_mm_s = 0;
        std::uint64_t byte = no_byte;  ///< where its line begins in the job's file: what to do again
    };

    explicit Planner(const Settings& settings) : settings_(&settings) {}

    void clear();
    bool empty() const { return count_ == 0; }
    std::size_t size() const { return count_; }
    /// Blocks that may be in the ring, the one being executed included.
    void set_blocks(std::size_t blocks) { blocks_ = blocks < 2 ? 2 : blocks > capacity ? capacity : blocks; }
    bool full() const { return count_ >= blocks_; }

    /// Adds a move. False, and nothing done, when it is too short to be one (see min_steps). Must not be
    /// full().
    bool add(const Move& move);

    /// Starts the first block, if it is not under way, at `now`.
    void start(SimTime now);
    bool running() const { return end_ != never; }
    /// When the block under way ends; `never` when none is.
    SimTime end() const { return end_; }
    /// Takes the block under way out, at its end(). The next one is not started: first more may be added.
    void finish();

    /// Of the block under way or next; must not be empty().
    const AxisValues& target() const { return blocks_ring_[head_].target; }
    double feed_mm_s() const { return blocks_ring_[head_].nominal; }
    /// Where the job's first move that has not been made to its end begins in its file; `otherwise` when all
    /// that waits is of others.
    std::uint64_t byte(std::uint64_t otherwise) const;
    /// What waits is of no job any more.
    void disown();
    /// G92 while blocks wait: their targets are in the old coordinates.
    void shift(std::size_t axis, double mm);

  private:
    struct Block {
        AxisValues target{};
        double length = 0;        ///< mm; of the extruder alone when nothing else moves
        double nominal = 0;       ///< mm/s along the way
        double acceleration = 0;  ///< mm/s^2 along the way
        double entry_sq = 0;     ///< highest speed at its start from which all behind it can be done, squared
        double junction_sq = 0;  ///< what the jerk allows at its start, squared
        std::uint64_t byte = no_byte;
    };

    const Block& at(std::size_t i) const {
        const std::size_t place = head_ + i;
        return blocks_ring_[place < capacity ? place : place - capacity];
    }
    Block& at(std::size_t i) {
        const std::size_t place = head_ + i;
        return blocks_ring_[place < capacity ? place : place - capacity];
    }
    double junction(const AxisValues& speed, double nominal) const;
    void brake_backwards();

    const Settings* settings_;
    std::array<Block, capacity> blocks_ring_{};
    std::size_t head_ = 0;
    std::size_t count_ = 0;
    std::size_t blocks_ = 16;
    SimTime end_ = never;
    static constexpr double at_rest = -1;
    double start_speed_ = at_rest;  ///< of the first block: where the last one left off
    double end_speed_ = 0;          ///< of the block under way
    double rest_us_ = 0;  ///< part of a microsecond that the blocks so far ran longer than the clock shows
    // Of the block added last:
    AxisValues last_speed_{};
    double last_nominal_ = 0;
    double last_safe_ = 0;
};

/// Seconds for `length` mm from speed `from` to speed `to` at `acceleration` both ways, `nominal` at most.
double trapezoid_seconds(double length, double from, double nominal, double to, double acceleration);

}  // namespace fauxboard::filament
