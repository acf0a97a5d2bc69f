#include "emulator/script/outcome.h"

#include <array>

#include "emulator/behaviour/document.h"
#include "emulator/behaviour/junit.h"
#include "protocol/secrets.h"

namespace fauxboard::script {
namespace {

constexpr std::array<std::string_view, 4> verdict_names{"passed", "failed", "timed out", "interrupted"};
constexpr std::array<std::string_view, 3> step_verdicts{"passed", "failed", "not reached"};
constexpr std::array<std::string_view, 5> talkers{"board", "screen", "event", "usb", "host"};

Json where_json(const Where& where) {
    return {{"file", where.file}, {"line", where.line}, {"pointer", where.pointer}};
}

}  // namespace

Outcome for_others(Outcome outcome) {
    const auto mask = [](std::string& text) { text = protocol::mask_secrets(text); };
    mask(outcome.sentence);
    for (StepResult& result : outcome.results) {
        mask(result.words);
        mask(result.sentence);
    }
    for (Talk& each : outcome.talk) {
        mask(each.text);
    }
    return outcome;
}

std::string_view verdict_name(Outcome::Verdict verdict) {
    return verdict_names[static_cast<std::size_t>(verdict)];
}

Json outcome_json(const Scenario& scenario, const Outcome& outcome, const Json& more) {
    Json out{{"scenario", scenario.name},
             {"profile", scenario.cast.profile->name},
             {"verdict", verdict_name(outcome.verdict)},
             {"sentence", outcome.sentence},
             {"t", machine::to_seconds(outcome.at)},
             {"steps_done", outcome.steps}};
    if (scenario.cast.screen != nullptr) {
        out["screen"] = scenario.cast.screen->name;
    }
    if (outcome.where) {
        out["where"] = where_json(*outcome.where);
    }
    Json parameters = Json::object();
    for (const auto& [name, value] : scenario.parameters) {
        parameters[name] = Json::parse(value);
    }
    out["parameters"] = std::move(parameters);
    Json captures = Json::object();
    for (const auto& [name, text] : outcome.captures) {
        captures[name] = text;
    }
    out["captures"] = std::move(captures);
    Json steps = Json::array();
    for (const StepResult& result : outcome.results) {
        Json step{{"step", result.words},
                  {"verdict", step_verdicts[static_cast<std::size_t>(result.verdict)]},
                  {"line", result.where.line}};
        if (result.verdict != StepResult::Verdict::not_reached) {
            step["t"] = machine::to_seconds(result.at);
            step["took"] = machine::to_seconds(result.took);
        }
        steps.push_back(std::move(step));
    }
    out["steps"] = std::move(steps);
    Json talk = Json::array();
    for (const Talk& each : outcome.talk) {
        talk.push_back({{"t", machine::to_seconds(each.at)},
                        {"from", talkers[static_cast<std::size_t>(each.from)]},
                        {"line", each.text}});
    }
    out["talk"] = std::move(talk);
    out.update(more);
    return out;
}

std::string outcome_junit(const Scenario& scenario, const Outcome& outcome) {
    std::vector<behaviour::JUnitCase> cases;
    for (const StepResult& result : outcome.results) {
        behaviour::JUnitCase one;
        one.class_name = "scenario." + scenario.name;
        one.name = std::to_string(cases.size() + 1) + ". " + result.words;
        one.seconds = machine::to_seconds(result.took);
        if (result.verdict == StepResult::Verdict::failed) {
            one.failure = verdict_name(outcome.verdict);
            one.message = result.sentence;
        } else if (result.verdict == StepResult::Verdict::not_reached) {
            one.skipped = true;
            one.message = "not reached";
        }
        cases.push_back(std::move(one));
    }
    return behaviour::junit_text("scenario " + scenario.name, cases);
}

}  // namespace fauxboard::script
