// What a board says after power-on: message after message, one a tick.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "emulator/record/compare_talk.h"

namespace fauxboard::record::detail {
namespace {

/// Lines closer than this belong to one run: a tick of 50 ms, a grain of 16 ms, and some air.
constexpr double together_s = 0.08;
constexpr std::size_t least_lines = 8;

struct Burst {
    std::vector<const Said*> lines;
};

/// Runs of lines in which the board tells who it is (L9). What the USB host had shown meanwhile (L14) is left
/// out.
std::vector<Burst> bursts_of(const std::vector<Said>& talk) {
    std::vector<Burst> out;
    Burst run;
    const auto close = [&] {
        const bool identity = std::any_of(run.lines.begin(), run.lines.end(),
                                          [](const Said* said) { return said->code == "L9"; });
        if (identity && run.lines.size() >= least_lines) {
            out.push_back(run);
        }
        run.lines.clear();
    };
    for (const Said& said : talk) {
        if (said.code == "L14") {
            continue;
        }
        if (!run.lines.empty() && said.t - run.lines.back()->t > together_s) {
            close();
        }
        run.lines.push_back(&said);
    }
    close();
    return out;
}

/// The line without what differs from board to board: the serial number, and the checksum over it.
std::string comparable(const Said& said) {
    if (!said.value("SN:")) {
        return said.line;
    }
    protocol::DecodedLine copy = said.decoded;
    for (protocol::DecodedField& field : copy.fields) {
        if (field.key == "SN:") {
            field.text.clear();
            field.number.reset();
        }
    }
    return protocol::encode_line(copy);
}

double seconds_on_wire(const Said& said) {
    return static_cast<double>(said.line.size() + 2) * 10 / 115200;
}

/// Mean time from the start of one message to the start of the next. A file list is one message.
double spacing_ms(const Burst& burst) {
    std::size_t messages = 0;
    std::string_view before;
    for (const Said* said : burst.lines) {
        messages += said->code == "L7" && before == "L7" ? 0U : 1U;
        before = said->code;
    }
    if (messages < 2) {
        return 0;
    }
    const Said& first = *burst.lines.front();
    const Said& last = *burst.lines.back();
    const double span = last.t - seconds_on_wire(last) - (first.t - seconds_on_wire(first));
    return span * 1000 / static_cast<double>(messages - 1);
}

void compare_lines(const Burst& theirs, const Burst& ours, BurstRow& row) {
    const std::size_t n = std::min(theirs.lines.size(), ours.lines.size());
    for (std::size_t i = 0; i < n; ++i) {
        const Said& a = *theirs.lines[i];
        const Said& b = *ours.lines[i];
        const double offset = b.t - ours.lines[0]->t - (a.t - theirs.lines[0]->t);
        row.worst_offset_ms = std::max(row.worst_offset_ms, std::abs(offset) * 1000);
        if (comparable(a) != comparable(b) && row.difference.empty()) {
            row.difference = fmt::format("line {}: recorded {}, ours {}", i + 1, a.label, b.label);
        }
    }
    if (theirs.lines.size() != ours.lines.size() && row.difference.empty()) {
        row.difference = fmt::format("{} lines recorded, {} ours", theirs.lines.size(), ours.lines.size());
    }
    row.same = row.difference.empty();
}

}  // namespace

std::vector<BurstRow> compare_bursts(const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                     const Tolerances& tolerances) {
    const std::vector<Burst> recorded = bursts_of(theirs);
    const std::vector<Burst> given = bursts_of(ours);
    std::vector<BurstRow> rows;
    for (std::size_t i = 0; i < std::max(recorded.size(), given.size()); ++i) {
        BurstRow row;
        if (i < recorded.size()) {
            row.recorded_t = recorded[i].lines.front()->t;
            row.recorded_lines = recorded[i].lines.size();
            row.recorded_spacing_ms = spacing_ms(recorded[i]);
        }
        if (i < given.size()) {
            row.our_t = given[i].lines.front()->t;
            row.our_lines = given[i].lines.size();
            row.our_spacing_ms = spacing_ms(given[i]);
        }
        if (row.recorded_t && row.our_t) {
            compare_lines(recorded[i], given[i], row);
            row.ok = row.same &&
                     std::abs(row.our_spacing_ms - tolerances.burst_tick_ms) <= tolerances.burst_spacing_ms;
        } else {
            row.difference = row.our_t ? "not in the recording" : "missing";
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace fauxboard::record::detail
