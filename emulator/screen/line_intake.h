#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/machine/sim_time.h"

namespace fauxboard::screen {

using machine::SimTime;

/// A line as it came out of the ring. The view lives until the callback returns.
struct IntakeLine {
    std::string_view text;   ///< may hold a NUL
    bool lost = false;       ///< it filled the room for a line before its end came: nothing is made of it
    std::uint64_t came = 0;  ///< bytes that had come when it was whole; see LineIntake::came()
};

/// The receiving end of a screen's UART: bytes arrive one after the other, as fast as the line carries them,
/// in a ring that is looked into on the first tick after the line fell silent or the ring was full. What
/// comes while it is full is lost. CR (unless told otherwise) or LF ends a line, empty ones are skipped, half
/// a line waits for ever. Memory is bounded.
class LineIntake {
  public:
    /// Bytes the ring holds, what a byte takes on the line (0: nothing), and how often it is looked into.
    LineIntake(std::size_t room, SimTime byte_time, SimTime tick, bool lf_only)
        : room_(room), byte_time_(byte_time), tick_(tick), lf_only_(lf_only) {}

    /// Everything is gone; ticks are counted from now.
    void start(SimTime now) {
        wire_.clear();
        ring_.clear();
        partial_.clear();
        lost_ = 0;
        asked_ = machine::never;
        origin_ = now;
        ++life_;
    }

    /// Bytes of the other end, which follow those still on the line. Times never go back.
    void receive(SimTime now, std::string_view bytes) {
        settle(now);
        if (wire_.empty()) {
            wire_start_ = std::max(wire_start_, now);
        }
        const std::size_t fits = std::min(bytes.size(), most_on_wire - wire_.size());
        wire_.append(bytes.substr(0, fits));
        lost_ += bytes.size() - fits;
    }

    /// When it will be looked into, as far as is known now; never while nothing is there.
    SimTime next_look() const {
        if (wire_.empty() && ring_.empty()) {
            return machine::never;
        }
        const SimTime asked = asked_ != machine::never ? asked_ : next_ask();
        return origin_ + ((asked - origin_) / tick_ + 1) * tick_;
    }

    /// So many bytes may come now and be sure not to be lost.
    std::size_t room() const { return room_ - std::min(room_, ring_.size() + wire_.size()); }
    /// Bytes that have come so far, without those that were lost.
    std::uint64_t came() const { return came_ + (byte_time_ == SimTime{0} ? wire_.size() : 0); }
    /// When the last byte of those that were taken out arrived.
    SimTime arrived() const { return arrived_; }

    /// Takes out what has arrived; calls on_line(IntakeLine) for each line that is complete. Returns how many
    /// bytes were lost since the last time. on_line may call start().
    template <class F>
    std::size_t drain(SimTime now, F&& on_line) {
        settle(now);
        std::string bytes;
        bytes.swap(ring_);
        const std::size_t lost = lost_;
        lost_ = 0;
        asked_ = machine::never;
        const std::uint64_t life = life_;
        std::uint64_t at = came_ - bytes.size();
        for (const char c : bytes) {
            ++at;
            const bool end = c == '\n' || (c == '\r' && !lf_only_);
            if (!end) {
                partial_ += c;
            }
            const bool full = partial_.size() == room_;
            if (full || (end && !partial_.empty())) {
                std::string text;
                text.swap(partial_);
                on_line(IntakeLine{text, full, at});
                if (life != life_) return lost;
            }
        }
        return lost;
    }

  private:
    static constexpr std::size_t most_on_wire = 64UL * 1024;

    /// Moves what has arrived by now from the line into the ring.
    void settle(SimTime now) {
        const std::size_t come =
            byte_time_ == SimTime{0}
                ? wire_.size()
                : std::min(wire_.size(), static_cast<std::size_t>(
                                             std::max(SimTime::rep{0}, (now - wire_start_) / byte_time_)));
        const std::size_t fits = std::min(come, room_ - ring_.size());
        ring_.append(wire_, 0, fits);
        came_ += fits;
        if (come != 0 && ring_.size() == room_) {
            ask(wire_start_ + static_cast<SimTime::rep>(fits) * byte_time_);
        }
        lost_ += come - fits;
        wire_.erase(0, come);
        wire_start_ += static_cast<SimTime::rep>(come) * byte_time_;
        if (come != 0) {
            arrived_ = wire_start_;
        }
        if (wire_.empty() && !ring_.empty() && now >= wire_start_ + byte_time_) {
            ask(wire_start_ + byte_time_);
        }
    }
    void ask(SimTime at) { asked_ = std::min(asked_, at); }
    /// When the ring will be full or the line silent, if nothing more comes.
    SimTime next_ask() const {
        const std::size_t free = room_ - ring_.size();
        const std::size_t bytes = wire_.size() >= free ? free : wire_.size() + 1;
        return wire_start_ + static_cast<SimTime::rep>(bytes) * byte_time_;
    }

    std::size_t room_;
    SimTime byte_time_;
    SimTime tick_;
    bool lf_only_;
    SimTime origin_{0};
    std::string wire_;       ///< sent, and not here yet
    SimTime wire_start_{0};  ///< when its first byte began, or the last one ended
    std::string ring_;
    std::string partial_;
    SimTime asked_ = machine::never;  ///< when a look was called for
    SimTime arrived_{0};
    std::size_t lost_ = 0;
    std::uint64_t life_ = 0;
    std::uint64_t came_ = 0;
};

}  // namespace fauxboard::screen
