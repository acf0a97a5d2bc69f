#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/fault/faults.h"

namespace fauxboard::fault {

inline SimTime ms(std::int64_t n) {
    return SimTime{n * 1000};
}

/// `n` framed lines, "N-0 L1 X0*..", "N-0 L1 X1*..", ...
std::string frames(std::size_t n);

/// One direction in virtual time, with all that came out.
class LineRig {
  public:
    explicit LineRig(Direction direction = Direction::to_screen) : line(direction) {}
    FaultId add(std::string_view spec) { return line.add(now, fault_from_text(spec)); }
    /// Pushes in chunks of so many bytes, without letting time pass; gives what came out.
    std::string push(std::string_view bytes, std::size_t chunk = std::string_view::npos);
    /// Lets time pass, stopping whenever the line asks for it; gives what came out.
    std::string pass(SimTime time);
    FaultStatus status() const { return line.list(now).at(0); }

    FaultLine line;
    SimTime now{0};

  private:
    std::string take();
};

/// What a spec makes of `bytes`, pushed at once, with all the time that it takes to come out.
std::string spoiled(std::string_view spec, std::string_view bytes, Direction direction = Direction::to_screen,
                    std::size_t chunk = std::string_view::npos);

/// Holds for every kind, in both directions: the fault is seen to act on frames; the same seed gives the same
/// bytes, however the stream is chunked; with count=2 it acts twice and then everything passes; with a time
/// to live it ends then; cleared in the midst of its work it lets everything pass. `own` is the kind with
/// attributes of its own. The kind changes bytes, but not when they come.
void check_edits(std::string_view own);
/// The same for a kind that delays: no byte is lost or changed.
void check_paces(std::string_view own);
/// The same for a kind that makes the line dead.
void check_interrupts(std::string_view kind);

}  // namespace fauxboard::fault
