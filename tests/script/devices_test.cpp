// Steps that need something of the run: a board with a network and a stick, a board with a screen of its own.

#include <doctest/doctest.h>

#include "tests/support/scenario_run.h"

namespace fauxboard::script {
namespace {

using Verdict = Outcome::Verdict;

testing::ScenarioRun play_on(std::string_view profile, std::string_view steps,
                             const testing::ScenarioSetup& setup = {}) {
    return testing::play({"test.json", R"({"name": "test", "profile": ")" + std::string(profile) +
                                           R"(", "steps": )" + std::string(steps) + "}"},
                         setup);
}

TEST_CASE("upload: the board's own words say why it did not go up") {
    const auto sentence = [](std::string_view profile, std::string_view steps) {
        return play_on(profile, steps).outcome.sentence;
    };
    const std::string without_stick =
        sentence("elegoo-saturn", R"([{"wait": "5s"}, {"do": "card.remove"}, {"upload": "box.ctb"}])");
    CHECK_MESSAGE(
        without_stick.find("\"box.ctb\" did not go up: M28 box.ctb was answered \"//Disk init fail!\"") !=
            std::string::npos,
        without_stick);
    // A stick without a folder of the computer behind it takes no file.
    const std::string read_only = sentence(
        "anycubic-photon", R"([{"wait": "5s"}, {"upload": "box.cbddlp", "layers": 3, "exposure": "4s"}])");
    CHECK_MESSAGE(
        read_only.find("\"box.cbddlp\" did not go up: M28 box.cbddlp was answered \"Error:write data\"") !=
            std::string::npos,
        read_only);
    const std::string without_network =
        sentence("geeetech-a30t", R"([{"wait": "5s"}, {"upload": "box.ctb"}])");
    CHECK_MESSAGE(
        without_network.find("\"box.ctb\" did not go up: M28 box.ctb was not answered") != std::string::npos,
        without_network);
}

TEST_CASE(
    "press: what may be several buttons is pressed where the page tells them apart, and fails where not") {
    CHECK(testing::play_steps(R"([{"wait": "5s"}, {"press": "babystep/Rset"}, {"press": "Rset"}])", true)
              .outcome.verdict == Verdict::passed);
    const std::string sentence =
        testing::play_steps(R"([{"wait": "5s"}, {"press": "Rset"}])", true).outcome.sentence;
    CHECK_MESSAGE(sentence.find("write more of its path") != std::string::npos, sentence);
}

TEST_CASE("never: an event that comes is told by its name; one that was over before is none of it") {
    const std::string sentence =
        testing::play_steps(
            R"([{"wait": "2s"}, {"never": {"event": "motion.homed"}, "steps": [{"do": "motion.home"}, {"wait": "1min"}]}])")
            .outcome.sentence;
    CHECK_MESSAGE(sentence.find("motion.homed") != std::string::npos, sentence);
    CHECK(sentence.starts_with("test failed"));
    CHECK(testing::play_steps(R"([{"wait": "2s"}, {"do": "motion.home"}, {"wait": {"event": "motion.homed"}},
        {"never": {"event": "motion.homed"}, "for": "10s"}])")
              .outcome.verdict == Verdict::passed);
}

TEST_CASE("arguments: true and false are what they are, and a scenario without parameters takes none") {
    const auto run = [](const char* given) {
        return testing::play({"test.json", R"({"name": "test", "profile": "geeetech-a30t",
            "parameters": {"on": {"default": false, "help": "?"}},
            "steps": [{"set": {"addons.sound": "${on}"}}, {"check": {"addons.sound": "${on}"}}, {"note": "is ${on}"}]})"},
                             {{{"on", given}}})
            .notes;
    };
    CHECK(run("true") == std::vector<std::string>{"is true"});
    CHECK(run("false") == std::vector<std::string>{"is false"});
    try {
        testing::play(
            {"test.json", R"({"name": "test", "profile": "geeetech-a30t", "steps": [{"wait": "1s"}]})"},
            {{{"on", "1"}}});
        FAIL("taken");
    } catch (const behaviour::ProfileError& error) {
        CHECK(std::string(error.what()) == "--param: the scenario has no parameter \"on\", nor any other");
    }
}

}  // namespace
}  // namespace fauxboard::script
