#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "emulator/behaviour/profile.h"
#include "emulator/record/recording.h"

namespace fauxboard::record {

// How two recordings of the same talk differ: one of a real board, and what ours says to the same requests.
// Times are in seconds of the recording. `ok` says whether the row is within the tolerances below.

/// What may differ. The figures are those of recorded Geeetech boards: a request is executed on the next tick
/// of 50 ms and answered one tick later, and the recording PC stamps in grains of 16 ms.
struct Tolerances {
    double reply_min_ms = 50;
    double reply_max_ms = 130;
    /// A reply outside these bounds is in time as well if the recorded board took as long, but for a tick and
    /// a grain: requests sent together wait for one another, a stopped run ends with its piece.
    double reply_beside_recorded_ms = 66;
    double burst_tick_ms = 50;
    double burst_spacing_ms = 2;     ///< from the tick, on average over the burst
    double status_period_s = 0.02;   ///< L3, L21: mean of our period from that of the recorded one
    double loading_period_s = 0.01;  ///< L1 that repeats itself
    double heating_rms_k = 3;
    double cooling_rms_k = 2;
    double slot_round_s = 2.2;   ///< a change told in its own slot, or by a reply
    double slow_round_s = 4.3;   ///< a change told by L3, which comes every second round
    double missing_tail_s = 10;  ///< a change so close to the recording's end may come too late for it
};

struct RequestRow {
    double t = 0;
    std::string request;  ///< "M104 S200.0"
    /// "L24 P5"; empty: no reply. Status frames that the board sends by itself do not count.
    std::string recorded, ours;
    std::optional<double> recorded_ms, our_ms;
    bool same = false;     ///< the same code, or none on both sides
    bool in_time = false;  ///< our latency is within the bounds; true without a reply
    bool ok() const { return same && in_time; }
};

/// A run of messages one tick after the other, as after power-on.
struct BurstRow {
    std::optional<double> recorded_t, our_t;
    std::size_t recorded_lines = 0, our_lines = 0;
    bool same = false;       ///< order and content; serial numbers are not looked at
    std::string difference;  ///< the first one, in words
    double recorded_spacing_ms = 0, our_spacing_ms = 0;
    double worst_offset_ms = 0;  ///< of a line's place in its burst, ours against recorded
    bool ok = false;
};

struct PeriodStats {
    std::size_t frames = 0;
    std::size_t regular = 0;  ///< gaps within 5 % of the median gap; mean and sd are over these
    double mean_s = 0, sd_s = 0;
};
struct PeriodRow {
    std::string frame, when;  ///< "L21", "until M2134"
    PeriodStats recorded, ours;
    bool judged = false;
    bool ok = true;
};

struct ChangeRow {
    std::string field;  ///< "L3 MT"
    std::string value;  ///< what it became
    std::optional<double> recorded_t, our_t;
    double allowed_s = 0;
    bool ok = false;
};

struct CurveRow {
    std::string name;  ///< "nozzle, heating to 200"
    double from_s = 0, to_s = 0;
    double from_c = 0, to_c = 0;  ///< recorded
    std::size_t points = 0;
    double rms_k = 0, worst_k = 0, allowed_k = 0;
    bool ok = false;
};

struct CountRow {
    std::string frame;
    std::size_t recorded = 0, ours = 0;
};

struct LatencyStats {
    std::size_t replies = 0;
    double min_ms = 0, median_ms = 0, max_ms = 0;
};

struct Comparison {
    std::vector<RequestRow> requests;
    LatencyStats recorded_latency, our_latency;
    std::vector<BurstRow> bursts;
    std::vector<PeriodRow> periods;
    std::vector<ChangeRow> changes;
    std::vector<CurveRow> curves;
    std::vector<CountRow> counts;

    /// What is not within the tolerances, a sentence each.
    std::vector<std::string> failures() const;
    bool ok() const { return failures().empty(); }
};

/// Whether boards of the profile print temperatures with the fraction mirrored (see thermal_fold.h).
bool prints_folded(const behaviour::Profile& profile);

/// Compares what `ours` has from the board with what `recording` has, for the requests of `recording`.
/// `folded`: both print temperatures as prints_folded() says.
Comparison compare(const std::vector<RecordedLine>& recording, const std::vector<RecordedLine>& ours,
                   bool folded, const Tolerances& tolerances = {});

/// For a person: tables, and a verdict at the end.
std::string comparison_text(const Comparison& comparison);
/// The same as one object.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace fauxboard::record
