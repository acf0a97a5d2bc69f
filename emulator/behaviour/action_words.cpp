#include "emulator/behaviour/action_words.h"

#include <algorithm>

#include "emulator/behaviour/document.h"
#include "emulator/behaviour/reader.h"
#include "emulator/behaviour/rule_compiler.h"

namespace fauxboard::behaviour {
namespace {

Json json_of(const Value& value) {
    return value.is_text() ? Json(value.text) : value.is_number() ? Json(value.number) : Json(nullptr);
}

std::string one_line(const Json& json) {
    return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

/// A phrase, or a name that needs no arguments; nothing for other words.
std::vector<ActionCall> plain_call(std::string_view words) {
    const ActionInfo* info = find_world_action(words);
    if (info == nullptr ||
        std::any_of(info->args.begin(), info->args.end(), [](const ArgInfo& arg) { return arg.required; })) {
        return {};
    }
    ActionCall call;
    call.info = info;
    call.args.resize(info->args.size());
    return {call};
}

}  // namespace

std::string action_words(const ActionCall& call, const Scope& scope,
                         std::span<const VariableInfo> variables) {
    Json inside = Json::object();
    if (call.info->run == nullptr) {
        const std::string place =
            call.variable ? "var." + variables[*call.variable].name : std::string(call.field->path);
        inside[place] = json_of(call.args[0].evaluate(scope));
        return one_line({{call.add ? "add" : "set", std::move(inside)}});
    }
    for (std::size_t i = 0; i < call.args.size(); ++i) {
        const Value value = call.args[i].evaluate(scope);
        if (!value.none()) {
            inside[std::string(call.info->args[i].name)] = json_of(value);
        }
    }
    if (inside.empty()) {
        return std::string(call.info->phrase.empty() ? call.info->name : call.info->phrase);
    }
    return one_line({{std::string(call.info->name), std::move(inside)}});
}

std::vector<ActionCall> parse_action_words(std::string_view words, const Profile& profile) {
    if (!words.starts_with('{')) {
        std::vector<ActionCall> calls = plain_call(words);
        if (calls.empty()) {
            throw ActionWordsError("is nothing that can be done to the machine");
        }
        return calls;
    }
    try {
        const Document document = parse_document({"do", std::string(words)});
        Findings findings{document, {}};
        Names names;
        for (std::size_t i = 0; i < profile.variables.size(); ++i) {
            names.variables.emplace(profile.variables[i].name, i);
        }
        const std::map<std::string, std::size_t, std::less<>> no_frames;  // actions name none
        RuleCompiler compiler(findings, names, no_frames, *profile.machine);
        std::vector<ActionCall> calls = compiler.actions(document.root, "");
        if (!findings.problems.empty()) {
            throw ActionWordsError("cannot be done to the machine: " + findings.problems.front().message);
        }
        return calls;
    } catch (const ProfileError& error) {
        throw ActionWordsError("cannot be read: " + error.problems().front().message);
    }
}

}  // namespace fauxboard::behaviour
