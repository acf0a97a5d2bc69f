// Every example of profiles/README.md is a profile that loads on top of the common base and fits the schema.

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/profile.h"
#include "emulator/host/profile_files.h"
#include "tests/tools/helpers.h"
#include "tools/check_files.h"

using namespace fauxboard;
using nlohmann::json;
using tests::read_file;

namespace {

std::vector<std::string> examples() {
    const std::string page = read_file(FAUXBOARD_SOURCE_DIR "/profiles/README.md");
    constexpr std::string_view open = "```json\n";
    std::vector<std::string> out;
    for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
        at += open.size();
        const std::size_t end = page.find("```", at);
        out.push_back(page.substr(at, end - at));
        at = end;
    }
    return out;
}

}  // namespace

TEST_CASE("profiles/README.md: its examples load and fit the schema") {
    const json schema = json::parse(read_file(FAUXBOARD_SOURCE_DIR "/profiles/schemas/profile.schema.json"));
    const std::vector<std::string> all = examples();
    CHECK(all.size() >= 10);
    for (const std::string& text : all) {
        CAPTURE(text);
        json example = json::parse(text);
        if (!example.contains("extends")) {
            example["extends"] = "smartto-base";
        }
        const auto errors = tools::check_schema(schema, example);
        CHECK_MESSAGE(errors.empty(), (errors.empty() ? "" : errors[0].pointer + ": " + errors[0].message));
        std::string problems;
        try {
            behaviour::load_profile({FAUXBOARD_SOURCE_DIR "/profiles/example.json", example.dump()},
                                    host::profile_finder());
        } catch (const behaviour::ProfileError& error) {
            problems = error.what();
        }
        CHECK(problems == "");
    }
}
