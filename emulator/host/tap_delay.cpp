#include "emulator/host/tap_delay.h"

#include <algorithm>
#include <bit>

namespace fauxboard::host {

using machine::SimTime;

std::size_t TapDelay::bucket(std::uint64_t us) {
    if (us < 64) {
        return static_cast<std::size_t>(us);
    }
    const auto doublings = static_cast<unsigned>(std::bit_width(us)) - 7;  // 64..127 is the first
    const std::uint64_t step = (us >> (doublings + 1)) - 32;               // 0..31
    return std::min(buckets - 1, static_cast<std::size_t>(64 + 32 * doublings + step));
}

std::uint64_t TapDelay::lower_end(std::size_t bucket) {
    if (bucket < 64) {
        return bucket;
    }
    const std::size_t doublings = (bucket - 64) / 32;
    const std::size_t step = (bucket - 64) % 32;
    return static_cast<std::uint64_t>(32 + step) << (doublings + 1);
}

void TapDelay::add(SimTime delay) {
    delay = std::max(delay, SimTime{0});
    min_ = count_ == 0 ? delay : std::min(min_, delay);
    max_ = std::max(max_, delay);
    ++count_;
    ++counts_[bucket(static_cast<std::uint64_t>(delay.count()))];
}

SimTime TapDelay::median() const {
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < buckets; ++i) {
        before += counts_[i];
        if (before * 2 > count_) {
            return std::max(min_, SimTime{static_cast<SimTime::rep>(lower_end(i))});
        }
    }
    return SimTime{0};
}

}  // namespace fauxboard::host
