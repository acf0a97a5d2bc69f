#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/printer_faults/rig.h"

namespace fauxboard::testing {

/// When each fault begins: by then whatever it finds is under way.
inline constexpr double fault_at_s = 300;

using Fields = std::vector<std::pair<std::string_view, double>>;

/// One fault at one moment of a machine's life: what is said and what is so then, and after it was mended.
struct FaultCase {
    std::string_view title;
    std::string spec;
    void (*before)(Rig&) = nullptr;      ///< from 5 s on
    void (*during)(Rig&) = nullptr;      ///< while it is in force; null: some seconds pass
    std::vector<std::string> said;       ///< beginnings of bodies, in that order, others between
    std::vector<std::string> not_said;   ///< beginnings
    std::optional<int> page;             ///< the exception page then open
    Fields state;                        ///< then
    void (*back)(Rig&) = nullptr;        ///< mends it; null: it is taken away by the control channel
    std::vector<std::string> said_back;  ///< as `said`, after that
    Fields state_back;

    std::string_view kind() const { return std::string_view(spec).substr(0, spec.find(':')); }
};

std::span<const FaultCase> fault_cases();

}  // namespace fauxboard::testing
