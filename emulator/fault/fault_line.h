#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/fault/judge.h"
#include "emulator/fault/kind.h"
#include "emulator/fault/line_cutter.h"
#include "emulator/fault/pace_queue.h"
#include "emulator/fault/spec.h"

namespace fauxboard::fault {

/// Names a fault as long as it lives; never used again. 1 is the first.
using FaultId = std::uint64_t;

/// What a fault has just done.
struct Deed {
    FaultId fault = 0;
    Direction direction = Direction::to_screen;
    std::string_view kind;
    std::string_view line;  ///< as it was before, without its end; of many lines at once, the first
};

/// A fault and what it has done.
struct FaultStatus {
    /// In one direction.
    struct Counts {
        std::uint64_t seen = 0;
        std::uint64_t acted = 0;
        bool operator==(const Counts&) const = default;
    };
    FaultId id = 0;
    FaultSpec spec;
    std::uint64_t seen = 0;      ///< lines that concerned it, in all its directions
    std::uint64_t acted = 0;     ///< times it acted, in all its directions
    bool over = false;           ///< it will not act any more
    std::array<Counts, 2> by{};  ///< Direction::to_screen, Direction::to_board
};
Json status_to_json(const FaultStatus& status);

/// One direction of one line, with its faults. Bytes in, bytes out, time in; no clock, no I/O, no threads.
///
/// Bytes meet silence and disconnection as they come; then, line by line, the faults that change lines; then
/// those that delay; each in the order of their ids. Without a fault in force bytes are in output() at once,
/// also half lines. With one, a line waits for its end, but no longer than LineCutter::patience. The bytes
/// that come out depend on the bytes and times that go in, not on how they are chunked.
///
/// Use: push() when bytes come, advance() when the time it returned has come; take output() after each. Times
/// that go back are taken as the latest one.
class FaultLine {
  public:
    static constexpr std::size_t most_faults = 32;
    static constexpr std::size_t most_held = 64 * 1024;  ///< bytes; what comes while there is no room is lost
    /// Bytes that one line may grow by, all its copies together.
    static constexpr std::size_t most_growth = 64 * 1024;

    /// `peer` is the other direction of the same line, if there is one: while its disconnection lasts,
    /// nothing passes here either. It must outlive this.
    explicit FaultLine(Direction direction, const FaultLine* peer = nullptr)
        : direction_(direction), peer_(peer) {}
    FaultLine(const FaultLine&) = delete;
    FaultLine& operator=(const FaultLine&) = delete;

    /// Throws FaultSpecError when there are most_faults already. spec.direction is not looked at.
    FaultId add(SimTime now, const FaultSpec& spec);
    /// The same with an id of the caller's; a fault that has it is changed: it begins anew, counters too, in
    /// the same place. What the old one delayed goes on at once.
    void put(SimTime now, FaultId id, const FaultSpec& spec);
    /// False when there is none of that id.
    bool change(SimTime now, FaultId id, const FaultSpec& spec);
    /// What the fault delayed goes on at once. False when there is none of that id.
    bool remove(SimTime now, FaultId id);
    /// Removes all; what was held comes out.
    void clear(SimTime now);
    bool has(FaultId id) const { return find(id) != faults_.size(); }
    std::size_t size() const { return faults_.size(); }
    std::vector<FaultStatus> list(SimTime now) const;

    /// Told of each deed that concerns a line, from inside push() and advance(); it must not call back.
    void on_deed(std::function<void(const Deed&)> told) { told_ = std::move(told); }

    /// Bytes that arrive.
    void push(SimTime now, std::string_view bytes);
    /// Instead of push(), when neither direction has a fault: the owner passes the bytes on himself, without
    /// a copy; here only is remembered whether a line is under way.
    void passed(std::string_view bytes) {
        cutter_.passed(bytes);
        in_line_ = LineCutter::ends_in_line(bytes, in_line_);
    }
    /// Does what is due up to `now`. Returns when it next wants to be called, machine::never if not at all.
    SimTime advance(SimTime now);
    /// What has come through, since the last clear_output().
    std::string_view output() const { return output_; }
    void clear_output() { output_.clear(); }

    /// A disconnection of this direction lasts at that time.
    bool cuts_link(SimTime time) const;
    /// Bytes held back: in unfinished lines and delays.
    std::size_t held() const;
    /// Bytes lost to silence and disconnection.
    std::uint64_t bytes_lost() const { return bytes_lost_; }
    /// Bytes lost because too many were held.
    std::uint64_t bytes_overflowed() const { return bytes_overflowed_; }

  private:
    static constexpr SimTime latest = machine::never / 4;  ///< so that sums of times stay in range

    struct Fault {
        Fault(FaultId id, const FaultSpec& spec, Direction direction, SimTime now);
        FaultId id;
        FaultSpec spec;
        Judge judge;
        bool acting = false;  ///< on the line that comes by
        Pace pace;            ///< of that line
        PaceQueue queue;
        Interruption interruption;
        SimTime dead_from{machine::never};  ///< the latest interruption
        SimTime dead_until{0};
        bool announced = false;  ///< an interruption by time alone that is still to come
    };
    std::size_t find(FaultId id) const;
    void insert(SimTime now, FaultId id, const FaultSpec& spec);
    void drain(std::size_t index);
    void flush_if_idle();
    bool shapes_lines() const;
    SimTime later(SimTime now) const { return std::clamp(now, now_, latest); }
    bool link_up() const { return !cuts_link(now_) && (peer_ == nullptr || !peer_->cuts_link(now_)); }
    SimTime next_work() const;
    void work();
    bool dead(const Fault& fault) const { return now_ >= fault.dead_from && now_ < fault.dead_until; }
    std::size_t admitted(std::string_view bytes, Fault*& begins);
    Fault* interrupted_by_line();
    void pass(std::string_view bytes);
    void edit_from(std::size_t index, Piece piece);
    void pace_from(std::size_t index, Piece piece);
    void leave(std::string_view bytes);
    void tell(const Fault& fault, std::string_view bytes) const;

    Direction direction_;
    const FaultLine* peer_;
    std::function<void(const Deed&)> told_;
    std::vector<Fault> faults_;  ///< by id
    LineCutter cutter_;
    std::string output_;
    SimTime now_{0};
    FaultId last_id_ = 0;
    std::size_t room_ = 0;  ///< what is left of most_growth for the line at hand
    bool in_line_ = false;  ///< in the stream as it arrives
    std::uint64_t bytes_lost_ = 0;
    std::uint64_t bytes_overflowed_ = 0;
};

}  // namespace fauxboard::fault
