// JSON documents that know where their values stand, and how profiles extend one another.

#include <doctest/doctest.h>

#include <string>

#include "emulator/behaviour/document.h"
#include "tests/support/small_profile.h"

using namespace fauxboard::behaviour;
using fauxboard::testing::finder_in;
using std::string;

namespace {

string problem_of(const string& text) {
    try {
        parse_document({"f.json", text});
    } catch (const ProfileError& error) {
        return error.what();
    }
    return "no problem";
}

string chain_problem(const string& text, std::map<string, string, std::less<>> files) {
    try {
        load_document({"f.json", text}, finder_in(std::move(files)));
    } catch (const ProfileError& error) {
        return error.what();
    }
    return "no problem";
}

string place(const Document& document, const string& pointer) {
    const Problem problem = document.problem(pointer, "");
    return problem.file + ":" + std::to_string(problem.line);
}

}  // namespace

TEST_CASE("documents: every value's line is known, whatever stands around it") {
    const Document document =
        parse_document({"f.json",
                        "\n{\n  \"a\": 1,\n  \"b\": {\n    \"c\": [ true,\n      12.5\n    ,"
                        " null ],\n\n\n    \"d\":\n      \"text\"\n  },\"e\":-7\n}"});
    CHECK(place(document, "") == "f.json:2");
    CHECK(place(document, "/a") == "f.json:3");
    CHECK(place(document, "/b") == "f.json:4");
    CHECK(place(document, "/b/c") == "f.json:5");
    CHECK(place(document, "/b/c/0") == "f.json:5");
    CHECK(place(document, "/b/c/1") == "f.json:6");
    CHECK(place(document, "/b/c/2") == "f.json:7");
    CHECK(place(document, "/b/d") == "f.json:11");
    CHECK(place(document, "/e") == "f.json:12");
    CHECK(place(document, "/b/c/9/x") == "f.json:5");  // not there: where its nearest parent stands
    CHECK(place(document, "/zzz") == "f.json:2");
    CHECK(document.root["b"]["c"][1] == 12.5);
}

TEST_CASE("documents: line ends of any kind, tabs and a number at the very end of a line") {
    const Document document = parse_document({"f.json", "{\r\n\t\"a\": 1\r\n\t,\"b\":2\r\n}\r\n"});
    CHECK(place(document, "/a") == "f.json:2");
    CHECK(place(document, "/b") == "f.json:3");
}

TEST_CASE("documents: pointers write / and ~ of a key as JSON pointers do") {
    const Document document = parse_document({"f.json", "{ \"a/b~c\": {\n \"d\": 1 } }"});
    CHECK(place(document, "/a~1b~0c/d") == "f.json:2");
}

TEST_CASE("documents: what is no JSON is told with its line") {
    CHECK(problem_of("{\n  \"a\": 1,\n  oops\n}").starts_with("f.json:3: not JSON: "));
    CHECK(problem_of("").starts_with("f.json:1: not JSON: "));
    CHECK(problem_of("{\"a\": 1").starts_with("f.json:1: not JSON: "));
    CHECK(problem_of("{\"a\": 1e999}").starts_with("f.json:1: not JSON: "));
    CHECK(problem_of("{\"a\": \"\xff\"}").starts_with("f.json:1: not JSON: "));
    CHECK(problem_of("{\"a\": 1} x").starts_with("f.json:1: not JSON: "));
    CHECK(problem_of("{\"a\": NaN}").starts_with("f.json:1: not JSON: "));
}

TEST_CASE("documents: only an object is a profile") {
    for (const char* text : {"[]", "5", "\"x\"", "null"}) {
        CHECK(problem_of(text) == "f.json:1: expected a JSON object");
    }
}

TEST_CASE("documents: a key given twice is told where it stands the second time") {
    CHECK(problem_of("{ \"a\": 1,\n \"b\": { \"c\": 1,\n\n \"c\": 2 } }") ==
          "f.json:4: /b/c: the key is given twice");
    CHECK(problem_of("{ \"a\": 1, \"b\": { \"a\": 1 } }") == "no problem");
}

TEST_CASE("documents: nesting has an end") {
    for (const char* open : {"[", "{\"a\":"}) {
        string text = "{\"a\":";
        for (int i = 0; i < 200000; ++i) {
            text += open;
        }
        CHECK(problem_of(text).find("nested deeper than 64 levels") != string::npos);
    }
    string deep = "{\"a\":";
    for (int i = 0; i < 63; ++i) {
        deep += "[";
    }
    CHECK(problem_of(deep + string(63, ']') + "}") == "no problem");
}

TEST_CASE("extends: objects merge key by key, null takes away, all else is replaced") {
    const Document document = load_document(
        {"top",
         "{ \"extends\": \"base\",\n\"o\": { \"b\": 20,\n\"c\": null, \"new\": { \"x\": 1 } },\n"
         "\"list\": [ 9 ],\n\"was_object\": 5, \"was_number\": { \"y\": 1 } }"},
        finder_in({{"base",
                    "{ \"o\": { \"a\": 1,\n\"b\": 2, \"c\": { \"d\": 3 } },\n\"list\": [ 1, 2, 3 ],"
                    "\"was_object\": { \"z\": 1 }, \"was_number\": 7,\n\"kept\": true }"}}));
    CHECK(document.root["o"] == Json::parse(R"({"a": 1, "b": 20, "new": {"x": 1}})"));
    CHECK(document.root["list"] == Json::parse("[9]"));
    CHECK(document.root["was_object"] == 5);
    CHECK(document.root["was_number"] == Json::parse(R"({"y": 1})"));
    CHECK(document.root["kept"] == true);
    CHECK(place(document, "/o/a") == "base:1");
    CHECK(place(document, "/o/b") == "top:2");
    CHECK(place(document, "/o/new/x") == "top:3");
    CHECK(place(document, "/list/0") == "top:4");
    CHECK(place(document, "/list/2") == "top:4");  // the base's third item is gone
    CHECK(place(document, "/was_object/z") == "top:5");
    CHECK(place(document, "/kept") == "base:4");
}

TEST_CASE("extends: null in an object that the base lacks takes away nothing, and is not left behind") {
    const Document document = load_document({"top",
                                             "{ \"extends\": \"base\",\n\"new\": { \"x\": 1, \"y\": "
                                             "null,\n\"z\": { \"w\": null } }, \"gone\": null }"},
                                            finder_in({{"base", R"({ "a": 1 })"}}));
    CHECK(document.root["new"] == Json::parse(R"({"x": 1, "z": {}})"));
    CHECK_FALSE(document.root.contains("gone"));
    CHECK(place(document, "/new") == "top:2");
    CHECK(place(document, "/new/z") == "top:3");
}

TEST_CASE("extends: a chain of three, the nearest wins") {
    const Document document = load_document({"top", R"({ "extends": "middle", "a": 3 })"},
                                            finder_in({{"middle", R"({ "extends": "base", "a": 2, "b": 2 })"},
                                                       {"base", R"({ "a": 1, "b": 1, "c": 1 })"}}));
    CHECK(document.root["a"] == 3);
    CHECK(document.root["b"] == 2);
    CHECK(document.root["c"] == 1);
    CHECK(place(document, "/a") == "top:1");
    CHECK(place(document, "/b") == "middle:1");
    CHECK(place(document, "/c") == "base:1");
    CHECK(document.files.size() == 3);
}

TEST_CASE("extends: the wrong ways") {
    CHECK(chain_problem("{ \"x\": 1,\n \"extends\": \"gone\" }", {}) ==
          "f.json:2: /extends: there is no profile \"gone\"");
    CHECK(chain_problem(R"({ "extends": 5 })", {}) == "f.json:1: /extends: expected the name of a profile");
    CHECK(chain_problem(R"({ "extends": "a" })",
                        {{"a", "{\n\"extends\": \"b\" }"}, {"b", R"({ "extends": "a" })"}}) ==
          "b:1: /extends: the profiles extend one another in a circle");
    CHECK(chain_problem(R"({ "extends": "a" })", {{"a", R"({ "extends": "a" })"}}) ==
          "a:1: /extends: the profiles extend one another in a circle");
    CHECK(chain_problem(R"({ "extends": "a" })", {{"a", "{ oops"}}).starts_with("a:1: not JSON"));
    std::map<string, string, std::less<>> files;
    for (int i = 0; i < 20; ++i) {
        files["p" + std::to_string(i)] = "{ \"extends\": \"p" + std::to_string(i + 1) + "\" }";
    }
    CHECK(chain_problem(R"({ "extends": "p0" })", files).find("more than 8 profiles") != string::npos);
}

TEST_CASE("problems: the sentence leaves out what is not known") {
    Problem problem;
    problem.file = "f.json";
    problem.message = "it is wrong";
    CHECK(problem.sentence() == "f.json: it is wrong");
    problem.line = 3;
    problem.pointer = "/a";
    problem.nearest = "right";
    CHECK(problem.sentence() == "f.json:3: /a: it is wrong; did you mean \"right\"?");
    CHECK(string(ProfileError({problem, problem}).what()) == problem.sentence() + "\n" + problem.sentence());
}
