// How a scenario stands, told while it runs and at its end.

#include <doctest/doctest.h>

#include "emulator/script/progress.h"
#include "tests/support/board_driver.h"
#include "tests/support/scenario_run.h"

namespace fauxboard::script {
namespace {

/// A board with nothing beside it: neither screen nor faults.
class BareStage final : public Stage {
  public:
    void visit(const std::function<void(board::Board&, SimTime)>& use) override { use(driver.board(), now); }
    fault::FaultControl* faults() override { return nullptr; }
    const screen::Screen* screen() override { return nullptr; }
    screen::PressResult press(std::string_view) override { return {}; }
    void note(std::string_view) override {}

    testing::BoardDriver driver;
    SimTime now{0};
};

struct Run {
    explicit Run(std::string_view steps) : player(testing::load_steps(steps), 0) {}
    Json at(SimTime now) {
        for (stage.now = std::min(now, player.advance(stage.now, {}, stage));
             stage.now < now && !player.done();
             stage.now = std::min(now, player.advance(stage.now, {}, stage))) {
        }
        if (!player.done()) player.advance(now, {}, stage);
        return progress_json(player);
    }
    BareStage stage;
    Player player;
};

Json states(const Json& progress) {
    Json out = Json::array();
    for (const Json& step : progress["steps"]) {
        out.push_back(step["state"]);
    }
    return out;
}

TEST_CASE("progress: each step waits, runs, and passes, with the time at which it began") {
    Run run(R"([{"wait": "1s", "why": "it warms up"}, {"wait": "2s"}, {"note": "done"}])");
    Json now = run.at(SimTime{500'000});
    CHECK(states(now) == Json({"running", "waiting", "waiting"}));
    CHECK(now["name"] == "test");
    CHECK(now["steps"][0]["words"] == "it warms up");
    CHECK(now["steps"][0]["at"] == 0.0);
    CHECK_FALSE(now["steps"][1].contains("at"));
    CHECK_FALSE(now.contains("verdict"));
    REQUIRE(now["branches"].size() == 1);
    CHECK(now["branches"][0]["words"] == "it warms up");
    CHECK(now["branches"][0]["since"] == 0.0);

    now = run.at(SimTime{1'500'000});
    CHECK(states(now) == Json({"passed", "running", "waiting"}));
    CHECK(now["branches"][0]["since"] == 1.0);

    now = run.at(SimTime{4'000'000});
    CHECK(states(now) == Json({"passed", "passed", "passed"}));
    CHECK(now["branches"].empty());
    CHECK(now["verdict"] == "passed");
    CHECK(now["sentence"] == "test passed: 3 steps in 3 s of the board's time.");
}

TEST_CASE("progress: branches side by side are told by their names") {
    Run run(R"([{"together": [{"name": "slow", "steps": [{"wait": "3s"}]},
                              {"name": "quick", "steps": [{"wait": "1s"}, {"wait": "5s"}]}]}])");
    const Json now = run.at(SimTime{2'000'000});
    REQUIRE(now["branches"].size() == 2);
    CHECK(now["branches"][0]["name"] == "slow");
    CHECK(now["branches"][0]["since"] == 0.0);
    CHECK(now["branches"][1]["name"] == "quick");
    CHECK(now["branches"][1]["since"] == 1.0);
}

TEST_CASE("progress: the step that failed says why, and those behind it were not reached") {
    Run run(R"([{"wait": {"event": "motion.homed"}, "within": "1s"}, {"note": "never said"}])");
    const Json now = run.at(SimTime{2'000'000});
    CHECK(states(now) == Json({"failed", "waiting"}));
    CHECK(now["verdict"] == "timed out");
    CHECK(now["steps"][0]["sentence"] == now["sentence"]);
}

TEST_CASE("steps that want what a run has not say so and fail") {
    const auto sentence = [](std::string_view steps) {
        Run run(steps);
        run.at(SimTime{1'000'000});
        REQUIRE(run.player.done());
        return run.player.outcome().sentence;
    };
    CHECK(sentence(R"([{"fault": "drop:every=3"}])").find("the line of this run takes no faults") !=
          std::string::npos);
    CHECK(sentence(R"([{"clear": "all"}])").find("the line of this run takes no faults") !=
          std::string::npos);
}

}  // namespace
}  // namespace fauxboard::script
