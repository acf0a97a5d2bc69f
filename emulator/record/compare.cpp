#include "emulator/record/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "emulator/filament/config.h"
#include "emulator/record/compare_talk.h"

namespace fauxboard::record {
namespace {

LatencyStats latency(const std::vector<RequestRow>& rows, std::optional<double> RequestRow::*side) {
    std::vector<double> all;
    for (const RequestRow& row : rows) {
        if (row.*side) {
            all.push_back(*(row.*side));
        }
    }
    if (all.empty()) {
        return {};
    }
    std::sort(all.begin(), all.end());
    return {all.size(), all.front(), all[all.size() / 2], all.back()};
}

std::vector<CountRow> counts_of(const std::vector<detail::Said>& theirs,
                                const std::vector<detail::Said>& ours) {
    std::map<std::string, CountRow> rows;
    for (const detail::Said& said : theirs) {
        ++rows[said.code].recorded;
    }
    for (const detail::Said& said : ours) {
        ++rows[said.code].ours;
    }
    std::vector<CountRow> out;
    for (auto& [code, row] : rows) {
        row.frame = code;
        out.push_back(row);
    }
    // L2 before L10: by number, words last.
    std::stable_sort(out.begin(), out.end(), [](const CountRow& a, const CountRow& b) {
        return std::pair(a.frame.size() > 3, a.frame.size()) < std::pair(b.frame.size() > 3, b.frame.size());
    });
    return out;
}

std::string or_none(const std::string& label) {
    return label.empty() ? "no reply" : label;
}

}  // namespace

bool prints_folded(const behaviour::Profile& profile) {
    const auto* config = dynamic_cast<const filament::Config*>(profile.machine.get());
    return config != nullptr && config->thermal.fold;
}

Comparison compare(const std::vector<RecordedLine>& recording, const std::vector<RecordedLine>& ours,
                   bool folded, const Tolerances& tolerances) {
    const std::vector<detail::Said> theirs = detail::board_talk(recording);
    const std::vector<detail::Said> given = detail::board_talk(ours);
    Comparison out;
    out.requests = detail::compare_requests(recording, theirs, given, tolerances);
    out.recorded_latency = latency(out.requests, &RequestRow::recorded_ms);
    out.our_latency = latency(out.requests, &RequestRow::our_ms);
    out.bursts = detail::compare_bursts(theirs, given, tolerances);
    out.periods = detail::compare_periods(recording, theirs, given, tolerances);
    out.changes = detail::compare_changes(theirs, given, tolerances);
    out.curves = detail::compare_curves(theirs, given, folded, tolerances);
    out.counts = counts_of(theirs, given);
    return out;
}

std::vector<std::string> Comparison::failures() const {
    std::vector<std::string> out;
    for (const RequestRow& row : requests) {
        if (!row.same) {
            out.push_back(fmt::format("{:.3f} s: {} got {}, the recorded board gave {}", row.t, row.request,
                                      or_none(row.ours), or_none(row.recorded)));
        } else if (!row.in_time) {
            out.push_back(fmt::format("{:.3f} s: {} was answered after {:.0f} ms", row.t, row.request,
                                      row.our_ms.value_or(0)));
        }
    }
    for (const BurstRow& row : bursts) {
        if (!row.ok) {
            out.push_back(
                fmt::format("boot messages at {:.3f} s: {}", row.recorded_t.value_or(row.our_t.value_or(0)),
                            row.same ? fmt::format("{:.1f} ms apart", row.our_spacing_ms) : row.difference));
        }
    }
    for (const PeriodRow& row : periods) {
        if (!row.ok) {
            out.push_back(fmt::format("{} {}: every {:.4f} s, recorded every {:.4f} s", row.frame, row.when,
                                      row.ours.mean_s, row.recorded.mean_s));
        }
    }
    for (const ChangeRow& row : changes) {
        if (!row.ok) {
            out.push_back(fmt::format(
                "{} becomes {} {}, recorded {}", row.field, row.value,
                row.our_t ? fmt::format("at {:.3f} s", *row.our_t) : std::string("never"),
                row.recorded_t ? fmt::format("at {:.3f} s", *row.recorded_t) : std::string("never")));
        }
    }
    for (const CurveRow& row : curves) {
        if (!row.ok) {
            out.push_back(fmt::format("{}: {:.2f} K rms over {} points; allowed {:.1f}", row.name, row.rms_k,
                                      row.points, row.allowed_k));
        }
    }
    return out;
}

}  // namespace fauxboard::record
