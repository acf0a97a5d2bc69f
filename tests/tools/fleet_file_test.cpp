#include "tools/fleet_file.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "emulator/behaviour/source.h"
#include "tests/link/helpers.h"
#include "tools/check_files.h"

namespace fauxboard::tools {
namespace {

nlohmann::json schema() {
    std::ifstream in(FAUXBOARD_SOURCE_DIR "/profiles/schemas/fleet.schema.json", std::ios::binary);
    return nlohmann::json::parse(in);
}

Fleet read(const std::string& text) {
    link::test::TemporaryFolder folder;
    const std::string file = folder.file("fleet.json");
    std::ofstream(file) << text;
    return read_fleet(file);
}

std::string refusal(const std::string& text) {
    try {
        (void)read(text);
    } catch (const behaviour::ProfileError& error) {
        return error.what();
    }
    return "";
}

TEST_CASE("groups are spread out: names, numbers, seeds") {
    const Fleet fleet = read(R"({"boards": [
        {"profile": "geeetech-a30t", "count": 3, "name": "left-{n}", "pty": "/tmp/x/{n}", "seed": 5, "pacing": false},
        {"profile": "elegoo-mars-pro", "count": 2, "faults": ["drop:every=5", {"kind": "jam"}]},
        {}]})");
    REQUIRE(fleet.boards.size() == 6);
    CHECK(fleet.boards[0].name == "left-1");
    CHECK(fleet.boards[2].options.pty_name == "/tmp/x/3");
    CHECK(fleet.boards[2].options.seed == 7);
    CHECK_FALSE(fleet.boards[2].options.pacing);
    CHECK(fleet.boards[3].name == "elegoo-mars-pro-1");
    CHECK(fleet.boards[4].name == "elegoo-mars-pro-2");
    CHECK(fleet.boards[4].options.faults.size() == 2);
    CHECK(fleet.boards[5].name == "geeetech-a30t");
    CHECK(fleet.boards[5].options.pacing);
}

TEST_CASE("what is wrong is told with its place") {
    struct Case {
        const char* text;
        const char* says;
    };
    for (const Case& each :
         {Case{"{}", "boards"}, Case{R"({"boards": []})", "without a board"},
          Case{R"({"boards": {}})", "expected a list"}, Case{R"({"boards": [7]})", "/boards/0"},
          Case{R"({"boards": [{"profil": "x"}]})", "profile"},
          Case{R"({"boards": [{"count": 0}]})", "/boards/0/count"},
          Case{R"({"boards": [{"count": 5000}]})", "4096"},
          Case{R"({"boards": [{"count": 2, "pty": "same"}]})", "{n}"},
          Case{R"({"boards": [{"count": 2, "eeprom": "same"}]})", "{n}"},
          Case{R"({"boards": [{"pty": "a", "tcp": ":0"}]})", "one main line"},
          Case{R"({"boards": [{"host_pty": "a", "host_tcp": ":0"}]})", "one USB port"},
          Case{R"({"boards": [{"faults": ["dropp"]}]})", "/boards/0/faults/0"},
          Case{R"({"boards": [{"faults": "drop"}]})", "/boards/0/faults"},
          Case{R"({"boards": [{}, {}]})", "second board of the name"}, Case{"{", "fleet.json"}}) {
        CAPTURE(each.text);
        CHECK(refusal(each.text).find(each.says) != std::string::npos);
    }
    CHECK_THROWS_AS(read_fleet("no-such-file.json"), behaviour::ProfileError);
}

std::vector<std::string> check(const std::string& text) {
    const link::test::TemporaryFolder folder;
    const std::string file = folder.file("fleet.json");
    std::ofstream(file) << text;
    std::vector<std::string> said;
    for (const behaviour::Problem& problem : check_file(file).problems) {
        said.push_back(problem.pointer + ": " + problem.message);
    }
    return said;
}

TEST_CASE("check knows a fleet by its boards, and looks at their profiles, too") {
    CHECK(
        check(R"({"boards": [{"profile": "geeetech-a30t", "count": 3, "name": "left-{n}", "pty": "/tmp/x/{n}",
        "seed": 5, "pacing": false, "host_tcp": ":0", "udp": ":0", "sd": "a", "udisk": "b", "eeprom": "c{n}",
        "control": "d{n}", "faults": ["drop:every=5", {"kind": "jam"}], "comment": "all keys"},
        {"tcp": ":0", "host_pty": "x"}, {"name": "b", "port": "p", "host_port": "q"}]})")
            .empty());
    CHECK(check(R"({"$schema": "../schemas/fleet.schema.json", "boards": [{"profile": "geeetech-a30x"}]})")
              .size() == 1);
    for (const char* wrong : {R"({"boards": []})", R"({"boards": [{"profil": "x"}]})",
                              R"({"boards": [{"count": 0}]})", R"({"boards": [{"pty": "a", "tcp": ":0"}]})",
                              R"({"boards": [{"faults": "drop"}]})", R"({"boards": [{"name": 7}]})"}) {
        CAPTURE(wrong);
        CHECK(check(wrong).size() == 1);  // what the loader has told, the schema does not tell again
        CHECK_FALSE(check_schema(schema(), nlohmann::json::parse(wrong)).empty());
    }
}

}  // namespace
}  // namespace fauxboard::tools
