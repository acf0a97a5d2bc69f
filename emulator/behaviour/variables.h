#pragma once

#include <span>
#include <string>
#include <vector>

namespace fauxboard::behaviour {

/// Bounds of one of the profile's own variables.
struct VariableInfo {
    std::string name;
    std::string help;
    double initial = 0;
    double min = 0;
    double max = 0;
    bool stored = false;  ///< kept in the EEPROM
};

/// The variables of one board, each with its bounds.
struct Variables {
    std::span<double> values;
    const std::vector<VariableInfo>& infos;
};

}  // namespace fauxboard::behaviour
