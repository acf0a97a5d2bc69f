// The schema that editors use against the shipped scenarios, and against the table of steps: both must know
// the same.

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "emulator/script/steps.h"
#include "tests/support/scenario_run.h"
#include "tools/check_files.h"

namespace fauxboard::script {
namespace {

using json = nlohmann::json;

const json& schema() {
    static const json parsed = [] {
        std::ifstream in(FAUXBOARD_SOURCE_DIR "/profiles/schemas/scenario.schema.json", std::ios::binary);
        return json::parse(in);
    }();
    return parsed;
}

bool fits(const json& document) {
    return tools::check_schema(schema(), document).empty();
}

bool fits_step(const json& step) {
    return fits({{"name", "x"}, {"steps", {step}}});
}

TEST_CASE("schema: every shipped scenario fits") {
    for (const char* name : {"day-of-bad-luck", "leveling-session", "power-loss",
                             "print-with-filament-change", "resin-stick-pulled", "soak", "tour-of-pages"}) {
        CAPTURE(name);
        CHECK(fits(json::parse(testing::shipped_scenario(name).text)));
    }
}

TEST_CASE("schema: it knows the steps of the table with their keys, and no others") {
    const json& definitions = schema()["definitions"];
    std::size_t steps = 0;
    for (const auto& [name, definition] : definitions.items()) {
        steps += name.starts_with("step_") ? 1U : 0U;
    }
    CHECK(steps == step_kinds().size());
    for (const StepKind& kind : step_kinds()) {
        const std::string name(kind.name);
        CAPTURE(name);
        const auto hit = definitions.find("step_" + name);
        REQUIRE(hit != definitions.end());
        const json& properties = (*hit)["properties"];
        CHECK(properties.contains(name));
        CHECK(properties.size() == kind.keys.size() + 3);  // itself, why, comment
        for (const KeyInfo& key : kind.keys) {
            CHECK(properties.contains(std::string(key.name)));
        }
    }
    const json& triggers = definitions["trigger"]["properties"];
    CHECK(triggers.size() == trigger_kinds().size());
    for (const TriggerInfo& trigger : trigger_kinds()) {
        CHECK(triggers.contains(std::string(trigger.name)));
    }
}

TEST_CASE("schema: the examples of the table fit, and load where they are whole") {
    for (const StepKind& kind : step_kinds()) {
        const std::string example(kind.example);
        CAPTURE(example);
        const json step = json::parse(example, nullptr, false);
        if (step.is_discarded()) {
            CHECK(example.find("[...]") != std::string::npos);
            continue;
        }
        CHECK(fits_step(step));
    }
}

TEST_CASE("schema: what is wrong does not fit") {
    CHECK_FALSE(fits_step({{"wait", 5}}));
    CHECK_FALSE(fits_step({{"wait", "5"}}));
    CHECK_FALSE(fits_step({{"wait", "5s"}, {"withn", "1s"}}));
    CHECK_FALSE(fits_step({{"weit", "5s"}}));
    CHECK_FALSE(fits({{"name", "x"}}));
    CHECK_FALSE(fits({{"name", "x"}, {"steps", json::array()}}));
    CHECK(fits_step({{"wait", "5s"}}));
}

}  // namespace
}  // namespace fauxboard::script
