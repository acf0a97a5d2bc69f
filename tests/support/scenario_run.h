#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/document.h"
#include "emulator/script/loader.h"
#include "emulator/script/outcome.h"

namespace fauxboard::testing {

/// What came of playing a scenario in virtual time, as fast as it goes.
struct ScenarioRun {
    script::Outcome outcome;
    std::string recording;  ///< all that passed on the line and all that happened, with its times
    std::vector<std::string> notes;
    std::string junit;
    std::size_t crashes = 0;  ///< of the virtual screen
    std::vector<std::string> findings;
};

struct ScenarioSetup {
    script::Arguments arguments;
    std::uint64_t seed = 1;
    bool pacing = true;
    double duration_s = 0;  ///< ended from outside then; 0: never
};

/// The text of a shipped scenario.
behaviour::SourceText shipped_scenario(std::string_view name);
/// A shipped scenario with something changed.
behaviour::SourceText changed_scenario(std::string_view name,
                                       const std::function<void(behaviour::Json& root)>& change);

/// Loads it and plays it as `run --script --speed max` does. Throws behaviour::ProfileError.
ScenarioRun play(const behaviour::SourceText& source, const ScenarioSetup& setup = {});
/// The same of these steps, on an A30T without a screen ("screen": null) or with one.
ScenarioRun play_steps(std::string_view steps, bool with_screen = false, const ScenarioSetup& setup = {});

/// Steps on an A30T without a screen, checked and compiled.
std::shared_ptr<const script::Scenario> load_steps(std::string_view steps);

}  // namespace fauxboard::testing
