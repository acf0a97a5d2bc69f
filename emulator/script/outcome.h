#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/script/scenario.h"

namespace fauxboard::script {

/// One thing that passed, for the record of a failure. Text without frame and checksum, UTF-8.
struct Talk {
    enum class From : std::uint8_t { board, screen, event, usb, host };
    SimTime at{0};
    From from = From::board;
    std::string text;
};

/// What came of one of the scenario's outermost steps.
struct StepResult {
    enum class Verdict : std::uint8_t { passed, failed, not_reached };
    Where where;
    std::string words;  ///< the author's sentence, or ours
    Verdict verdict = Verdict::not_reached;
    SimTime at{0};
    SimTime took{0};
    std::string sentence;  ///< why it failed
};

/// What came of a scenario.
struct Outcome {
    enum class Verdict : std::uint8_t {
        passed,
        failed,       ///< something was not as it must be
        timed_out,    ///< a wait was in vain
        interrupted,  ///< it was ended before it was through
    };
    Verdict verdict = Verdict::passed;
    std::string sentence;        ///< one, for a person
    SimTime at{0};               ///< virtual time of the end
    std::optional<Where> where;  ///< of the step that failed, or was under way
    std::size_t steps = 0;       ///< carried out
    std::vector<StepResult> results;
    Captures captures;
    std::vector<Talk> talk;  ///< the last that passed
};

/// As others may see it: without the passwords that lines set.
Outcome for_others(Outcome outcome);

std::string_view verdict_name(Outcome::Verdict verdict);

/// {"scenario", "verdict", "sentence", "t", "where", "steps", "captures", "talk", ...}. `more` is what the
/// host adds: state, recording, faults.
Json outcome_json(const Scenario& scenario, const Outcome& outcome, const Json& more);

/// JUnit's XML: a test case for each of the outermost steps.
std::string outcome_junit(const Scenario& scenario, const Outcome& outcome);

}  // namespace fauxboard::script
