// A scenario that is wrong is refused before anything runs, with sentences that say where and what.

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "emulator/host/script_files.h"
#include "tests/support/scenario_run.h"

namespace fauxboard::script {
namespace {

using behaviour::Json;

std::string text_of(const Json& row) {
    if (row.contains("text")) {
        return row["text"].get<std::string>();
    }
    Json root = row.contains("scenario")
                    ? row["scenario"]
                    : Json{{"name", "x"}, {"screen", "geeetech-a30t"}, {"steps", row["steps"]}};
    for (auto it = root.begin(); it != root.end();) {
        it = it->is_null() ? root.erase(it) : std::next(it);
    }
    return root.dump(2);
}

/// What the loader has against it.
std::string refusal(const std::string& text) {
    try {
        host::check_script({"wrong.json", text});
    } catch (const behaviour::ProfileError& error) {
        return error.what();
    }
    return "(nothing)";
}

const Json& rows() {
    static const Json table = [] {
        std::ifstream in(FAUXBOARD_SOURCE_DIR "/tests/script/wrong_scenarios.json", std::ios::binary);
        return Json::parse(in);
    }();
    return table;
}

TEST_CASE("wrong scenarios: each says what is wrong, where, and what was expected") {
    CHECK(rows().size() >= 15);
    for (const Json& row : rows()) {
        const auto what = row["what"].get<std::string>();
        const std::string said = refusal(text_of(row));
        CAPTURE(what);
        CAPTURE(said);
        for (const Json& part : row["says"]) {
            const auto wanted = part.get<std::string>();
            CAPTURE(wanted);
            CHECK(said.find(wanted) != std::string::npos);
        }
        // One mistake, one sentence.
        CHECK(std::count(said.begin(), said.end(), '\n') == 0);
    }
}

TEST_CASE("wrong scenarios: sentences name file and line") {
    const std::string said = refusal(
        "{\n  \"name\": \"x\",\n  \"steps\": [\n    { \"wait\": \"1s\" },\n    { \"do\": "
        "\"motion.hom\" }\n  ]\n}");
    CHECK(said == "wrong.json:5: /steps/1/do: unknown action \"motion.hom\"; did you mean \"motion.home\"?");
}

TEST_CASE("wrong scenarios: all mistakes are told at once") {
    const std::string said = refusal(R"({"name": "x", "steps": [
        {"wait": "5"}, {"do": "motion.hom"}, {"wait": {"event": "job.strated"}}]})");
    CHECK(std::count(said.begin(), said.end(), '\n') == 2);
}

TEST_CASE("wrong scenarios: arguments of the command line") {
    const auto arguments = [](const Arguments& given) {
        try {
            testing::play(testing::shipped_scenario("soak"), {given});
        } catch (const behaviour::ProfileError& error) {
            return std::string(error.what());
        }
        return std::string("(nothing)");
    };
    CHECK(arguments({{"rouns", "3"}}) ==
          "--param: the scenario has no parameter \"rouns\"; did you mean \"rounds\"?");
    CHECK(arguments({{"rounds", "some"}})
              .find("/steps/1/repeat: found the text \"some\"; expected how often") != std::string::npos);
}

}  // namespace
}  // namespace fauxboard::script
