#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "emulator/drawing/canvas.h"
#include "emulator/screen/scene.h"

namespace fauxboard::drawing {

/// Pictures that the machine has: a model's preview, what its panel shows.
class Pictures {
  public:
    virtual ~Pictures() = default;
    /// The size of picture `index` of that name; false when there is none now.
    virtual bool size(std::string_view name, std::size_t index, std::uint32_t& width,
                      std::uint32_t& height) const = 0;
    /// One row of it, each pixel 0xRRGGBB; false when it cannot be had.
    virtual bool row(std::string_view name, std::size_t index, std::uint32_t y,
                     std::span<std::uint32_t> out) const = 0;
};

/// The scene as the glass shows it. `pictures` may be null: then their places stay empty.
Picture draw(const screen::Scene& scene, const Pictures* pictures = nullptr);

/// How wide a text is drawn in its place, compared to the width it has by itself: 1 when it fits, less when
/// it is squeezed or cut.
double squeeze_of(const screen::SceneItem& item);

}  // namespace fauxboard::drawing
