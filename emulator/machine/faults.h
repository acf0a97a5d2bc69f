#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/machine/events.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

class Machine;
struct Kind;

enum class FaultUnit : std::uint8_t { choice, number, percent, celsius };

/// One number or word that says more about a fault. A choice is the index of its word.
struct FaultParameter {
    std::string_view name;
    FaultUnit unit;
    double fallback;
    double min;
    double max;
    std::string_view help;
    std::span<const std::string_view> choices{};
};

/// Values of the parameters, in the order of the row; the rest is 0.
using FaultValues = std::array<double, 2>;

/// One sort of fault, declared once: the machine, the command line, the control channel, scenarios and the
/// reference all read this row. Its address tells it from others.
struct FaultInfo {
    std::string_view name;
    std::string_view help;  ///< what breaks, and what that does to the machine
    std::span<const EventId>
        events;             ///< raised when the board notices; none: only its values show it, if at all
    std::string_view back;  ///< what ends it, apart from taking it away; may be empty
    std::span<const FaultParameter> parameters;
    SimTime length;  ///< how long it lasts when nobody says; `never`: until it is taken away
    void (*begin)(Machine&, const FaultValues&);
    void (*end)(Machine&, const FaultValues&);  ///< null: it is over as soon as it has happened
    bool (*gone)(const Machine&,
                 const FaultValues&);  ///< over without end(): somebody saw to it; may be null
};

/// Every sort, those of all machines first, then each kind's. Names are unique among all of them.
std::span<const FaultInfo* const> fault_rows();
/// The sort of that name, of whatever kind, or null.
const FaultInfo* find_fault(std::string_view name);
/// Whether a machine of the kind can have it.
bool has_fault(const Kind& kind, const FaultInfo& info);
/// The sorts that every machine can have.
std::span<const FaultInfo> common_faults();
/// Those of a kind that can have no others.
constexpr std::span<const FaultInfo> no_faults() {
    return {};
}

/// A fault as somebody asks for it. Times are virtual.
struct FaultRequest {
    const FaultInfo* info = nullptr;
    FaultValues values{};
    std::optional<SimTime> begin;   ///< not before; at once when left out or past
    std::optional<SimTime> end;     ///< over then; or else
    std::optional<SimTime> length;  ///< so long after it began
};

/// The request for a kind with all parameters at their defaults.
FaultRequest default_request(const FaultInfo& info);

enum class FaultState : std::uint8_t { waiting, active, over };
std::string_view state_name(FaultState state);

struct Fault {
    unsigned number = 0;
    FaultRequest request;
    FaultState state = FaultState::waiting;
    SimTime begin{0};
    SimTime end = never;
};

/// What is, was or will be broken at one machine. Of one sort and part (heater, axis, disk) there is one at a
/// time: a newer one takes the older one's place. Bounded; what is over makes room.
///
/// What is physical outlives a reset of the board; what is only in its memory does not.
class Faults {
  public:
    static constexpr std::size_t most = 64;

    explicit Faults(Machine& machine) : machine_(machine) {}

    /// Notes it; the machine's next advance() begins it. Returns its number, from 1; 0 when there is no room,
    /// or the machine has no such part.
    unsigned add(SimTime now, const FaultRequest& request);
    /// Why add() gave 0: a sentence without its end.
    std::string refusal(const FaultInfo& info) const;
    /// Ends it, if it is in force, and forgets it. False when there is none of that number.
    bool remove(unsigned number);
    /// The same for all of one sort; returns how many there were.
    std::size_t remove(const FaultInfo& info);
    void clear();

    /// By number, those that are over included.
    std::span<const Fault> list() const { return list_; }
    bool active(const FaultInfo& info) const;

    /// Begins and ends what is due.
    void advance(SimTime now);
    SimTime next_event() const { return next_; }

  private:
    void start(Fault& fault, SimTime now);
    void stop(Fault& fault);
    void refresh();

    Machine& machine_;
    std::vector<Fault> list_;
    unsigned last_ = 0;
    SimTime next_ = never;
};

}  // namespace fauxboard::machine
