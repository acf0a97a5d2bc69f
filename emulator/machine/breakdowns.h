#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "emulator/machine/events.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

class Printer;

/// What can go wrong with a machine. Order and number are private; the names in breakdowns() are the
/// contract.
enum class BreakdownId : std::uint8_t {
    filament_out,
    jam,
    card_removed,
    card_failed,
    file_missing,
    file_unreadable,
    thermistor_open,
    thermistor_short,
    heater_dead,
    thermal_runaway,
    too_hot,
    probe_alarm,
    endstop_dead,
    cold_extrusion,
    refused,
    pid_question,
    wait_for_user,
    motor_off,
    hang,
    board_reset,
    brown_out,
    chunk_lost,
    chunk_damaged,
    chunk_repeated,
    count_  // not a breakdown
};

inline constexpr std::size_t breakdown_count = static_cast<std::size_t>(BreakdownId::count_);

enum class BreakdownUnit : std::uint8_t { choice, percent, celsius };

/// One number or word that says more about a breakdown. A choice is the index of its word.
struct BreakdownParameter {
    std::string_view name;
    BreakdownUnit unit;
    double fallback;
    double min;
    double max;
    std::string_view help;
    std::span<const std::string_view> choices{};
};

/// Values of the parameters, in the order of the row; the rest is 0.
using BreakdownValues = std::array<double, 2>;

/// One kind of breakdown, declared once: the machine, the command line, the control channel, scenarios and
/// the reference all read this row.
struct BreakdownInfo {
    BreakdownId id;
    std::string_view name;
    std::string_view help;  ///< what breaks, and what that does to the machine
    std::span<const EventId>
        events;             ///< raised when the board notices; none: only its values show it, if at all
    std::string_view back;  ///< what ends it, apart from taking it away; may be empty
    std::span<const BreakdownParameter> parameters;
    SimTime length;  ///< how long it lasts when nobody says; `never`: until it is taken away
    void (*begin)(Printer&, const BreakdownValues&);
    void (*end)(Printer&, const BreakdownValues&);         ///< null: it is over as soon as it has happened
    bool (*gone)(const Printer&, const BreakdownValues&);  ///< over without end(): somebody saw to it; may be
                                                           ///< null
};

/// Every kind, in the order of BreakdownId.
std::span<const BreakdownInfo> breakdowns();
/// The kind of that name, or null.
const BreakdownInfo* find_breakdown(std::string_view name);

/// A breakdown as somebody asks for it. Times are virtual.
struct BreakdownRequest {
    const BreakdownInfo* info = nullptr;
    BreakdownValues values{};
    std::optional<SimTime> begin;   ///< not before; at once when left out or past
    std::optional<SimTime> end;     ///< over then; or else
    std::optional<SimTime> length;  ///< so long after it began
};

/// The request for a kind with all parameters at their defaults.
BreakdownRequest default_request(const BreakdownInfo& info);

enum class BreakdownState : std::uint8_t { waiting, active, over };
std::string_view state_name(BreakdownState state);

struct Breakdown {
    unsigned number = 0;
    BreakdownRequest request;
    BreakdownState state = BreakdownState::waiting;
    SimTime begin{0};
    SimTime end = never;
};

/// What is, was or will be broken at one machine. Of one kind and part (heater, axis, disk) there is one at a
/// time: a newer one takes the older one's place. Bounded; what is over makes room.
///
/// What is physical outlives a reset of the board; what is only in its memory does not.
class Breakdowns {
  public:
    static constexpr std::size_t most = 64;

    explicit Breakdowns(Printer& printer) : printer_(printer) {}

    /// Notes it; the machine's next advance() begins it. Returns its number, from 1; 0 when there is no room.
    unsigned add(SimTime now, const BreakdownRequest& request);
    /// Ends it, if it is in force, and forgets it. False when there is none of that number.
    bool remove(unsigned number);
    /// The same for all of one kind; returns how many there were.
    std::size_t remove(BreakdownId id);
    void clear();

    /// By number, those that are over included.
    std::span<const Breakdown> list() const { return list_; }
    bool active(BreakdownId id) const { return (active_ >> static_cast<unsigned>(id) & 1U) != 0; }

    /// Begins and ends what is due.
    void advance(SimTime now);
    SimTime next_event() const { return next_; }

  private:
    void start(Breakdown& breakdown, SimTime now);
    void stop(Breakdown& breakdown);
    void refresh();

    Printer& printer_;
    std::vector<Breakdown> list_;
    unsigned last_ = 0;
    std::uint32_t active_ = 0;  ///< bits by BreakdownId
    SimTime next_ = never;
};
static_assert(breakdown_count <= 32, "Breakdowns keeps a bit for each");

}  // namespace fauxboard::machine
