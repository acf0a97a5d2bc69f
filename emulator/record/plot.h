#pragma once

#include <string>
#include <vector>

#include "emulator/record/recording.h"

namespace fauxboard::record {

/// A set of lines and what it is called in the picture: "recorded", "replayed".
struct PlotLines {
    std::string name;
    const std::vector<RecordedLine>& lines;
};

/// The curves of recordings as one SVG: every quantity of what the board said that has a unit of temperature,
/// of length or a percentage, and is not always the same; a chart for each unit, the sets over each other,
/// the first one wide and pale. `folded`: temperatures are printed with the fraction mirrored (see
/// thermal_fold.h). Curves of any length come out with a bounded number of points.
std::string plot_svg(const std::vector<PlotLines>& sets, bool folded);

}  // namespace fauxboard::record
