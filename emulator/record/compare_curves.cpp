// Temperatures over time.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "emulator/filament/thermal_fold.h"
#include "emulator/record/compare_talk.h"

namespace fauxboard::record::detail {
namespace {

constexpr std::size_t least_points = 8;
/// The controller's last degrees are a matter of its noise; the curve is judged up to here below the target.
constexpr double short_of_target_c = 10;

struct Sample {
    double t = 0;
    double c = 0;
    double target = 0;
};

/// The channel's temperature and target ("T0:22.4 /200.0 /1") of every L2 that has one.
std::vector<Sample> samples_of(const std::vector<Said>& talk, std::string_view key, bool folded) {
    std::vector<Sample> out;
    for (const Said& said : talk) {
        if (said.code != "L2") {
            continue;
        }
        const auto& fields = said.decoded.fields;
        const auto at = std::find_if(fields.begin(), fields.end(),
                                     [&](const protocol::DecodedField& field) { return field.key == key; });
        if (at == fields.end() || std::next(at) == fields.end() || !at->number || !std::next(at)->number) {
            continue;
        }
        const double printed = *at->number;
        if (printed != 0) {  // 0.0: not measured yet
            out.push_back(
                {said.t, folded ? filament::unfold_temperature(printed) : printed, *std::next(at)->number});
        }
    }
    return out;
}

/// A stretch of the recording with one target: heating until shortly below it, or cooling.
struct Stretch {
    std::size_t from = 0;
    std::size_t to = 0;  ///< one past the last sample
    bool heating = false;
    double target = 0;
};

std::vector<Stretch> stretches_of(const std::vector<Sample>& samples) {
    std::vector<Stretch> out;
    for (std::size_t from = 1; from < samples.size(); ++from) {
        const double target = samples[from].target;
        if (target == samples[from - 1].target) {
            continue;
        }
        Stretch stretch{from, from, target > samples[from].c, target};
        const double stop = stretch.heating ? target - short_of_target_c : target + short_of_target_c;
        while (stretch.to < samples.size() && samples[stretch.to].target == target &&
               (stretch.heating ? samples[stretch.to].c < stop : samples[stretch.to].c > stop)) {
            ++stretch.to;
        }
        out.push_back(stretch);
    }
    return out;
}

/// Our temperature at `t`, on the straight line between the two samples around it.
std::optional<double> at(const std::vector<Sample>& samples, double t) {
    const auto after = std::lower_bound(samples.begin(), samples.end(), t,
                                        [](const Sample& sample, double time) { return sample.t < time; });
    if (after == samples.end() || after == samples.begin()) {
        return std::nullopt;
    }
    const Sample& a = *std::prev(after);
    const double share = after->t > a.t ? (t - a.t) / (after->t - a.t) : 1;
    return a.c + (after->c - a.c) * share;
}

void add_rows(std::string_view name, const std::vector<Sample>& recorded, const std::vector<Sample>& given,
              const Tolerances& tolerances, std::vector<CurveRow>& rows) {
    for (const Stretch& stretch : stretches_of(recorded)) {
        CurveRow row;
        row.name = stretch.heating ? fmt::format("{}, heating to {:.0f}", name, stretch.target)
                                   : fmt::format("{}, cooling", name);
        row.allowed_k = stretch.heating ? tolerances.heating_rms_k : tolerances.cooling_rms_k;
        double squares = 0;
        for (std::size_t i = stretch.from; i < stretch.to; ++i) {
            const auto c = at(given, recorded[i].t);
            if (!c) {
                continue;
            }
            const double error = *c - recorded[i].c;
            squares += error * error;
            row.worst_k = std::max(row.worst_k, std::abs(error));
            ++row.points;
        }
        if (stretch.to - stretch.from < least_points) {
            continue;
        }
        row.from_s = recorded[stretch.from].t;
        row.to_s = recorded[stretch.to - 1].t;
        row.from_c = recorded[stretch.from].c;
        row.to_c = recorded[stretch.to - 1].c;
        row.rms_k = row.points == 0 ? 0 : std::sqrt(squares / static_cast<double>(row.points));
        row.ok = row.points >= least_points && row.rms_k <= row.allowed_k;
        rows.push_back(std::move(row));
    }
}

}  // namespace

std::vector<CurveRow> compare_curves(const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                     bool folded, const Tolerances& tolerances) {
    std::vector<CurveRow> rows;
    add_rows("nozzle", samples_of(theirs, "T0:", folded), samples_of(ours, "T0:", folded), tolerances, rows);
    add_rows("bed", samples_of(theirs, "B:", folded), samples_of(ours, "B:", folded), tolerances, rows);
    return rows;
}

}  // namespace fauxboard::record::detail
