#pragma once

// How rows of the action tables are written, by this room and by the kinds of machines.

#include <optional>
#include <string>
#include <type_traits>

#include "emulator/behaviour/actions.h"
#include "emulator/machine/machine.h"

namespace fauxboard::behaviour {

using Args = std::span<const Value>;

inline std::optional<double> given(const Value& v) {
    return v.is_number() ? std::optional<double>{v.number} : std::nullopt;
}
inline double number_or(const Value& v, double fallback) {
    return v.is_number() ? v.number : fallback;
}
inline bool flag(const Value& v) {
    return v.is_number() && v.number != 0;
}
inline std::string_view text_or_none(const Value& v) {
    return v.is_text() ? v.text : std::string_view{};
}

/// A whole number in the range, or nothing; what the line brings may be any double.
inline std::optional<int> whole(const Value& v, int min, int max) {
    if (!v.is_number() || !(v.number >= min && v.number <= max)) {
        return std::nullopt;
    }
    return static_cast<int>(v.number);
}

inline void refuse(ActionContext& c, std::string_view what) {
    c.notices.notice(Level::warning, what);
}

/// Says that an action is of another kind of machine than the board's.
void refuse_kind(ActionContext& c, const machine::Kind& wanted);

template <class M>
M& machine_of(void (*)(M&, ActionContext&, Args));

/// For a row of an action that only one kind of machine knows: `Run` is called with the machine as what it
/// is, as its first parameter says. On any other machine the action is refused.
template <auto Run>
void own(ActionContext& c, Args a) {
    using M = std::remove_reference_t<decltype(machine_of(+Run))>;
    if (M* machine = machine::as<M>(c.machine)) {
        Run(*machine, c, a);
    } else {
        refuse_kind(c, M::kind_row());
    }
}

}  // namespace fauxboard::behaviour
