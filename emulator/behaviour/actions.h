#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "emulator/behaviour/notice.h"
#include "emulator/behaviour/value.h"
#include "emulator/behaviour/variables.h"
#include "emulator/machine/machine.h"
#include "protocol/command.h"

namespace fauxboard::behaviour {

/// What an action may touch.
struct ActionContext {
    machine::Machine& machine;
    std::span<double> variables;  ///< the profile's own
    NoticeSink& notices;
    const protocol::Command* command = nullptr;        ///< the request that is carried out; null in events
    const std::vector<VariableInfo>* infos = nullptr;  ///< of the variables; run_action() says it
    bool reset = false;  ///< set by board.reset; the board restarts when the rule is done
};

enum class ArgType : std::uint8_t { number, boolean, text };

/// Names that an argument may have, where the machine of the profile has a list of them.
struct KnownNames {
    std::string_view what;  ///< "motion procedure": for messages
    /// Nothing of a machine of another kind, which does not carry the action out anyway.
    std::optional<std::vector<std::string_view>> (*of)(const machine::MachineConfig&);
};

struct ArgInfo {
    std::string_view name;
    ArgType type;
    bool required;
    std::string_view help;
    std::string_view unit = {};         ///< of a number; a scenario writes it behind the value
    const KnownNames* known = nullptr;  ///< of a text: what it must be one of, where a profile is loaded
    double min = 1;                     ///< of a number: what is refused below it, and above `max`
    double max = 0;                     ///< less than `min`: nothing is refused
};

/// Something a profile, a scenario or a person can do to the machine. One row here is the whole declaration:
/// its arguments are checked when the profile loads, and the reference is printed from it.
struct ActionInfo {
    std::string_view name;
    std::string_view phrase;  ///< how recordings call it ("filament in"), empty if they never do
    std::string_view help;
    std::span<const ArgInfo> args;
    void (*run)(ActionContext&,
                std::span<const Value>);  ///< null: `set` and `add`, which name fields instead
};

inline constexpr std::size_t max_action_args = 8;

/// All actions, in the order of the reference: those of all machines, then each kind's. Names are unique.
std::span<const ActionInfo> actions();
const ActionInfo* find_action(std::string_view name);
/// By name or by phrase.
const ActionInfo* find_world_action(std::string_view phrase);

}  // namespace fauxboard::behaviour
