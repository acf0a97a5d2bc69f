// A comparison in words and as JSON.

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/wire_text.h"
#include "emulator/record/compare.h"

namespace fauxboard::record {
namespace {

using Text = std::back_insert_iterator<std::string>;
using Json = nlohmann::ordered_json;

std::string or_dash(const std::string& text) {
    return text.empty() ? "-" : text;
}
std::string number_or_dash(const std::optional<double>& value, int decimals) {
    return value ? fmt::format("{:.{}f}", *value, decimals) : std::string("-");
}
const char* mark(bool ok) {
    return ok ? "" : "  <-- differs";
}

void write_requests(const Comparison& c, Text out) {
    fmt::format_to(out, "Requests\n  {:>9}  {:<24} {:<10} {:<10} {:>9} {:>9}\n", "time s", "request",
                   "recorded", "ours", "rec. ms", "ours ms");
    for (const RequestRow& row : c.requests) {
        fmt::format_to(out, "  {:>9.3f}  {:<24} {:<10} {:<10} {:>9} {:>9}{}\n", row.t,
                       behaviour::from_wire(row.request), or_dash(row.recorded), or_dash(row.ours),
                       number_or_dash(row.recorded_ms, 0), number_or_dash(row.our_ms, 0), mark(row.ok()));
    }
    const LatencyStats& a = c.recorded_latency;
    const LatencyStats& b = c.our_latency;
    fmt::format_to(out,
                   "  latency, ms: recorded min {:.0f} median {:.0f} max {:.0f}, ours min {:.0f} median "
                   "{:.0f} max {:.0f}\n",
                   a.min_ms, a.median_ms, a.max_ms, b.min_ms, b.median_ms, b.max_ms);
}

void write_bursts(const Comparison& c, Text out) {
    fmt::format_to(out, "\nMessages after power-on\n");
    for (const BurstRow& row : c.bursts) {
        fmt::format_to(
            out,
            "  recorded at {} s: {} lines, {:.1f} ms apart; ours at {} s: {} lines, {:.1f} ms apart; {}{}\n",
            number_or_dash(row.recorded_t, 3), row.recorded_lines, row.recorded_spacing_ms,
            number_or_dash(row.our_t, 3), row.our_lines, row.our_spacing_ms,
            row.same ? fmt::format("the same lines, none more than {:.0f} ms off", row.worst_offset_ms)
                     : row.difference,
            mark(row.ok));
    }
}

void write_periods(const Comparison& c, Text out) {
    fmt::format_to(out, "\nFrames that come by themselves (mean and spread of the regular gaps)\n");
    for (const PeriodRow& row : c.periods) {
        const auto side = [](const PeriodStats& s) {
            return fmt::format("{:>4} frames, {:>4} x {:.4f} s sd {:.4f}", s.frames, s.regular, s.mean_s,
                               s.sd_s);
        };
        fmt::format_to(out, "  {:<4} {:<19} recorded {}; ours {}{}{}\n", row.frame, row.when,
                       side(row.recorded), side(row.ours), row.judged ? "" : "  (not judged)", mark(row.ok));
    }
}

void write_changes(const Comparison& c, Text out) {
    fmt::format_to(out, "\nFields that change\n  {:<10} {:<10} {:>10} {:>10} {:>8}\n", "field", "becomes",
                   "rec. s", "ours s", "diff. s");
    for (const ChangeRow& row : c.changes) {
        const std::string difference =
            row.recorded_t && row.our_t ? fmt::format("{:+.3f}", *row.our_t - *row.recorded_t) : "-";
        fmt::format_to(out, "  {:<10} {:<10} {:>10} {:>10} {:>8}{}\n", row.field, row.value,
                       number_or_dash(row.recorded_t, 3), number_or_dash(row.our_t, 3), difference,
                       mark(row.ok));
    }
}

void write_curves(const Comparison& c, Text out) {
    fmt::format_to(out, "\nTemperatures\n");
    for (const CurveRow& row : c.curves) {
        fmt::format_to(out,
                       "  {:<24} {:.0f} to {:.0f} s, {:.1f} to {:.1f} C, {} points: {:.2f} K rms, worst "
                       "{:.2f} K (allowed {:.0f} K rms){}\n",
                       row.name, row.from_s, row.to_s, row.from_c, row.to_c, row.points, row.rms_k,
                       row.worst_k, row.allowed_k, mark(row.ok));
    }
}

void write_counts(const Comparison& c, Text out) {
    fmt::format_to(out, "\nLines by code (recorded / ours)\n ");
    for (const CountRow& row : c.counts) {
        fmt::format_to(out, " {} {}/{}", row.frame, row.recorded, row.ours);
    }
    fmt::format_to(out, "\n");
}

void write_verdict(const Comparison& c, Text out) {
    const std::vector<std::string> failures = c.failures();
    if (failures.empty()) {
        fmt::format_to(out,
                       "\nVerdict: the same talk, within the tolerances: {} requests answered as recorded.\n",
                       c.requests.size());
        return;
    }
    fmt::format_to(out, "\nVerdict: not the same talk; {} {}:\n", failures.size(),
                   failures.size() == 1 ? "difference is beyond the tolerances"
                                        : "differences are beyond the tolerances");
    for (const std::string& failure : failures) {
        fmt::format_to(out, "  {}\n", behaviour::from_wire(failure));
    }
}

Json optional_json(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}
Json label_json(const std::string& label) {
    return label.empty() ? Json(nullptr) : Json(behaviour::from_wire(label));
}
Json latency_json(const LatencyStats& s) {
    return {{"replies", s.replies}, {"min_ms", s.min_ms}, {"median_ms", s.median_ms}, {"max_ms", s.max_ms}};
}
Json period_json(const PeriodStats& s) {
    return {{"frames", s.frames}, {"regular_gaps", s.regular}, {"mean_s", s.mean_s}, {"sd_s", s.sd_s}};
}

Json requests_json(const Comparison& c) {
    Json rows = Json::array();
    for (const RequestRow& row : c.requests) {
        rows.push_back({{"t", row.t},
                        {"request", behaviour::from_wire(row.request)},
                        {"recorded", label_json(row.recorded)},
                        {"ours", label_json(row.ours)},
                        {"recorded_ms", optional_json(row.recorded_ms)},
                        {"our_ms", optional_json(row.our_ms)},
                        {"same", row.same},
                        {"in_time", row.in_time}});
    }
    return rows;
}

Json bursts_json(const Comparison& c) {
    Json rows = Json::array();
    for (const BurstRow& row : c.bursts) {
        rows.push_back({{"recorded_t", optional_json(row.recorded_t)},
                        {"our_t", optional_json(row.our_t)},
                        {"recorded_lines", row.recorded_lines},
                        {"our_lines", row.our_lines},
                        {"same", row.same},
                        {"difference", label_json(row.difference)},
                        {"recorded_spacing_ms", row.recorded_spacing_ms},
                        {"our_spacing_ms", row.our_spacing_ms},
                        {"worst_offset_ms", row.worst_offset_ms},
                        {"ok", row.ok}});
    }
    return rows;
}

Json periods_json(const Comparison& c) {
    Json rows = Json::array();
    for (const PeriodRow& row : c.periods) {
        rows.push_back({{"frame", row.frame},
                        {"when", row.when},
                        {"recorded", period_json(row.recorded)},
                        {"ours", period_json(row.ours)},
                        {"judged", row.judged},
                        {"ok", row.ok}});
    }
    return rows;
}

Json changes_json(const Comparison& c) {
    Json rows = Json::array();
    for (const ChangeRow& row : c.changes) {
        rows.push_back({{"field", row.field},
                        {"value", behaviour::from_wire(row.value)},
                        {"recorded_t", optional_json(row.recorded_t)},
                        {"our_t", optional_json(row.our_t)},
                        {"allowed_s", row.allowed_s},
                        {"ok", row.ok}});
    }
    return rows;
}

Json curves_json(const Comparison& c) {
    Json rows = Json::array();
    for (const CurveRow& row : c.curves) {
        rows.push_back({{"name", row.name},
                        {"from_s", row.from_s},
                        {"to_s", row.to_s},
                        {"from_c", row.from_c},
                        {"to_c", row.to_c},
                        {"points", row.points},
                        {"rms_k", row.rms_k},
                        {"worst_k", row.worst_k},
                        {"allowed_rms_k", row.allowed_k},
                        {"ok", row.ok}});
    }
    return rows;
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
    std::string text;
    const Text out = std::back_inserter(text);
    write_requests(comparison, out);
    write_bursts(comparison, out);
    write_periods(comparison, out);
    write_changes(comparison, out);
    write_curves(comparison, out);
    write_counts(comparison, out);
    write_verdict(comparison, out);
    return text;
}

Json comparison_json(const Comparison& comparison) {
    Json out;
    Json failures = Json::array();
    for (const std::string& failure : comparison.failures()) {
        failures.push_back(behaviour::from_wire(failure));
    }
    out["ok"] = failures.empty();
    out["differences"] = std::move(failures);
    out["latency"] = {{"recorded", latency_json(comparison.recorded_latency)},
                      {"ours", latency_json(comparison.our_latency)}};
    out["requests"] = requests_json(comparison);
    out["boot"] = bursts_json(comparison);
    out["periods"] = periods_json(comparison);
    out["changes"] = changes_json(comparison);
    out["temperatures"] = curves_json(comparison);
    Json counts = Json::object();
    for (const CountRow& row : comparison.counts) {
        counts[behaviour::from_wire(row.frame)] = {{"recorded", row.recorded}, {"ours", row.ours}};
    }
    out["lines"] = std::move(counts);
    return out;
}

}  // namespace fauxboard::record
