#pragma once

#include <cstdint>
#include <string>

namespace fauxboard::sliced {

/// How a made-up file is to be. Lengths in mm, times in s.
struct Sample {
    static constexpr std::uint32_t most_layers = 10'000;
    std::uint32_t layers = 5;  ///< 1 to most_layers
    float exposure_s = 2;      ///< of each layer
    float layer_height_mm = 0.05F;
    float lift_mm = 5;
    float lift_mm_min = 180;
    std::uint32_t width = 32;  ///< pixels of the LCD, 16 to 4096
    std::uint32_t height = 16;
};

/// A small file that can be printed, for who has none at hand: .cbddlp, version 2, a bar of light on a
/// tiny LCD, or on one of the wished size. Of the tiny one some 60 bytes a layer; the same for the same
/// wishes.
std::string make_sample(const Sample& wishes);

}  // namespace fauxboard::sliced
