#pragma once

#include <cstddef>
#include <deque>

#include "emulator/fault/kind.h"
#include "emulator/fault/line_cutter.h"

namespace fauxboard::fault {

/// Bytes on their way through a delay or a slow stretch, in order. When a piece comes out depends on the
/// times the pieces came, never on when somebody asked.
class PaceQueue {
  public:
    /// Slow bytes come out in portions of so much time, or one by one where they are slower than that.
    static constexpr SimTime portion{5'000};

    void put(Piece piece, const Pace& pace);
    /// When the next portion is to come out; never, when empty.
    SimTime due() const;
    /// The next portion, with its time. Not when empty.
    Piece take();
    /// What is left of the oldest piece, whether due or not. Not when empty.
    Piece take_rest();
    std::size_t held() const { return held_; }
    bool empty() const { return waiting_.empty(); }

  private:
    struct Waiting {
        Piece piece;
        SimTime start{0};
        double bytes_per_s = 0;
        std::size_t done = 0;
    };
    static std::size_t portion_end(const Waiting& item);
    Piece take_to(std::size_t end, SimTime time);

    std::deque<Waiting> waiting_;
    SimTime free_{0};  ///< when all that is queued will be out
    std::size_t held_ = 0;
};

}  // namespace fauxboard::fault
