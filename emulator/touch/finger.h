#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "emulator/screen/display.h"

namespace fauxboard::touch {

using machine::SimTime;

/// One contact with the glass.
struct Contact {
    int x = 0;
    int y = 0;
    SimTime from{0};
    SimTime until{0};
};

/// Fingers as the board's program feels them: it looks at the sensor on its tick, takes so many ticks with
/// contact for a press and the first without for the release; the page hears of it when it next looks.
/// Contacts follow one another; there is one finger. Source: the firmware's timing, in screen::Finger.
class Finger {
  public:
    enum class Felt : std::uint8_t { nothing, press, held, release };
    /// More contacts than that do not wait; touch() then says so.
    static constexpr std::size_t most_waiting = 64;

    explicit Finger(const screen::Finger& timing) : timing_(timing) {}

    /// The program starts: it has felt nothing, but a finger that is down stays down.
    void power_on(SimTime now);
    /// Puts a finger on the glass for `how_long`, now or when the one before has been taken off. Returns when
    /// all of it has been felt and looked at; nothing when too many wait.
    std::optional<SimTime> touch(SimTime now, int x, int y, SimTime how_long);
    /// What is on the glass.
    std::optional<Contact> contact(SimTime now) const;

    SimTime next_due() const;
    /// Goes on to the next thing due, at next_due().
    Felt advance(SimTime now);
    /// The contact that was felt.
    const Contact& felt() const { return felt_; }
    /// How long it has lasted, or did.
    SimTime lasted(SimTime now) const;
    /// So long after the press that nothing comes of the release.
    bool long_press() const { return ticks_ >= timing_.press_ticks + timing_.long_ticks; }

  private:
    SimTime after(SimTime at, SimTime period) const;
    Felt look();
    void tick(SimTime now);

    const screen::Finger& timing_;
    std::deque<Contact> waiting_;
    Contact felt_;
    SimTime power_on_{0};
    SimTime next_tick_{machine::never};
    SimTime next_look_{machine::never};
    unsigned ticks_ = 0;  ///< with contact, in a row
    bool fresh_ = true;   ///< the next tick with contact is the first of it
    bool pressed_ = false;
    bool press_due_ = false;    ///< to be told at the next look
    bool release_due_ = false;  ///< same, after the press
};

}  // namespace fauxboard::touch
