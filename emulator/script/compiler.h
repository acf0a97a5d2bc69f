#pragma once

// Checking and compiling the steps of one file. Private to script/.

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/reader.h"
#include "emulator/behaviour/rule_compiler.h"
#include "emulator/board/board.h"
#include "emulator/script/scenario.h"
#include "emulator/script/steps.h"

namespace fauxboard::script {

/// What all files of a scenario share while they are compiled, in the order of their steps.
struct Shared {
    Shared(const Cast& who, const Scenario::Limits& defaults);

    const Cast& cast;
    Scenario::Limits limits;
    board::Board probe;  ///< never switched on; knows the bounds of what is set
    behaviour::Names names;
    std::map<std::string, std::size_t, std::less<>> frames;
    std::set<std::string, std::less<>> captures;  ///< groups of patterns so far
    std::set<std::string, std::less<>> faults;    ///< names of faults so far
    std::size_t steps = 0;
    std::size_t patterns = 0;  ///< their sizes, all together
    std::size_t branches = 1;  ///< most that can be under way at once
    /// Compiles another file where it stands; null while a step is compiled when it is its turn.
    std::function<Block(const std::string& name, const std::string& from, const Json& arguments,
                        behaviour::Findings& findings, const std::string& pointer)>
        include;
};

class Compiler {
  public:
    static constexpr std::size_t most_steps = 20'000;
    static constexpr std::size_t most_branches = 64;
    static constexpr std::size_t most_patterns = 1'000'000;  ///< of Pattern::size(), some 16 bytes each
    static constexpr SimTime longest_limit = std::chrono::hours(24 * 366);

    Compiler(Shared& shared, behaviour::Findings& findings,
             std::shared_ptr<const behaviour::Document> document)
        : shared_(shared), findings_(findings), document_(std::move(document)) {}

    /// A list of steps.
    std::vector<Step> steps(const Json& node, const std::string& pointer);
    /// A step whose captures have their values. Problems go to the findings.
    Step step_now(const Step& dynamic, const Captures& captures);

    // For the rows of the table.
    // -------------------------------------------------------------------------------------------
    Shared& shared() { return shared_; }
    behaviour::Findings& findings() { return findings_; }
    /// {"event": "motion.homed"}; a text is what `text` says: a time, or a pattern of lines.
    Trigger trigger(const Json& node, const std::string& pointer, Trigger::Kind text);
    /// {"heaters.nozzle.true": {"min": "198C"}}
    void conditions(const Json& node, const std::string& pointer, Trigger& out);
    std::vector<behaviour::ActionCall> actions(const Json& node, const std::string& pointer);
    std::vector<behaviour::ActionCall> assignments(const Json& node, const std::string& pointer);
    std::shared_ptr<const Pattern> pattern(const Json& node, const std::string& pointer);
    /// A time with its unit.
    SimTime time(const Json& node, const std::string& pointer, SimTime min, SimTime max);
    void limits(behaviour::ObjectReader& reader, SimTime fallback, Step& out);
    /// The bytes of a text for the line, without line ends.
    std::string line(const Json& node, const std::string& pointer, std::size_t most, bool whole_line);
    /// The path of a button of the screen; reported when there is none.
    void button(const std::string& path, const std::string& pointer);
    bool needs_screen(const std::string& pointer, std::string_view what);
    bool sampling() const { return sampling_; }

  private:
    Step step(const Json& node, const std::string& pointer);
    const StepKind* kind_of(const Json& node, const std::string& pointer);
    bool check_mentions(const Json& node, const std::string& pointer, const StepKind& kind);
    void compile(const StepKind& kind, const Json& node, const std::string& pointer, Step& out);
    void check_reached(const std::vector<Step>& steps, const std::string& pointer);
    Json in_unit(const Json& value, std::string_view unit, const std::string& pointer);
    Json condition_in_unit(const std::string& path, const Json& test, const std::string& pointer);
    Json arguments_in_units(const Json& node, const std::string& pointer);
    Json call_in_units(const std::string& name, const Json& arguments, const std::string& pointer);

    Shared& shared_;
    behaviour::Findings& findings_;
    std::shared_ptr<const behaviour::Document> document_;
    bool sampling_ = false;  ///< captures stand as "1": whether it is in bounds is not known yet
    bool filled_ = false;    ///< texts may be numbers that were captured
};

/// Whether it can come to its end.
bool ends(const Step& step);
bool ends(const std::vector<Step>& steps);
/// Whether it is sure that virtual time passes in it.
bool takes_time(const std::vector<Step>& steps);

/// "at least 198C", for the words of a condition.
std::string condition_words(const std::string& path, const Json& test);

}  // namespace fauxboard::script
