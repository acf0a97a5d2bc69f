#pragma once

#include <optional>
#include <string_view>

namespace fauxboard::filament {

/// What a slicer's comment tells about the print.
struct SlicerNote {
    std::optional<int> layer;        ///< the layer that begins here, counted from 1; 0 or less for a raft
    bool next_layer = false;         ///< the next layer begins here, whichever it is
    bool before_layer = false;       ///< the same from a slicer that may just have said so itself
    std::optional<int> layers;       ///< how many there are in all
    std::optional<double> seconds;   ///< how long the print takes, the slicer thinks
    std::optional<double> layer_mm;  ///< how high a layer is, above 0
};

/// Reads a comment, without its ';'. Understood are Cura (`LAYER:0`, `LAYER_COUNT:20`, `TIME:3600`, `Layer
/// height: 0.2`), ideaMaker
/// (`LAYER:0`), PrusaSlicer and its kin (`LAYER_CHANGE`, `BEFORE_LAYER_CHANGE`, `total layers count = 20`,
/// `estimated printing time (normal mode) = 1h 2m 3s`), Bambu Studio (`CHANGE_LAYER`,
/// `layer num/total_layer_count: 1/2`, `model printing time: 1m; total estimated time: 2m 3s`), Simplify3D
/// (`layer 1, Z = 0.200`) and KISSlicer
/// (`BEGIN_LAYER_OBJECT`). All else, and what does not fit into the numbers, says nothing.
SlicerNote read_slicer_comment(std::string_view comment);

/// Gathers what the comments of a file tell, in their order.
class SlicerNotes {
  public:
    void clear() { *this = SlicerNotes{}; }
    /// Takes in the next comment; true when the layer changed.
    bool take(std::string_view comment);
    /// Takes in the end of a file beforehand: number of layers and time may stand there only.
    void take_tail(std::string_view tail);

    int layer() const { return layer_; }    ///< counted from 1; 0 before the first
    int layers() const { return layers_; }  ///< 0 as long as no comment told
    void set_layers(int layers) { layers_ = layers; }
    double seconds() const { return seconds_; }
    double layer_mm() const { return layer_mm_; }  ///< as told first; 0 as long as no comment did

  private:
    int layer_ = 0;
    int layers_ = 0;
    double seconds_ = 0;
    double layer_mm_ = 0;
    bool numbered_ = false;      ///< layers carry numbers: marks without one are passed over
    bool just_changed_ = false;  ///< a LAYER_CHANGE came, no BEFORE_LAYER_CHANGE since
};

}  // namespace fauxboard::filament
