// The place of a job as bytes.

#include "emulator/filament/job_place.h"

#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace fauxboard::filament {
namespace {

constexpr std::size_t longest_path = 512;

/// The values of a place as they are kept; the path follows. In the byte order of this computer: they do not
/// travel.
struct Values {
    std::uint64_t bytes, byte;
    std::int64_t elapsed_us;
    std::int32_t volume, layer, layers, part_fan_percent, speed_percent, flow_percent;
    std::array<double, 4> at;
    double nozzle_c, bed_c, unit_mm, feed_mm_s;
    std::array<double, 3> weights;
    std::uint8_t relative, relative_e;
    std::array<std::uint8_t, 6> nothing;
};
static_assert(std::is_trivially_copyable_v<Values>);

/// Calls `pass(member, value)` for each member of a place and where it lies in the bytes: the one list for
/// both ways.
template <class Place, class Kept, class F>
void each_value(Place& place, Kept& v, F&& pass) {
    pass(place.bytes, v.bytes);
    pass(place.byte, v.byte);
    pass(place.volume, v.volume);
    pass(place.layer, v.layer);
    pass(place.layers, v.layers);
    pass(place.part_fan_percent, v.part_fan_percent);
    pass(place.speed_percent, v.speed_percent);
    pass(place.flow_percent, v.flow_percent);
    pass(place.at, v.at);
    pass(place.nozzle_c, v.nozzle_c);
    pass(place.bed_c, v.bed_c);
    pass(place.modal.unit_mm, v.unit_mm);
    pass(place.modal.feed_mm_s, v.feed_mm_s);
    pass(place.modal.weights, v.weights);
    pass(place.relative, v.relative);
    pass(place.relative_e, v.relative_e);
}

template <class T>
constexpr bool is_flag = std::is_same_v<std::remove_cvref_t<T>, bool>;

Values values_of(const JobPlace& place) {
    Values v{};
    v.elapsed_us = place.elapsed.count();
    each_value(place, v, [](const auto& from, auto& to) {
        if constexpr (is_flag<decltype(from)>) {
            to = from ? 1 : 0;
        } else {
            to = from;
        }
    });
    return v;
}

bool sane(const Values& v) {
    bool good = v.byte <= v.bytes && v.volume >= 0 && v.volume <= 1 && v.layer >= 0 && v.layers >= 0 &&
                v.elapsed_us >= 0;
    for (const double value : {v.at[0], v.at[1], v.at[2], v.at[3], v.nozzle_c, v.bed_c, v.unit_mm,
                               v.feed_mm_s, v.weights[0], v.weights[1], v.weights[2]}) {
        good = good && std::isfinite(value);
    }
    return good;
}

}  // namespace

void put_place(const JobPlace& place, std::string& out) {
    out.clear();
    if (place.path.size() <= longest_path) {
        const Values v = values_of(place);
        out.append(reinterpret_cast<const char*>(&v), sizeof v).append(place.path);
    }
}

std::optional<JobPlace> place_from(std::string_view bytes) {
    Values v{};
    if (bytes.size() <= sizeof v) {
        return std::nullopt;
    }
    std::memcpy(&v, bytes.data(), sizeof v);
    if (!sane(v)) {
        return std::nullopt;
    }
    JobPlace place;
    place.path = bytes.substr(sizeof v);
    place.elapsed = SimTime{v.elapsed_us};
    each_value(place, v, [](auto& to, const auto& from) {
        if constexpr (is_flag<decltype(to)>) {
            to = from != 0;
        } else {
            to = from;
        }
    });
    return place;
}

}  // namespace fauxboard::filament
