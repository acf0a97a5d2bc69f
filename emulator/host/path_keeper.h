#pragma once

#include <optional>
#include <vector>

#include "emulator/control/error.h"
#include "emulator/filament/travel.h"

namespace fauxboard::host {

/// The way of the head in the layer under way and in the one below, for people. Bounded: of a layer with more
/// points than that the rest is left out.
class PathKeeper {
  public:
    static constexpr std::size_t most_points = 8000;

    void add(const filament::Travel& travel);
    /// [{"z", "d": [[x, y, x, y, ...], ...]}, ...], the layer below first.
    control::Json whole() const;
    /// The same of what came since the last news(); empty when nothing did.
    control::Json news();

  private:
    struct Layer {
        double z = 0;
        std::vector<float> points;        ///< x, y, x, y, ...
        std::vector<std::size_t> breaks;  ///< where in `points` a line begins
    };
    static control::Json lines(const Layer& layer, std::size_t from);

    std::optional<Layer> below_;
    std::optional<Layer> layer_;
    std::size_t told_ = 0;     ///< of layer_'s points
    bool told_layer_ = false;  ///< that there is this layer
    bool drawing_ = false;     ///< the last travel did
};

}  // namespace fauxboard::host
