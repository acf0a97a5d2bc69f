// What each step does, one at a time, on a board in virtual time.

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "emulator/script/player.h"
#include "tests/support/scenario_run.h"

namespace fauxboard::script {
namespace {

using testing::play_steps;
using testing::ScenarioRun;
using Verdict = Outcome::Verdict;

std::string sentence_of(std::string_view steps, bool with_screen = false) {
    return play_steps(steps, with_screen).outcome.sentence;
}

bool passes(std::string_view steps, bool with_screen = false) {
    const ScenarioRun run = play_steps(steps, with_screen);
    CAPTURE(run.outcome.sentence);
    CHECK(run.outcome.verdict == Verdict::passed);
    return run.outcome.verdict == Verdict::passed;
}

TEST_CASE("wait: virtual time passes, to the microsecond") {
    const ScenarioRun run = play_steps(R"([{"wait": "1500ms"}, {"wait": "2us"}])");
    CHECK(run.outcome.at == SimTime{1'500'002});
    CHECK(run.outcome.sentence == "test passed: 2 steps in 1.5 s of the board's time.");
}

TEST_CASE("what the board says at its start is heard from its first line on") {
    CHECK(passes(R"([{"expect_next": "^L3 "}, {"expect_next": "^L1 "}, {"expect_next": "^L2 "}])"));
}

TEST_CASE("request and expect: the board is asked and answers; what groups find are values later") {
    const ScenarioRun run = play_steps(R"([
        {"wait": "5s"},
        {"request": "M104 S85"},
        {"expect": "^L2 .*/(?P<target>85)\\.0"},
        {"set": {"heaters.bed.target": "${target}C"}},
        {"check": {"heaters.bed.target": "85C"}},
        {"request": "M140 S${target}"},
        {"expect": {"request": "^M140 S85$"}},
        {"do": {"fan.pwm": {"fan": 0, "value": "${target}"}}},
        {"check": {"fans.part": {"min": "33%", "max": "34%"}}}
    ])");
    CHECK(run.outcome.verdict == Verdict::passed);
    CHECK(run.outcome.captures.at("target") == "85");
}

TEST_CASE("what was captured and does not fit fails, with its words") {
    CHECK(sentence_of(R"([{"request": "M104 S85x"}, {"expect": {"request": "S(?P<t>.*)$"}},
        {"set": {"heaters.bed.target": "${t}C"}}])") ==
          "test failed after 0 ms: what was captured does not fit: /steps/2/set/heaters.bed.target: found "
          "the text "
          "\"85xC\"; expected a number with its unit, such as \"200C\" (test.json:2).");
}

TEST_CASE("wait: in vain it times out, and says what there was instead") {
    const ScenarioRun run =
        play_steps(R"([{"wait": {"event": "motion.homed"}, "within": "3s", "why": "it homes"}])");
    CHECK(run.outcome.verdict == Verdict::timed_out);
    CHECK(
        run.outcome.sentence ==
        "test timed out after 3 s: \"it homes\" is not so: waited in vain for the event motion.homed (a full "
        "homing run has ended; X, Y and Z are known) within 3 s; nothing happened lately (test.json:1).");
}

TEST_CASE("expect: what does not come is a failure, with what came instead") {
    const ScenarioRun run = play_steps(R"([{"wait": "5s"}, {"request": "M105"}, {"expect": "^L99"}])");
    CHECK(run.outcome.verdict == Verdict::failed);
    CHECK(
        run.outcome.sentence.starts_with("test failed after 7 s: expected a line of the board that matches "
                                         "\"^L99\" to come within 2 s; the last that "
                                         "the board said was \"L"));
}

TEST_CASE("expect_next: the very next line, but for those ignored") {
    CHECK(passes(
        R"([{"wait": "5s"}, {"request": "M2139"}, {"expect_next": "^L23 ", "ignoring": ["^L[123] ", "^L2[12] "]}])"));
    CHECK(sentence_of(R"([{"expect_next": "^L99", "why": "it is ninety-nine"}])")
              .starts_with("test failed after 0 ms: \"it is ninety-nine\" is not so: expected the next line "
                           "of the board "
                           "to match \"^L99\"; it was \"L3 PS:0 "));
}

TEST_CASE("field: waited for while it changes by itself, and within its limit") {
    CHECK(passes(R"([{"do": {"heater.target": {"heater": "nozzle", "c": "100C"}}},
        {"wait": {"field": {"heaters.nozzle.true": {"min": "60C"}}}, "within": "5min"}])"));
    const std::string said = sentence_of(
        R"([{"wait": {"field": {"heaters.nozzle.true": {"min": "60C"}, "job.status": 0}}, "within": "2s"}])");
    CHECK(said.starts_with(
        "test timed out after 2 s: waited in vain for heaters.nozzle.true to be at least 60C and "
        "job.status to be 0 within 2 s; heaters.nozzle.true is 2"));
    CHECK(said.find(" C, job.status is 0 (test.json:1).") != std::string::npos);
}

TEST_CASE("check: is so now, or not") {
    CHECK(passes(R"([{"check": {"job.status": 0, "motion.homed": false, "identity.model": "A30T"}}])"));
    CHECK(
        sentence_of(R"([{"check": {"job.status": {"not": 0}}}])") ==
        "test failed after 0 ms: expected job.status to be other than 0 now; job.status is 0 (test.json:1).");
}

TEST_CASE("never: for a time, while steps are carried out, and of states") {
    CHECK(passes(R"([{"never": {"event": "motion.homed"}, "for": "5s"},
                     {"never": "^L18", "steps": [{"wait": "1s"}, {"wait": "1s"}]}, {"do": "card out"}, {"expect": "^L18"}])"));
    CHECK(
        sentence_of(
            R"([{"wait": "5s"}, {"never": "^L18", "why": "no alarm", "steps": [{"wait": "1s"}, {"do": "card out"}, {"wait": "9s"}]}])") ==
        "test failed after 6.049 s: \"no alarm\" is not so: a line of the board that matches \"^L18\" must "
        "not "
        "come, and "
        "came: \"L18 P26 S1\" (test.json:1).");
    CHECK(sentence_of(R"([{"do": {"heater.target": {"heater": "bed", "c": "60C"}}},
                          {"never": {"field": {"heaters.bed.true": {"min": "40C"}}}, "for": "1h"}])")
              .find("what must not be is so: heaters.bed.true to be at least 40C; heaters.bed.true is 4") !=
          std::string::npos);
}

TEST_CASE("do: what the machine refuses fails; phrases and lists are taken") {
    CHECK(passes(R"([{"do": ["filament in", "motion.home"]}, {"check": {"filament.present": true}},
                     {"wait": {"event": "motion.homed"}}])"));
    CHECK(sentence_of(R"([{"do": {"fan.pwm": {"fan": 1, "value": 3}}}])") ==
          "test failed after 0 ms: fan.pwm was not done: no such fan; expected 0 (part cooling) or 2 "
          "(test.json:1).");
}

TEST_CASE("send: a frame, a line, bytes as they are") {
    CHECK(passes(R"([{"wait": "5s"}, {"send": "L9"}, {"expect": "^L9 DN:"}, {"send": {"line": "L18 P26 S7"}},
                     {"expect": "^L18 P26 S7$"}, {"send": {"raw": "abc\r\ndef"}}, {"expect": "^abc"}])"));
}

TEST_CASE("repeat: so many rounds, until something is so, and how it says which round it was") {
    CHECK(play_steps(R"([{"repeat": 7, "steps": [{"wait": "1s"}]}])").outcome.at == SimTime{7'000'000});
    CHECK(
        play_steps(
            R"([{"do": "motion.home"}, {"repeat": 100, "until": {"motion.homed": true}, "steps": [{"wait": "10s"}]}])")
            .outcome.at == SimTime{40'000'000});
    CHECK(sentence_of(R"([{"repeat": 3, "until": {"motion.homed": true}, "steps": [{"wait": "1s"}]}])") ==
          "test failed after 3 s: expected motion.homed to be true after 3 rounds at the latest; "
          "motion.homed is "
          "false (test.json:1, round 4).");
    CHECK(sentence_of(
              R"([{"repeat": 3, "steps": [{"wait": "1s"}, {"check": {"board.seconds": {"max": "2s"}}}]}])") ==
          "test failed after 3 s: expected board.seconds to be at most 2s now; board.seconds is 3 s "
          "(test.json:1, "
          "round 3).");
}

TEST_CASE("repeat: steps that go round while no time passes are found out") {
    CHECK(
        sentence_of(R"([{"repeat": 1000000, "steps": [{"note": "x"}]}])")
            .starts_with("test failed after 0 ms: 10000 steps were done and no time passed; put a \"wait\""));
    CHECK(sentence_of(
              R"([{"repeat": "forever", "steps": [{"wait": {"event": "job.started"}, "within": "1s"}]}])")
              .starts_with("test timed out after 1 s: "));
}

TEST_CASE("together: goes on when all are through, or with the first; a failure is that of all") {
    CHECK(play_steps(
              R"([{"together": [{"steps": [{"wait": "3s"}]}, {"steps": [{"wait": "5s"}]}]}, {"wait": "1s"}])")
              .outcome.at == SimTime{6'000'000});
    const ScenarioRun first = play_steps(R"([{"together": [
        {"steps": [{"repeat": "forever", "steps": [{"note": "tick"}, {"wait": "1s"}]}]},
        {"steps": [{"wait": "2500ms"}]}], "until": "first"}, {"wait": "10s"}])");
    CHECK(first.outcome.at == SimTime{12'500'000});
    CHECK(first.notes.size() == 3);
    CHECK(sentence_of(R"([{"together": [{"name": "long", "steps": [{"wait": "1h"}]},
        {"name": "short", "steps": [{"wait": "1s"}, {"check": {"job.status": 1}}]}]}])") ==
          "test failed after 1 s: expected job.status to be 1 now; job.status is 0 (test.json:2, in "
          "\"short\").");
}

TEST_CASE("together: branches within branches are given up with theirs") {
    const ScenarioRun run = play_steps(R"([{"together": [
        {"steps": [{"together": [{"steps": [{"wait": "1h"}]}, {"steps": [{"wait": "2h"}, {"note": "no"}]}]}, {"note": "no"}]},
        {"steps": [{"wait": "1s"}]}], "until": "first"}, {"wait": "3h"}])");
    CHECK(run.outcome.verdict == Verdict::passed);
    CHECK(run.outcome.at == SimTime{10'801'000'000});
    CHECK(run.notes.empty());
}

TEST_CASE("together: two branches hear the same line; in one, one line is one step") {
    CHECK(passes(R"([{"wait": "5s"}, {"together": [
        {"steps": [{"expect": "^L9 "}]}, {"steps": [{"expect": "^L9 "}]}, {"steps": [{"send": "L9"}]}]}])"));
    CHECK(play_steps(R"([{"wait": "5s"}, {"send": "L9"}, {"expect": "^L9 "}, {"expect": "^L9 "}])")
              .outcome.verdict == Verdict::failed);
}

TEST_CASE("press, page, shows: the virtual screen in the same process") {
    CHECK(passes(
        R"([{"wait": "3s"}, {"press": "Setting/Add-on/Sound on"}, {"expect": {"request": "^M2139 P0 S1"}},
        {"expect": "^L23 "}, {"check": {"page": "Setting/Add-on"}}, {"expect": {"shows": "Sound"}},
        {"check": {"addons.sound": true}}])",
        true));
    CHECK(sentence_of(R"([{"wait": "3s"}, {"expect": {"page": "Control/Move"}, "why": "it opens"}])", true) ==
          "test failed after 5 s: \"it opens\" is not so: expected the screen to open the page "
          "\"Control/Move\" within "
          "2 s; it shows the page \"Main\" (test.json:1).");
    CHECK(sentence_of(R"([{"press": "Setting/Add-on/Sound on"}])", true).find("cannot be pressed") ==
          std::string::npos);  // it was switched on before
}

TEST_CASE("fault and clear: of the line by name, of the printer by its kind") {
    CHECK(passes(R"([{"wait": "3s"}, {"fault": "drop:to_board,every=1", "as": "deaf"},
        {"press": "Setting/Add-on/Sound on"}, {"never": {"request": "M2139 P0"}, "for": "2s"},
        {"fault": "duplicate:to_board,every=1", "as": "deaf"},
        {"press": "Setting/Add-on/Sound on"}, {"expect": {"request": "M2139 P0"}}, {"expect": {"request": "M2139 P0"}},
        {"clear": "deaf"}, {"press": "Setting/Add-on/Sound on"}, {"expect": {"request": "M2139 P0"}},
        {"never": {"request": "M2139 P0"}, "for": "1s"}])",
                 true));
    CHECK(passes(R"([{"wait": "3s"}, {"fault": "card_removed"}, {"expect": {"event": "card.removed"}},
        {"clear": "card_removed"}, {"expect": {"event": "card.inserted"}}])"));
}

TEST_CASE("include: the steps of another scenario, with its parameters") {
    const ScenarioRun run =
        play_steps(R"([{"include": "soak", "with": {"rounds": 1}}, {"wait": "1s"}])", true);
    CHECK(run.outcome.verdict == Verdict::passed);
    CHECK(run.outcome.at > SimTime{60'000'000});
}

TEST_CASE("the outermost steps are the cases of JUnit: passed, failed, not reached") {
    const ScenarioRun run =
        play_steps(R"([{"wait": "1s"}, {"check": {"job.status": 1}, "why": "a < b"}, {"wait": "1s"}])");
    CHECK(run.junit.find("tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\"") != std::string::npos);
    CHECK(run.junit.find("name=\"2. a &lt; b\"") != std::string::npos);
}

TEST_CASE("limits in real time: a wait that takes too long by the clock on the wall is in vain") {
    struct Nowhere final : Stage {
        void visit(const std::function<void(board::Board&, SimTime)>&) override {}
        fault::FaultControl* faults() override { return nullptr; }
        const screen::Screen* screen() override { return nullptr; }
        screen::PressResult press(std::string_view) override { return {}; }
        void note(std::string_view) override {}
    } stage;
    const auto scenario = [](std::string_view real) {
        return testing::load_steps(R"([{"wait": {"event": "motion.homed"}, "within": "1h")" +
                                   std::string(real) + "}]");
    };
    Player given(scenario(R"(, "real": "10s")"), 1);
    given.advance(SimTime{0}, SimTime{5'000'000}, stage);
    given.advance(SimTime{1'000'000}, SimTime{15'000'000}, stage);
    CHECK_FALSE(given.done());
    given.advance(SimTime{2'000'000}, SimTime{15'000'001}, stage);
    REQUIRE(given.done());
    CHECK(given.outcome().verdict == Verdict::timed_out);
    CHECK(given.outcome().sentence.find("within 10 s of real time") != std::string::npos);
    Player by_default(scenario(""), 2);  // at half speed
    by_default.advance(SimTime{0}, SimTime{0}, stage);
    by_default.advance(SimTime{1'000'000}, SimTime{7'500'000'000}, stage);
    CHECK_FALSE(by_default.done());
    by_default.advance(SimTime{2'000'000}, SimTime{7'500'000'001}, stage);
    CHECK(by_default.done());
}

TEST_CASE("scenarios by others: the same seed gives the same, whatever the pacing") {
    for (const bool pacing : {true, false}) {
        testing::ScenarioSetup setup;
        setup.pacing = pacing;
        const char* steps =
            R"([{"wait": "3s"}, {"press": "Control/Filament/Hotend on"}, {"expect": "/200\\.0"}, {"wait": "1min"}])";
        const ScenarioRun one = play_steps(steps, true, setup);
        const ScenarioRun two = play_steps(steps, true, setup);
        CHECK(one.outcome.verdict == Verdict::passed);
        const bool same = one.recording == two.recording;
        CHECK(same);
        setup.seed = 2;
        const ScenarioRun other = play_steps(steps, true, setup);
        const bool other_same = other.recording == one.recording;
        CHECK_FALSE(other_same);
    }
}

}  // namespace
}  // namespace fauxboard::script
