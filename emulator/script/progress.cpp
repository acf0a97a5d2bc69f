#include "emulator/script/progress.h"

namespace fauxboard::script {
namespace {

std::string_view state_words(StepResult::Verdict verdict) {
    switch (verdict) {
        case StepResult::Verdict::passed:
            return "passed";
        case StepResult::Verdict::failed:
            return "failed";
        case StepResult::Verdict::not_reached:
            break;
    }
    return "waiting";
}

}  // namespace

Json progress_json(const Player& player) {
    Json out{{"name", player.scenario().name},
             {"title", player.scenario().title},
             {"steps", Json::array()},
             {"branches", Json::array()}};
    const std::vector<StepResult>& results = player.results();
    for (std::size_t i = 0; i < results.size(); ++i) {
        const StepResult& result = results[i];
        const bool running = !player.done() && i == player.running();
        const bool reached = running || result.verdict != StepResult::Verdict::not_reached;
        Json step{{"words", result.words}, {"state", running ? "running" : state_words(result.verdict)}};
        if (reached) {
            step["at"] = machine::to_seconds(result.at);
        }
        if (!result.sentence.empty()) {
            step["sentence"] = result.sentence;
        }
        out["steps"].push_back(std::move(step));
    }
    for (const Player::Waiting& waiting : player.waiting()) {
        out["branches"].push_back({{"name", waiting.branch},
                                   {"words", waiting.words},
                                   {"since", machine::to_seconds(waiting.since)}});
    }
    if (player.done()) {
        out["verdict"] = verdict_name(player.outcome().verdict);
        out["sentence"] = player.outcome().sentence;
    }
    return out;
}

}  // namespace fauxboard::script
