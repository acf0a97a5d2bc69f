#include "emulator/world/play.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <numeric>

#include "emulator/world/steps.h"
#include "emulator/world/world.h"

namespace fauxboard::world {
namespace {

constexpr std::uint64_t played_twice = 16;

/// The promise's name, without what was found this time.
std::string_view promise_of(std::string_view broken) {
    return broken.substr(0, broken.find(':'));
}

}  // namespace

Outcome play(const Cast& cast, std::uint64_t seed, const std::vector<std::uint64_t>& steps,
             board::Observer* listener) {
    Outcome outcome;
    try {
        World world(cast, seed, listener);
        try {
            for (const std::uint64_t number : steps) {
                world.step(number);
            }
            world.peace();
        } catch (const std::exception& error) {
            outcome.broken = error.what();
        }
        outcome.time = world.time();
        outcome.digest = world.digest();
        outcome.requests = world.requests();
    } catch (const std::exception& error) {
        outcome.broken = error.what();
    }
    return outcome;
}

std::vector<std::uint64_t> whole(std::uint64_t count) {
    std::vector<std::uint64_t> steps(count);
    std::iota(steps.begin(), steps.end(), std::uint64_t{0});
    return steps;
}

std::vector<std::uint64_t> shrink(const Cast& cast, std::uint64_t seed, std::vector<std::uint64_t> steps) {
    const std::string broken = play(cast, seed, steps).broken;
    const std::string promise(promise_of(broken));
    for (std::size_t size = std::max<std::size_t>(steps.size() / 2, 1);; size = (size + 1) / 2) {
        for (std::size_t at = 0; at < steps.size();) {
            std::vector<std::uint64_t> fewer(steps);
            const auto from = fewer.begin() + static_cast<std::ptrdiff_t>(at);
            fewer.erase(from, from + static_cast<std::ptrdiff_t>(std::min(size, steps.size() - at)));
            if (promise_of(play(cast, seed, fewer).broken) == promise) {
                steps = std::move(fewer);
            } else {
                at += size;
            }
        }
        if (size == 1) {
            return steps;
        }
    }
}

std::string report(const Cast& cast, std::uint64_t seed, const std::vector<std::uint64_t>& steps) {
    std::string names;
    for (const std::uint64_t number : steps) {
        names += (names.empty() ? "" : ", ") + std::string(step_name(fault::Dice(seed, number, 0)));
    }
    return fmt::format("profile {}, seed {}, steps {} ({}): {}", cast.profile->name, seed,
                       fmt::join(steps, ","), names, play(cast, seed, steps).broken);
}

Soaked soak(const Cast& cast, std::uint64_t seed, std::uint64_t steps,
            const std::function<bool(const Soaked& so_far)>& enough) {
    Soaked soaked;
    for (; !enough(soaked); ++seed) {
        const Outcome outcome = play(cast, seed, whole(steps));
        ++soaked.seeds;
        soaked.requests += outcome.requests;
        soaked.time += outcome.time;
        soaked.digest = soaked.digest * 31 + outcome.digest;
        if (!outcome.held()) {
            soaked.broken = report(cast, seed, shrink(cast, seed, whole(steps)));
            return soaked;
        }
        if (seed % played_twice == 0 && play(cast, seed, whole(steps)).digest != outcome.digest) {
            soaked.broken =
                fmt::format("profile {}, seed {}: equal seed, other bytes", cast.profile->name, seed);
            return soaked;
        }
    }
    return soaked;
}

}  // namespace fauxboard::world
