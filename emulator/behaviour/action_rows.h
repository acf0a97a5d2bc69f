#pragma once

// How rows of the action tables are written. Private to behaviour/actions_*.cpp.

#include <optional>
#include <string>

#include "emulator/behaviour/actions.h"

namespace fauxboard::behaviour::rows {

using machine::HeaterId;
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

std::span<const ActionInfo> machine_actions();
std::span<const ActionInfo> device_actions();
std::span<const ActionInfo> resin_actions();
std::span<const ActionInfo> transfer_actions();
std::span<const ActionInfo> fault_actions();

}  // namespace fauxboard::behaviour::rows
