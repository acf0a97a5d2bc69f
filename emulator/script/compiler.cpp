#include "emulator/script/compiler.h"

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/script/placeholders.h"

namespace fauxboard::script {
namespace {

using behaviour::ObjectReader;

std::optional<Json> nothing(std::string_view) {
    return std::nullopt;
}

/// Stands for what a group of a pattern will have found: the shortest that is number and text.
std::optional<Json> sample(std::string_view) {
    return Json("1");
}

bool step_takes_time(const Step& step) {
    if (step.kind->role == Role::watch) {
        // What is so already is there at once; what happens, happens once.
        return step.trigger.kind == Trigger::Kind::time ? step.trigger.time > SimTime{0}
                                                        : !step.trigger.is_state();
    }
    const auto block_takes = [](const Block& block) { return takes_time(block.steps); };
    return step.until_first ? std::all_of(step.blocks.begin(), step.blocks.end(), block_takes)
                            : std::any_of(step.blocks.begin(), step.blocks.end(), block_takes);
}

}  // namespace

bool ends(const Step& step) {
    if (step.kind->role != Role::block) {
        return true;
    }
    const auto block_ends = [](const Block& block) { return ends(block.steps); };
    if (step.until_first) {
        return std::any_of(step.blocks.begin(), step.blocks.end(), block_ends);
    }
    return step.rounds.has_value() && std::all_of(step.blocks.begin(), step.blocks.end(), block_ends);
}

bool ends(const std::vector<Step>& steps) {
    return std::all_of(steps.begin(), steps.end(), [](const Step& step) { return ends(step); });
}

bool takes_time(const std::vector<Step>& steps) {
    return std::any_of(steps.begin(), steps.end(), step_takes_time);
}

Shared::Shared(const Cast& who, const Scenario::Limits& defaults)
    : cast(who), limits(defaults), probe(who.profile, {}, {}) {
    for (std::size_t i = 0; i < who.profile->variables.size(); ++i) {
        names.variables.emplace(who.profile->variables[i].name, i);
    }
    for (std::size_t i = 0; i < who.profile->frames.size(); ++i) {
        frames.emplace(who.profile->frames[i].name, i);
    }
}

std::vector<Step> Compiler::steps(const Json& node, const std::string& pointer) {
    std::vector<Step> out;
    if (!node.is_array()) {
        findings_.add(pointer, behaviour::found(node) + "; expected a list of steps");
        return out;
    }
    if (node.empty()) {
        findings_.add(pointer, "an empty list; expected at least one step");
    }
    for (std::size_t i = 0; i < node.size(); ++i) {
        if (++shared_.steps > most_steps) {
            findings_.add(pointer, fmt::format("more than {} steps, those of included files counted each "
                                               "time; repeat says the same in fewer",
                                               most_steps));
            return {};
        }
        out.push_back(step(node[i], fmt::format("{}/{}", pointer, i)));
    }
    std::erase_if(out, [](const Step& each) { return each.kind == nullptr; });
    check_reached(out, pointer);
    return out;
}

void Compiler::check_reached(const std::vector<Step>& steps, const std::string&) {
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
        if (!ends(steps[i])) {
            findings_.add(
                steps[i + 1].where.pointer,
                fmt::format("this step is never reached: the one before it, \"{}\" in line {}, never "
                            "ends; give it a number of rounds, or put the two side by side with "
                            "\"together\"",
                            steps[i].kind->name, steps[i].where.line));
            return;
        }
    }
}

const StepKind* Compiler::kind_of(const Json& node, const std::string& pointer) {
    if (!node.is_object()) {
        findings_.add(pointer, behaviour::found(node) + "; expected a step, such as {\"wait\": \"500ms\"}");
        return nullptr;
    }
    std::vector<const StepKind*> found;
    std::string first;
    for (const auto& [key, value] : node.items()) {
        if (const StepKind* kind = find_step_kind(key)) {
            found.push_back(kind);
        } else if (first.empty() && key != "why" && key != "comment") {
            first = key;
        }
    }
    if (found.size() == 1) {
        return found[0];
    }
    if (found.size() > 1) {
        findings_.add(pointer, fmt::format("two steps in one: \"{}\" and \"{}\"; make a step of each",
                                           found[0]->name, found[1]->name));
        return nullptr;
    }
    std::vector<std::string_view> names;
    for (const StepKind& kind : step_kinds()) {
        names.push_back(kind.name);
    }
    findings_.add(
        pointer,
        first.empty()
            ? fmt::format("a step without anything to do; expected one of {}", fmt::join(names, ", "))
            : fmt::format("unknown step \"{}\"; expected one of {}", first, fmt::join(names, ", ")),
        std::string(behaviour::nearest(first, names)));
    return nullptr;
}

/// Every placeholder left must be the group of a pattern before it. Whether there are any.
bool Compiler::check_mentions(const Json& node, const std::string& pointer, const StepKind& kind) {
    const std::vector<Mention> all = mentions(node, pointer, false);
    for (const Mention& mention : all) {
        if (mention.name.empty()) {
            findings_.add(mention.pointer,
                          "\"${\" without a name and a closing brace; write ${name}, or $${ for the "
                          "two characters");
        } else if (kind.role == Role::block) {
            findings_.add(
                mention.pointer,
                fmt::format("\"${{{}}}\" is no parameter; expected one, since \"{}\" is settled before "
                            "the run begins",
                            mention.name, kind.name));
        } else if (!shared_.captures.contains(mention.name)) {
            const std::vector<std::string_view> names(shared_.captures.begin(), shared_.captures.end());
            findings_.add(
                mention.pointer,
                fmt::format("\"${{{}}}\" is unknown; expected a parameter, or a group (?P<{}>...) of a "
                            "pattern in a step before this one",
                            mention.name, mention.name),
                std::string(behaviour::nearest(mention.name, names)));
        }
    }
    return !all.empty();
}

void Compiler::compile(const StepKind& kind, const Json& node, const std::string& pointer, Step& out) {
    ObjectReader reader(node, pointer, findings_);
    reader.text("why", out.why, 500);
    const Json* value = reader.get(kind.name);
    out.words = std::string(kind.name);
    kind.compile(*this, *value, reader, out);
    reader.finish();
}

Step Compiler::step(const Json& node, const std::string& pointer) {
    Step out;
    const behaviour::Problem place = findings_.document.problem(pointer, {});
    out.where = {place.file, place.line, pointer};
    out.kind = kind_of(node, pointer);
    if (out.kind == nullptr) {
        return out;
    }
    std::size_t problems = findings_.problems.size();
    out.dynamic = check_mentions(node, pointer, *out.kind);
    if (out.kind->role == Role::block && findings_.problems.size() != problems) {
        out.kind = nullptr;  // nothing to try it with
        return out;
    }
    sampling_ = filled_ = out.dynamic;
    problems = findings_.problems.size();
    compile(*out.kind, filled(node, out.dynamic ? Lookup(sample) : Lookup(nothing), Escapes::resolve, false),
            pointer, out);
    sampling_ = filled_ = false;
    if (findings_.problems.size() == problems) {
        if (out.trigger.pattern) {
            for (const std::string& name : out.trigger.pattern->names()) {
                shared_.captures.insert(name);
            }
        }
        if (out.dynamic) {
            out.document = document_;
            out.source = std::make_shared<const Json>(node);
        }
    }
    return out;
}

Step Compiler::step_now(const Step& dynamic, const Captures& captures) {
    Step out;
    out.where = dynamic.where;
    out.kind = dynamic.kind;
    filled_ = true;
    const auto lookup = [&captures](std::string_view name) -> std::optional<Json> {
        const auto hit = captures.find(name);
        return hit == captures.end() ? std::nullopt : std::optional<Json>(hit->second);
    };
    compile(*out.kind, filled(*dynamic.source, lookup, Escapes::resolve, false), out.where.pointer, out);
    filled_ = false;
    return out;
}

// Values with their units.
// -----------------------------------------------------------------------------------------------

Json Compiler::in_unit(const Json& value, std::string_view unit, const std::string& pointer) {
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        if (const auto number = quantity_from_text(text, unit); number && (!unit.empty() || filled_)) {
            return *number;
        }
        if (!unit.empty()) {
            findings_.add(pointer, fmt::format("{}; expected a number with its unit, such as {}",
                                               behaviour::found(value), quantity_example(unit)));
            return 0;
        }
    } else if (value.is_number() && !unit.empty() && value.get<double>() != 0) {
        findings_.add(pointer, fmt::format("{} without a unit; expected a number with its unit, such as {}",
                                           behaviour::found(value), quantity_example(unit)));
    }
    return value;
}

SimTime Compiler::time(const Json& node, const std::string& pointer, SimTime min, SimTime max) {
    const auto time = node.is_string() ? time_from_text(node.get_ref<const std::string&>()) : std::nullopt;
    if (!time) {
        findings_.add(pointer, fmt::format("{}; expected a time with its unit, such as \"500ms\", \"10s\" or "
                                           "\"5min\"",
                                           behaviour::found(node)));
        return min;
    }
    if (*time < min || *time > max) {
        findings_.add(pointer, fmt::format("{}; expected a time from {} to {}", behaviour::found(node),
                                           time_words(min), time_words(max)));
        return min;
    }
    return *time;
}

void Compiler::limits(ObjectReader& reader, SimTime fallback, Step& out) {
    constexpr SimTime shortest{1000};
    out.within = fallback;
    if (const Json* within = reader.get("within")) {
        out.within = time(*within, reader.pointer("within"), shortest, longest_limit);
    }
    if (const Json* real = reader.get("real")) {
        out.real = time(*real, reader.pointer("real"), shortest, longest_limit);
    }
}

}  // namespace fauxboard::script
