#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/operand.h"
#include "emulator/behaviour/variables.h"

namespace fauxboard::behaviour {

/// One test of a `when`. All tests of a rule must hold.
struct Condition {
    enum class Test : std::uint8_t { equal, not_equal, range, one_of, present, absent, starts_with };
    Operand left;
    Test test = Test::equal;
    std::vector<Operand> right;  ///< literals; range: lower and upper bound, either may be `none`

    bool holds(const Scope& scope) const;
};

inline bool all_hold(const std::vector<Condition>& conditions, const Scope& scope) {
    // A plain loop: std::all_of is unrolled for lists much longer than these.
    for (const Condition& condition : conditions) {
        if (!condition.holds(scope)) {
            return false;
        }
    }
    return true;
}

/// One entry of a `do`.
struct ActionCall {
    const ActionInfo* info = nullptr;
    std::vector<Operand> args;  ///< one per info->args, `none` when left out
    // `set` and `add` only: where to.
    const Field* field = nullptr;
    std::optional<std::size_t> variable;
    bool add = false;
};

/// Carries out one call. A parameter that an argument needs and the line lacks skips the call, as the real
/// board leaves alone what it was not told.
void run_action(const ActionCall& call, const Scope& scope, const std::vector<VariableInfo>& variables,
                ActionContext& context);

/// One entry of a `send`: a frame, perhaps only sometimes, perhaps several times.
struct Send {
    std::size_t frame = 0;
    unsigned times = 1;
    bool now = false;  ///< written at once instead of on the transmit tick
    std::vector<Condition> when;
};

/// trigger -> condition -> actions -> frames. The first rule of a list whose conditions hold is carried out.
struct Rule {
    std::vector<Condition> when;
    std::vector<ActionCall> actions;
    std::vector<Send> send;
    std::vector<Send> after;  ///< of the USB host: said when the command is over, before it is acknowledged
    bool at_once = false;     ///< of the USB host: carried out as it comes in, ahead of what waits
    /// Of the main line: nothing else is taken up and nothing leaves until the moves and waits it began are
    /// over; then what it sends goes.
    bool until_done = false;
};

}  // namespace fauxboard::behaviour
