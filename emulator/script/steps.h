#pragma once

// What a scenario is made of: one table of steps, one of triggers. Files are checked by it, steps are carried
// out by it, and the reference is made from it.

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "emulator/behaviour/reader.h"
#include "emulator/script/scenario.h"
#include "emulator/script/stage.h"

namespace fauxboard::script {

class Compiler;

/// A key of a step beside the one that names it.
struct KeyInfo {
    std::string_view name;
    std::string_view type;
    std::string_view help;
};

enum class Role : std::uint8_t {
    act,    ///< done at once
    watch,  ///< takes until what it is about has come, or its limit
    block,  ///< holds other steps
};

/// A fault that the scenario has made: one of the line, or one of the printer.
struct MadeFault {
    fault::FaultId line = 0;
    unsigned printer = 0;
};

/// What an act has at hand.
struct Acting {
    Stage& stage;
    std::map<std::string, MadeFault, std::less<>>& faults;  ///< by name
};

/// One row is the whole declaration of a step.
struct StepKind {
    std::string_view name;
    std::string_view type;  ///< of its value
    std::string_view help;
    std::string_view example;
    std::span<const KeyInfo> keys;
    Role role;
    /// `value` stands under the step's name, `reader` is at the step.
    void (*compile)(Compiler& compiler, const Json& value, behaviour::ObjectReader& reader, Step& out);
    /// Acts only. What went wrong, as the end of a sentence; empty when it was done.
    std::string (*act)(Acting& acting, const Step& step) = nullptr;
};

std::span<const StepKind> step_kinds();
const StepKind* find_step_kind(std::string_view name);

/// Something to wait for, as it is written.
struct TriggerInfo {
    std::string_view name;
    std::string_view type;
    std::string_view help;
    Trigger::Kind kind;
};
std::span<const TriggerInfo> trigger_kinds();

/// The reference: {"steps": [...], "triggers": [...], "keys": [...]}.
Json describe_scenarios();

namespace rows {
std::span<const StepKind> act_steps();
std::span<const StepKind> display_steps();
std::span<const StepKind> watch_steps();
std::span<const StepKind> block_steps();
std::span<const StepKind> upload_steps();
}  // namespace rows

}  // namespace fauxboard::script
