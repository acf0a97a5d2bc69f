#pragma once

#include <map>
#include <string>
#include <vector>

#include "emulator/behaviour/profile.h"
#include "emulator/behaviour/reader.h"

namespace fauxboard::behaviour {

/// Compiles the parts of rules; shared by everything in a profile that has conditions, actions or frames to
/// send.
class RuleCompiler {
  public:
    RuleCompiler(Findings& findings, const Names& names,
                 const std::map<std::string, std::size_t, std::less<>>& frames,
                 const machine::MachineConfig& machine)
        : findings_(findings), names_(names), frames_(frames), machine_(machine) {}

    /// {"motion.homed": true, "S": {"min": 1, "max": 8}}
    std::vector<Condition> conditions(const Json& node, const std::string& pointer);
    /// "motion.home", {"heater.target": {...}}, or a list of these.
    std::vector<ActionCall> actions(const Json& node, const std::string& pointer);
    /// "L2", {"frame": "L2", "times": 2, "now": true, "when": {...}}, or a list of these.
    std::vector<Send> sends(const Json& node, const std::string& pointer);
    /// One rule object or a list of them.
    std::vector<Rule> rules(const Json& node, const std::string& pointer);
    /// The frame's index; reported when there is none of the name.
    std::optional<std::size_t> frame(const Json& node, const std::string& pointer);
    /// {"path": value}: assignments, for `set` and `add`.
    void assignments(const Json& node, const std::string& pointer, bool add, std::vector<ActionCall>& out);

  private:
    void condition(const std::string& reference, const Json& node, const std::string& pointer,
                   std::vector<Condition>& out);
    void condition_tests(const Condition& base, const std::string& left, const Json& node,
                         const std::string& pointer, std::vector<Condition>& out);
    void condition_range(const Condition& base, const std::string& left, ObjectReader& reader,
                         const std::string& pointer, std::vector<Condition>& out);
    void call(const std::string& name, const Json* args, const std::string& pointer,
              std::vector<ActionCall>& out);
    void argument(const ArgInfo& info, const Json& node, const std::string& pointer, Operand& out);
    void check_reach(const Operand& left, const Operand& min, const Operand& max, const std::string& pointer);
    void check_name(const KnownNames& known, const Operand& given, const std::string& pointer);
    Operand reference(std::string_view text, const std::string& pointer);
    Operand value(const Json& node, const std::string& pointer);
    bool literal(const Json& node, const std::string& pointer, Operand& out);
    bool compared(const Operand& left, const std::string& name, const Json& node, const std::string& pointer,
                  Operand& out);
    Send send(const Json& node, const std::string& pointer);
    Rule rule(const Json& node, const std::string& pointer);

    Findings& findings_;
    const Names& names_;
    const std::map<std::string, std::size_t, std::less<>>& frames_;
    const machine::MachineConfig& machine_;
};

}  // namespace fauxboard::behaviour
