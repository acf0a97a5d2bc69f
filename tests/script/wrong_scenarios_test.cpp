// A scenario that is wrong is refused before anything runs, with sentences that say where and what.

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

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

TEST_CASE("wrong scenarios: files that include one another, too deep, or that are no JSON") {
    const auto load = [](const std::map<std::string, std::string, std::less<>>& files) -> std::string {
        const auto find = [&](std::string_view name,
                              std::string_view) -> std::optional<behaviour::SourceText> {
            const auto hit = files.find(name);
            return hit == files.end() ? std::nullopt
                                      : std::optional(behaviour::SourceText{hit->first, hit->second});
        };
        try {
            load_scenario({"a", files.at("a")}, find, host::make_cast("geeetech-a30t", ""), {});
        } catch (const behaviour::ProfileError& error) {
            return error.what();
        }
        return "(nothing)";
    };
    const auto includes = [](const std::string& name) {
        return R"({"name": "x", "steps": [{"include": ")" + name + R"("}]})";
    };
    CHECK(load({{"a", includes("b")}, {"b", includes("a")}}) ==
          "b:1: /steps/0/include: the scenarios include one another in a circle");
    std::map<std::string, std::string, std::less<>> deep;
    for (char name = 'a'; name < 'z'; ++name) {
        deep[std::string(1, name)] = includes(std::string(1, static_cast<char>(name + 1)));
    }
    CHECK(load(deep) == "h:1: /steps/0/include: scenarios are included more than 8 deep");
    CHECK(load({{"a", includes("b")}, {"b", "{"}}).starts_with("b:1: not JSON"));
}

}  // namespace
}  // namespace fauxboard::script
