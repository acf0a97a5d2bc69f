#include <doctest/doctest.h>

#include "tests/tools/helpers.h"
#include "tools/check_files.h"

using namespace fauxboard;
using tests::TemporaryFile;
using tools::check_file;
using tools::CheckedFile;

namespace {

std::string sentences(const CheckedFile& checked) {
    std::string out;
    for (const behaviour::Problem& problem : checked.problems) {
        out += problem.sentence() + "\n";
    }
    return out;
}

}  // namespace

TEST_CASE("check: good files, by path and by name") {
    const CheckedFile by_path = check_file(FAUXBOARD_SOURCE_DIR "/profiles/geeetech-a30t.json");
    CHECK(by_path.readable);
    CHECK(sentences(by_path) == "");
    CHECK(by_path.remark == "");
    CHECK(sentences(check_file("smartto-base")) == "");
    const TemporaryFile mine("mine.json", R"({"name": "mine", "extends": "geeetech-a30t", "title": "Mine"})");
    CHECK(sentences(check_file(mine.path())) == "");
}

TEST_CASE("check: names that are not there are told where they stand, with the nearest") {
    const TemporaryFile board("b.json", R"({"name": "b",
"extends": "geetech-a30t"})");
    CHECK(sentences(check_file(board.path())) ==
          board.path() +
              ":2: /extends: there is no profile \"geetech-a30t\"; did you mean \"geeetech-a30t\"?\n");
    const TemporaryFile screen("s.json", R"({"name": "s", "extends": "geetech-a30t", "pages": {}})");
    CHECK(sentences(check_file(screen.path())) ==
          screen.path() +
              ":1: /extends: there is no screen \"geetech-a30t\"; did you mean \"geeetech-a30t\"?\n");
    const TemporaryFile scenario("c.json", R"({"name": "c",
"profile": "geetech-a30t", "steps": [{"wait": "1s"}]})");
    const std::string told = sentences(check_file(scenario.path()));
    CHECK(told.starts_with(scenario.path() +
                           ":2: /profile: \"geetech-a30t\": there is no profile of this name"));
    CHECK(told.ends_with("did you mean \"geeetech-a30t\"?\n"));
}

TEST_CASE("check: a screen's first word without a line end is remarked upon") {
    const TemporaryFile glued(
        "g.json", R"({"name": "g", "extends": "geeetech-a30t", "line": {"hello": "log OK"}, "pages": {}})");
    CHECK(sentences(check_file(glued.path())) == "");
    CHECK(check_file(glued.path()).remark.find("line.hello has no line end") != std::string::npos);
    CHECK(check_file(FAUXBOARD_SOURCE_DIR "/profiles/screens/geeetech-a30.json").remark.empty());
}

TEST_CASE("check: a schema that is not where the file says is remarked upon, with the place where it is") {
    const TemporaryFile copied(
        "c.json", R"({"$schema": "schemas/profile.schema.json", "name": "c", "extends": "geeetech-a30t"})");
    CHECK(sentences(check_file(copied.path())) == "");
    const std::string remark = check_file(copied.path()).remark;
    CHECK(remark.find("leads nowhere from here") != std::string::npos);
    CHECK(remark.find("profiles/schemas/profile.schema.json\"") != std::string::npos);
    const TemporaryFile url(
        "u.json",
        R"({"$schema": "https://example.org/profile.schema.json", "name": "u", "extends": "geeetech-a30t"})");
    CHECK(check_file(url.path()).remark == "");
}

TEST_CASE("check: what the loader finds comes with line, place and nearest name, and once only") {
    const TemporaryFile file("wrong.json", R"({
  "name": "wrong",
  "extends": "geeetech-a30t",
  "frames": {
    "L1": "L1 X{positon.x:.3f}"
  },
  "line": { "boud": 9600 }
})");
    const CheckedFile checked = check_file(file.path());
    CHECK(sentences(checked) ==
          file.path() + ":7: /line/boud: unknown key \"boud\"; did you mean \"baud\"?\n" + file.path() +
              ":5: /frames/L1: unknown field \"positon.x\"; did you mean \"position.x\"?\n");
}

TEST_CASE("check: what only the schema forbids is told, with its line") {
    const TemporaryFile file("form.json", R"({
  "name": "form",
  "extends": "geeetech-a30t",
  "title": "Form",
  "requests": {
    "M9000": { "when": { "S": { "present": true } },
               "do": [ [ ] ] }
  },
  "machine": { "card": { "entries": [ { "file": "x", "lines": {} } ] } }
})");
    const CheckedFile checked = check_file(file.path());
    CHECK(sentences(checked).find("form.json:9: /machine/card/entries/0/lines: against the schema: ") !=
          std::string::npos);
}

TEST_CASE("check: screens, against their own meaning and schema") {
    for (const char* name : {"smartto-screen", FAUXBOARD_SOURCE_DIR "/profiles/screens/geeetech-a30t.json",
                             FAUXBOARD_SOURCE_DIR "/profiles/screens/geeetech-a30.json"}) {
        const CheckedFile checked = check_file(name);
        CHECK(checked.readable);
        CHECK(sentences(checked) == "");
        CHECK(checked.remark == "");
    }
    const TemporaryFile wrong("wrong.json", R"({
  "$schema": "screen.schema.json",
  "name": "wrong",
  "extends": ")" FAUXBOARD_SOURCE_DIR R"(/profiles/screens/geeetech-a30t.json",
  "pages": { "Main": { "shows": ["{nozle.target:.1f}"] } },
  "idle": { "after_ms": 0.5 }
})");
    const std::string found = sentences(check_file(wrong.path()));
    CHECK(found.find("wrong.json:5: /pages/Main/shows/0: ") != std::string::npos);
    CHECK(found.find("did you mean \"nozzle.target\"?") != std::string::npos);
    CHECK(found.find("wrong.json:6: /idle/after_ms: ") != std::string::npos);
}

TEST_CASE("check: no JSON, another kind of file, no file") {
    const TemporaryFile torn("torn.json", "{\n  \"name\": \n");
    CHECK(sentences(check_file(torn.path())).find("torn.json:3: not JSON") != std::string::npos);
    const TemporaryFile other("other.json", R"({"$schema": "schemas/coffee.schema.json", "name": "x"})");
    CHECK(sentences(check_file(other.path())) ==
          other.path() +
              ":1: /$schema: unknown kind of file; expected the path of profile.schema.json or "
              "screen.schema.json or scenario.schema.json or fleet.schema.json\n");
    CHECK_FALSE(check_file("/no/such/file.json").readable);
    CHECK_FALSE(check_file("no-such-profile").readable);
    CHECK_FALSE(check_file("/").readable);
}
