#pragma once

#include <span>
#include <string>
#include <string_view>

#include "emulator/screen/tour.h"

namespace fauxboard::screen {

/// A line a button and a line of sums, for a terminal; the sentences of what was not met below.
std::string tour_table(std::span<const TourResult> results);

/// {"screen": name, "passed": true, "buttons": 130, "met": 130, ..., "results": [...], "findings": [...]},
/// indented; see screen_json.h for their objects. With the counters of a screen that sends one command at a
/// time also "timeouts", "desynchronised", "stalls", "jams" and "crashes".
std::string tour_json(std::string_view screen, std::span<const TourResult> results,
                      std::span<const Finding> findings = {}, const ScreenCounters* talk = nullptr);

/// The same of them in a line: "0 time-outs, 0 desynchronised, ...".
std::string talk_text(const ScreenCounters& counters);

/// JUnit's XML: one test case a button, its page as class name, the sentence as failure.
std::string tour_junit(std::string_view screen, std::span<const TourResult> results);

/// The findings of a screen, a line each: "3 x  L18 P26 S15: would crash: ...".
std::string findings_text(std::span<const Finding> findings);

}  // namespace fauxboard::screen
