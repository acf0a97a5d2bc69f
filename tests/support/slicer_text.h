#pragma once

#include <cstdint>
#include <string>

namespace fauxboard::testing {

/// Whose way of writing a file has.
enum class Slicer : std::uint8_t { cura, prusa, orca, bambu, simplify3d, ideamaker };

/// What a slicer knows of the file that it writes.
struct SlicerFacts {
    int layers = 0;
    int minutes = 0;  ///< its estimate
    /// All that stands around the moves: pictures, settings, feature types, M73. Else the layers alone.
    bool whole = false;
};

/// Before the first command, at the start of a layer (0 is the first) at that height, and behind the last
/// one.
std::string slicer_head(Slicer slicer, const SlicerFacts& facts);
std::string slicer_layer(Slicer slicer, const SlicerFacts& facts, int layer, double z_mm);
std::string slicer_foot(Slicer slicer, const SlicerFacts& facts);

/// The seconds that a whole file of the slicer says it takes; 0 where it does not say it in words for
/// machines.
double slicer_estimate_s(Slicer slicer, const SlicerFacts& facts);

}  // namespace fauxboard::testing
