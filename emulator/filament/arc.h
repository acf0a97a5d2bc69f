#pragma once

#include <cstdint>

#include "emulator/filament/config.h"

namespace fauxboard::filament {

/// An arc (G2, G3) as the firmware runs it: a row of straight moves of about 1 mm, made one by one.
class ArcSegments {
  public:
    struct Request {
        AxisValues from{};
        AxisValues to{};
        double i = 0, j = 0;  ///< centre, mm from the start
        double radius = 0;    ///< R instead of I and J when not 0; negative: the longer way round
        bool clockwise = false;
        double feed_mm_s = 0;
    };

    /// False, and nothing to do, when there is no such arc: no centre, a radius and no way, or one beyond a
    /// kilometre (chosen: it would cross the bed for months). A radius that is too short makes a half circle,
    /// as in Marlin.
    bool begin(const Request& request);
    bool active() const { return next_ <= count_; }
    /// The end of the next straight move.
    AxisValues take();
    double feed_mm_s() const { return request_.feed_mm_s; }
    void clear() { next_ = 1, count_ = 0; }

  private:
    static constexpr double segment_mm = 1;
    static constexpr double most_segments = 65'535;  ///< Marlin counts them in 16 bits
    static constexpr double widest_mm = 1e6;

    Request request_;
    double centre_x_ = 0, centre_y_ = 0, start_angle_ = 0, sweep_ = 0, radius_ = 0;
    std::uint32_t next_ = 1;
    std::uint32_t count_ = 0;
};

}  // namespace fauxboard::filament
