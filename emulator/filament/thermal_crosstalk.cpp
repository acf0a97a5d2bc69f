#include "emulator/filament/thermal_crosstalk.h"

#include <algorithm>

namespace fauxboard::filament {

// Read off heating (22..193) and cooling (201..104) of the recording, the same within about 1 K. Where an
// input jumps, its neighbour does so at the same temperature of the nozzle, which points to the ADC's
// multiplexer.
SensorlessInputConfig a30t_t1() {
    return {
        .points = {{22, 87.4},   {27, 88.2},     {37, 90.7},     {48, 92.9},   {59, 95.9},   {66, 98.5},
                   {77, 103.5},  {87, 107.6},    {91, 108.9},    {94, 111.8},  {97, 114.0},  {101.75, 116.3},
                   {106, 118.9}, {110.6, 120.5}, {110.6, 111.5}, {115, 113.8}, {122, 117.6}, {126, 119.7},
                   {132, 121.5}, {140, 125.4},   {147, 129.6},   {155, 131.4}, {164, 133.9}, {175, 136.6},
                   {188, 139.3}, {199, 140.1},   {201.1, 140.7}},
        .noise_c = 0.13,
        .noise_wander_s = 60,
        .counts_per_c = 7};
}

SensorlessInputConfig a30t_t2() {
    return {.points = {{22, 106.0},    {27, 106.5},     {37, 107.1},     {48, 108.0},     {59, 109.6},
                       {66, 111.9},    {77, 114.3},     {87, 116.9},     {91, 118.0},     {94, 118.5},
                       {97, 119.4},    {101.75, 120.3}, {101.75, 109.9}, {106, 111.4},    {110.6, 112.9},
                       {110.6, 118.2}, {115, 119.3},    {122.15, 120.5}, {122.15, 110.6}, {126, 112.0},
                       {132, 113.4},   {140, 114.9},    {147, 116.4},    {155, 117.9},    {164, 119.0},
                       {175, 119.9},   {188, 120.8},    {199, 121.0},    {201.1, 121.2}},
            .noise_c = 0.10,
            .noise_wander_s = 60,
            .counts_per_c = 7};
}

double cross_talk_c(const SensorlessInputConfig& config, double source_c) {
    const auto& points = config.points;
    if (points.empty()) return 0;
    const auto above =
        std::upper_bound(points.begin(), points.end(), source_c,
                         [](double c, const CrossTalkPoint& point) { return c < point.source_c; });
    if (above == points.begin()) return points.front().value_c;
    if (above == points.end()) return points.back().value_c;
    const auto below = above - 1;
    const double share = (source_c - below->source_c) / (above->source_c - below->source_c);
    return below->value_c + share * (above->value_c - below->value_c);
}

double measurement_noise(std::uint64_t seed, unsigned channel, std::uint64_t index) {
    // splitmix64 of the three; then the sum of four 16-bit uniforms, whose standard deviation is 65536 /
    // sqrt(3).
    std::uint64_t hash = seed + 0x9e3779b97f4a7c15u * (4 * index + channel + 1);
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    hash ^= hash >> 31;
    const std::uint64_t sum =
        (hash & 0xffff) + (hash >> 16 & 0xffff) + (hash >> 32 & 0xffff) + (hash >> 48 & 0xffff);
    return (static_cast<double>(sum) - 2 * 65535.0) * (1.7320508075688772 / 65536.0);
}

double wandering_noise(std::uint64_t seed, unsigned channel, std::uint64_t index, std::uint64_t stretch) {
    const double here = measurement_noise(seed, channel, index / stretch);
    const std::uint64_t on_the_way = index % stretch;
    if (on_the_way == 0) return here;
    const double next = measurement_noise(seed, channel, index / stretch + 1);
    return here + (next - here) * static_cast<double>(on_the_way) / static_cast<double>(stretch);
}

}  // namespace fauxboard::filament
