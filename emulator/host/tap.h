#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "emulator/host/clock.h"
#include "emulator/host/tap_delay.h"
#include "emulator/link/link.h"

namespace fauxboard::host {

/// The two ends of a tapped line, as they were named by the user.
enum class TapSide : std::uint8_t { a, b };

constexpr TapSide other(TapSide side) {
    return side == TapSide::a ? TapSide::b : TapSide::a;
}

/// Told what passes, after it has been passed on. Must not call back into the tap.
class TapObserver {
  public:
    virtual ~TapObserver() = default;
    /// `now` is when the bytes had been read.
    virtual void on_passed(SimTime now, TapSide from, std::string_view bytes) = 0;
    virtual void on_link(SimTime now, TapSide side, link::LinkState state, std::string_view why) = 0;
};

/// Passes bytes on between two links, untouched and at once: what was read is written before anything else is
/// done. An end that takes bytes more slowly than they come holds up the one that sends them, so that nothing
/// is lost; only what is said while the other end is away is, as on a wire. The links count that.
class Tap {
  public:
    /// All must outlive this object; the clock has been started.
    Tap(link::Link& a, link::Link& b, Clock& clock, TapObserver& observer);
    ~Tap() { close(); }
    Tap(const Tap&) = delete;
    Tap& operator=(const Tap&) = delete;

    /// Opens both ends. Throws LinkError, with both closed.
    void open();
    /// Idempotent.
    void close();

    const TapDelay& delay() const { return delay_; }
    const link::LinkStats& stats(TapSide side) const { return end(side).link.stats(); }

  private:
    struct End final : link::LinkListener {
        End(Tap& owner, TapSide which, link::Link& line) : tap(owner), side(which), link(line) {}
        void on_bytes(std::string_view bytes) override { tap.pass(*this, bytes); }
        void on_state(link::LinkState state, std::string_view why) override {
            tap.changed(*this, state, why);
        }
        void on_drained() override { tap.drained(*this); }

        Tap& tap;
        TapSide side;
        link::Link& link;
        std::optional<SimTime>
            waiting_since;  ///< when the oldest bytes were read that wait to be written here
    };

    void pass(End& from, std::string_view bytes);
    void drained(End& to);
    void changed(End& at, link::LinkState state, std::string_view why);
    void hold_or_go_on(End& from);
    End& end(TapSide side) { return side == TapSide::a ? a_ : b_; }
    const End& end(TapSide side) const { return side == TapSide::a ? a_ : b_; }

    Clock& clock_;
    TapObserver& observer_;
    TapDelay delay_;
    End a_;
    End b_;
};

}  // namespace fauxboard::host
