#include "emulator/filament/mixer.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::filament {
namespace {

constexpr double max_height_mm = 1000;

bool height_ok(double mm) {
    return std::isfinite(mm) && mm >= 0 && mm <= max_height_mm;
}

}  // namespace

bool unpack(double packed, Ratio& out) {
    if (!(packed >= 0) || packed > 0xFFFFFF || packed != std::floor(packed)) {
        return false;
    }
    const auto bits = static_cast<std::uint32_t>(packed);
    const Ratio r{static_cast<int>(bits & 0xFFU), static_cast<int>(bits >> 8U & 0xFFU),
                  static_cast<int>(bits >> 16U)};
    if (r[0] + r[1] + r[2] != 100) {
        return false;
    }
    out = r;
    return true;
}

bool Mixer::set_weights(double a, double b, double c) {
    const auto clean = [](double w) { return std::isfinite(w) ? std::clamp(w, 0.0, 1e6) : 0.0; };
    const std::array<double, 3> w{clean(a), clean(b), clean(c)};
    const double sum = w[0] + w[1] + w[2];
    if (sum <= 0) {
        return false;
    }
    Ratio r{};
    for (std::size_t i = 0; i < r.size(); ++i) {
        r[i] = static_cast<int>(std::lround(100 * w[i] / sum));
    }
    *std::max_element(r.begin(), r.end()) += 100 - (r[0] + r[1] + r[2]);
    ratio_ = r;
    return true;
}

bool Mixer::set_packed(double packed) {
    if (!unpack(packed, ratio_)) {
        return false;
    }
    tools_[3] = ratio_;
    return true;
}

bool Mixer::set_share(int index, double percent) {
    if (index < 0 || index > 2 || !(percent >= 0 && percent <= 100)) {
        return false;
    }
    const auto i = static_cast<std::size_t>(index);
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    Ratio r{};
    r[i] = static_cast<int>(std::lround(percent));
    const int left = 100 - r[i];
    const int others = ratio_[j] + ratio_[k];
    // With nothing to keep in proportion, all of the rest goes to the last channel, as the vendor's text has
    // it for T2.
    r[j] = others > 0 ? left * ratio_[j] / others : (j > k ? left : 0);
    r[k] = left - r[j];
    ratio_ = tools_[3] = r;
    return true;
}

bool Mixer::select_tool(int tool) {
    if (tool < 0 || tool > 3) {
        return false;
    }
    tool_ = tool;
    ratio_ = tools_[static_cast<std::size_t>(tool)];
    return true;
}

bool Mixer::set_mode(int mode) {
    if (mode < 0 || mode > 3) {
        return false;
    }
    mode_ = mode;
    return true;
}

bool Mixer::select_template(int number) {
    if (number < 1 || number > 14) {
        return false;
    }
    template_ = number;
    if (number <= 8) {
        constexpr std::array<double, 4> heights{2, 10, 20, 50};
        const bool second = number % 2 == 0;
        start_ = second ? Ratio{0, 100, 0} : Ratio{100, 0, 0};
        end_ = second ? Ratio{100, 0, 0} : Ratio{0, 100, 0};
        start_height_ = 0;
        end_height_ = heights[static_cast<std::size_t>((number - 1) / 2)];
    }
    return true;
}

bool Mixer::set_start_height(double mm) {
    if (!height_ok(mm)) {
        return false;
    }
    start_height_ = mm;
    return true;
}

bool Mixer::set_end_height(double mm) {
    if (!height_ok(mm)) {
        return false;
    }
    end_height_ = mm;
    return true;
}

}  // namespace fauxboard::filament
