// The shipped scenarios: each passes, is the same each time, and, broken on purpose, fails with a sentence
// that a person understands.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "emulator/fault/kind.h"
#include "emulator/host/script_files.h"
#include "emulator/machine/kind.h"
#include "tests/support/scenario_run.h"

namespace fauxboard::script {
namespace {

using behaviour::Json;
using testing::ScenarioRun;
using Verdict = Outcome::Verdict;

const std::vector<std::string>& shipped() {
    static const std::vector<std::string> names{"day-of-bad-luck",
                                                "dlp-by-touch",
                                                "dlp-first-print",
                                                "dlp-night-of-bad-luck",
                                                "leveling-session",
                                                "pair-a30",
                                                "pair-a30t",
                                                "power-loss",
                                                "print-with-filament-change",
                                                "resin-stick-pulled",
                                                "soak",
                                                "tour-of-pages"};
    return names;
}

/// Those that go on without end are given a few rounds.
Arguments bounded(const std::string& name) {
    return name == "soak"            ? Arguments{{"rounds", "4"}}
           : name == "tour-of-pages" ? Arguments{{"rounds", "1"}}
                                     : Arguments{};
}

std::string read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST_CASE("shipped scenarios: these, and no others") {
    std::vector<std::string> files;
    for (const auto& item : std::filesystem::directory_iterator(FAUXBOARD_SOURCE_DIR "/profiles/scenarios")) {
        if (item.path().extension() == ".json") {
            files.push_back(item.path().stem().string());
        }
    }
    std::sort(files.begin(), files.end());
    CHECK(files == shipped());
}

TEST_CASE("shipped scenarios pass; the screen lives through them; played again they are the same") {
    for (const std::string& name : shipped()) {
        CAPTURE(name);
        const ScenarioRun run = testing::play(testing::shipped_scenario(name), {bounded(name)});
        CHECK(run.outcome.sentence.starts_with(name + " passed: "));
        CHECK(run.outcome.verdict == Verdict::passed);
        CHECK(run.crashes == 0);
        for (const StepResult& result : run.outcome.results) {
            CHECK(result.verdict == StepResult::Verdict::passed);
        }
        const ScenarioRun again = testing::play(testing::shipped_scenario(name), {bounded(name)});
        CHECK(again.outcome.sentence == run.outcome.sentence);
        const bool same = again.recording == run.recording;
        CHECK(same);
    }
}

TEST_CASE("shipped scenarios: every step that can fail says why") {
    for (const std::string& name : shipped()) {
        CAPTURE(name);
        const Json root = Json::parse(testing::shipped_scenario(name).text);
        for (const Json& step : root["steps"]) {
            const bool can_fail =
                (step.contains("wait") && step["wait"].is_object()) || step.contains("expect");
            CAPTURE(step.dump());
            CHECK(
                (!can_fail || step.contains("why") || step.value("wait", Json::object()).contains("field")));
        }
    }
}

TEST_CASE("soak: another seed spoils other lines") {
    const ScenarioRun one = testing::play(testing::shipped_scenario("soak"), {{{"rounds", "2"}}});
    const ScenarioRun two =
        testing::play(testing::shipped_scenario("soak"), {{{"rounds", "2"}, {"seed", "2"}}});
    const bool same = one.recording == two.recording;
    CHECK_FALSE(same);
}

TEST_CASE("soak: it goes on until it is told to end") {
    testing::ScenarioSetup setup;
    setup.duration_s = 600;
    const ScenarioRun run = testing::play(testing::shipped_scenario("soak"), setup);
    CHECK(run.outcome.verdict == Verdict::interrupted);
    CHECK(run.outcome.at == SimTime{600'000'000});
}

/// Whether the fault happens in the scenario.
bool happens_in(const Json& scenario, const fault::Kind& kind) {
    const Json& steps = scenario["steps"];
    return std::any_of(steps.begin(), steps.end(), [&](const Json& step) {
        return step.contains("fault") && fault::fault_from_json(step["fault"]).kind == &kind;
    });
}

TEST_CASE("days and nights of bad luck: every fault there is happens to a machine that can have it") {
    const auto scenario = [](const char* name) { return Json::parse(testing::shipped_scenario(name).text); };
    const Json day = scenario("day-of-bad-luck");
    const Json night = scenario("dlp-night-of-bad-luck");
    const Json resin = scenario("resin-stick-pulled");
    for (const auto kinds : {fault::kinds(), fault::printer_kinds()}) {
        for (const fault::Kind* kind : kinds) {
            CAPTURE(std::string(kind->name));
            const bool by_day =
                kind->printer == nullptr || machine::has_fault(*machine::kinds().front(), *kind->printer);
            const bool of_pieces = kind->name.starts_with("chunk_");  // of files
            CHECK(happens_in(of_pieces ? resin : by_day ? day : night, *kind));
        }
    }
}

/// The n-th step that is just this, also within others; null when there is none.
Json* find_step(Json& node, const Json& wanted, int& which) {
    if (!node.is_structured()) {
        return nullptr;
    }
    for (auto& item : node) {
        if (item == wanted && --which == 0) {
            return &item;
        }
        if (Json* hit = find_step(item, wanted, which)) {
            return hit;
        }
    }
    return nullptr;
}

TEST_CASE(
    "shipped scenarios, each with a step broken on purpose, fail with a sentence that a person understands") {
    const Json rows = Json::parse(read(FAUXBOARD_SOURCE_DIR "/tests/script/broken_scenarios.json"));
    std::set<std::string> broken;
    for (const Json& row : rows) {
        const auto name = row["scenario"].get<std::string>();
        CAPTURE(name);
        broken.insert(name);
        testing::ScenarioSetup setup;
        const Json arguments = row.value("arguments", Json::object());
        for (const auto& [key, value] : arguments.items()) {
            setup.arguments[key] = value.get<std::string>();
        }
        const auto source = testing::changed_scenario(name, [&](Json& root) {
            if (row.contains("step")) {
                int which = row.value("which", 1);
                Json* step = find_step(root["steps"], row["step"], which);
                REQUIRE(step != nullptr);
                *step = row["becomes"];
            }
        });
        const ScenarioRun run = testing::play(source, setup);
        CHECK(run.outcome.sentence == row["says"].get<std::string>());
        CHECK(run.outcome.verdict != Verdict::passed);
        CHECK(run.junit.find("failures=\"1\"") != std::string::npos);
    }
    CHECK(broken.size() == shipped().size());
}

TEST_CASE("the examples of the READMEs load") {
    for (const char* file : {"/profiles/scenarios/README.md", "/README.md"}) {
        CAPTURE(file);
        const std::string text = read(std::string(FAUXBOARD_SOURCE_DIR) + file);
        std::size_t found = 0;
        for (std::size_t at = text.find("```json\n"); at != std::string::npos;
             at = text.find("```json\n", at + 1)) {
            const std::size_t from = at + 8;
            const std::string example = text.substr(from, text.find("```", from) - from);
            if (example.find("\"steps\"") != std::string::npos) {
                ++found;
                CHECK_NOTHROW(host::check_script({"README.md", example}));
            }
        }
        CHECK(found == 1);
    }
}

}  // namespace
}  // namespace fauxboard::script
