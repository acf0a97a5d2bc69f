#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/operand.h"
#include "tests/screen/harness.h"
#include "tools/check_files.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using screen::Expression;
using screen::Scope;
using screen::Shown;
using screen::Template;
using screen::ValueInfo;
using screen::ValueTable;

namespace {

/// The sentences a screen profile is refused with; "" when it is not.
std::string refusal(std::string_view json) {
    try {
        screen_from(json);
        return {};
    } catch (const behaviour::ProfileError& error) {
        return error.what();
    }
}

struct Wrong {
    std::string_view json;
    std::string_view sentence;
};

ValueTable table() {
    ValueTable out;
    for (const char* name : {"a", "b.c"}) {
        ValueInfo info;
        info.name = name;
        info.names = {{7, "seven"}};
        out.add(info);
    }
    ValueInfo text;
    text.name = "t";
    text.kind = screen::ValueKind::text;
    out.add(text);
    ValueInfo list;
    list.name = "l";
    list.kind = screen::ValueKind::list;
    list.most = 9;
    out.add(list);
    return out;
}

std::string fault(std::string_view source) {
    try {
        ValueTable values = table();
        const Template text(source, values, {});
        return {};
    } catch (const behaviour::ExpressionError& error) {
        return error.nearest.empty() ? error.what() : std::string(error.what()) + "; " + error.nearest + "?";
    }
}

}  // namespace

TEST_CASE("expressions and templates") {
    ValueTable values = table();
    std::vector<Shown> now(4);
    now[0].number = 7;
    now[1].number = -0.004;
    now[2].text = "name";
    now[3].list = {"x", "y"};
    const Scope scope{now, 2, "y", 0.5};
    const auto number = [&](std::string_view source) {
        return Expression(source, values, {true, true}).evaluate(scope);
    };
    CHECK(number("1 + 2 * 3 - 4 / 2") == 5);
    CHECK(number("-(1 + 2) * -3") == 9);
    CHECK(number("min(a, 3) + max(a, 3)") == 10);
    CHECK(number("mod(25700, 256)") == 100);
    CHECK(number("floor(2.9) + round(2.5)") == 5);
    CHECK(number("a / (a - 7)") == 0);
    CHECK(number("l + row + input") == 4.5);
    const auto text = [&](std::string_view source) {
        return Template(source, values, {true, true}).render(scope);
    };
    CHECK(text("M104 S{a:.1f}") == "M104 S7.0");
    CHECK(text("{b.c:.2f} {b.c - 1:.2f}") == "0.00 -1.00");
    CHECK(text("{a} {input} {a / 3}") == "7 0.5 2.333");
    CHECK(text("{a:name} {b.c:name} {a / 2:d}") == "seven -0.004 3");
    CHECK(text("{t}|{row.text}|{{}}") == "name|y|{}");
}

TEST_CASE("wrong expressions say what was found, what was expected and what is near") {
    CHECK(fault("{b.d}") == "in \"b.d\": unknown value \"b.d\"; b.c?");
    CHECK(fault("{a +}") == "in \"a +\": a number or a name is missing at the end");
    CHECK(fault("{a b}") == "in \"a b\": \"b\" was not expected");
    CHECK(fault("{(a}") == "in \"(a\": expected ')' at the end");
    CHECK(fault("{mn(a, 1)}") ==
          "in \"mn(a, 1)\": there is no function \"mn\"; known: min, max, mod, days, round, floor, float; "
          "min?");
    CHECK(fault("{t + 1}") == "in \"t + 1\": \"t\" is a text; expected a number");
    CHECK(fault("{input}") == "in \"input\": \"input\" is known only to a button with \"input\"");
    CHECK(fault("{a:.9f}") ==
          "unknown format \".9f\" in {a:.9f}; expected .0f to .6f, d, 01d to 09d, hms, hm, or name");
    CHECK(fault("{t:d}") ==
          "{t:d} is a text; expected no format, or one of stem, ending, A+N (N bytes from A on)");
    CHECK(fault("a } b") == "a brace without its partner in \"a } b\"");
    CHECK(fault("{((((((((((((((((((a))))))))))))))))))}").find("nested deeper than 16") !=
          std::string::npos);
}

TEST_CASE("wrong screen profiles give clear sentences") {
    const std::vector<Wrong> wrongs{
        {R"({"extends": "smartto-scren"})", "test.json:1: /extends: there is no profile \"smartto-scren\""},
        {"{\n \"extends\": \"geeetech-a30t\",\n \"pags\": {}}",
         "test.json:3: /pags: unknown key \"pags\"; did you mean \"pages\"?"},
        {R"({"name": "x"})", "the key \"pages\" is missing"},
        {R"({"extends": "geeetech-a30t", "line": {"framed_in": "yes"}})",
         "test.json:1: /line/framed_in: found the text \"yes\"; expected true or false"},
        {"{\"extends\": \"geeetech-a30t\", \"pages\": {\"Control/Speed\": {\"buttons\": {\n\"Speed up\": "
         "{\"send\": "
         "\"M220 S{sped.percent:d}\"}}}}}",
         "test.json:2: /pages/Control~1Speed/buttons/Speed up/send: in \"sped.percent\": unknown value "
         "\"sped.percent\"; did you mean \"speed.percent\"?"},
        {R"({"extends": "geeetech-a30t", "pages": {"Main": {"buttons": {"Control": {"leads_to": "Controll"}}}}})",
         "/pages/Main/buttons/Control/leads_to: there is no page \"Controll\"; expected a page, <back> or "
         "<before>; "
         "did you mean \"Control\"?"},
        {R"({"extends": "geeetech-a30t", "pages": {"Control/Home": {"buttons": {"Home all": {"expect": ["L99"]}}}}})",
         "/pages/Control~1Home/buttons/Home all/expect/0: this screen takes no frame \"L99\""},
        {R"({"extends": "geeetech-a30t", "pages": {"Lost": {}}})",
         "/pages/Lost: no button leads to this page, and no frame opens it"},
        {R"({"extends": "geeetech-a30t", "frames": {"L10": {"read": [{"key": "S", "as": "flaot"}]}}})",
         "/frames/L10/read/0/as: found the text \"flaot\"; expected one of u8, u16, i32, real, text, mark, "
         "list_start, "
         "list_entry, list_end, list_append"},
        {R"({"extends": "geeetech-a30t", "frames": {"L10": {"read": [{"key": "S", "as": "real", "into": "job.file"}]}}})",
         "/frames/L10/read/0/into: \"job.file\" is a text; expected a number"},
        {R"({"extends": "geeetech-a30t", "frames": {"L300": {}}})",
         "/frames/L300: found L300; expected L0 to L255"},
        {R"({"extends": "geeetech-a30t", "pages": {"Control/Home": {"open_when": {"job.status": {"among": [0]}}}}})",
         "/pages/Control~1Home/open_when/job.status: unknown test \"among\"; expected one of min, max, not, "
         "in, "},
        {R"({"extends": "geeetech-a30t", "pages": {"Control/Home": {"buttons": {"Home X": {"prepare": "Homme all"}}}}})",
         "/pages/Control~1Home: \"Control/Home/Home X\" is prepared by pressing \"Homme all\": there is no "
         "button "
         "\"Homme all\"; did you mean \"Control/Home/Home all\""},
        {R"({"extends": "geeetech-a30t", "values": {"Speed": {}}})",
         "/values/Speed: \"Speed\" is no name for a value; expected small letters, digits, _ and dots"},
        {R"({"extends": "geeetech-a30t", "pages": {"Setting": {"without": "Retrun button"}}})",
         "/pages/Setting/without: no button \"Retrun button\" stands everywhere; did you mean \"Return "
         "button\"?"},
        {R"({"extends": "geeetech-a30t", "pages": {"Control/Home": {"buttons": {"Home X": {"send": "G28\nX0"}}}}})",
         "a control character in a line; line ends are added by the framing"},
        {R"({"extends": "geeetech-a30t", "pages": {"Control/Home": {"buttons": {"Home X": {"expect": {}}}}}})",
         "/pages/Control~1Home/buttons/Home X/expect: expected either \"frame\" or \"line\""},
        {R"({"extends": "btt-tft", "frames": {"done": {"answers": "M5"}}})",
         "/frames/done/answers: the screen does not wait for an answer to \"M5\"; see /talk/waits"},
        {R"({"extends": "btt-tft", "frames": {"done": {"verdict": "stals", "why": "x"}}})",
         "/frames/done/verdict: found the text \"stals\"; expected one of ok, ignored, part missed, "},
        {R"({"extends": "btt-tft", "frames": {"done": {"verdict": "stalls"}}})",
         "/frames/done/why: a verdict and why it is so stand together"},
        {R"({"extends": "btt-tft", "values": {"line.word": {"is": "page"}}})",
         "/values/line.word/is: a page is a text, a size of the line a number"},
        {R"({"extends": "btt-tft", "talk": {"polls": [{"send": "M105"}]}})",
         "/talk/polls/0: the key \"every_ms\" is missing"}};
    for (const Wrong& wrong : wrongs) {
        CAPTURE(wrong.json);
        const std::string sentence = refusal(wrong.json);
        CHECK_MESSAGE(sentence.find(wrong.sentence) != std::string::npos, sentence);
    }
}

TEST_CASE("the shipped screens load, alone and as a base") {
    for (const char* name : {"smartto-screen", "geeetech-a30", "geeetech-a30t", "btt-tft"}) {
        const auto profile = shipped_screen(name);
        CHECK(profile->name == name);
        CHECK(!profile->assumed.empty());
    }
    CHECK(refusal(R"({"extends": "geeetech-a30", "name": "mine"})") == "");
}

TEST_CASE("the shipped screens fit their schema, and a wrong one does not") {
    const auto read = [](const std::string& file) {
        std::ifstream in(FAUXBOARD_SOURCE_DIR "/profiles/" + file);
        return nlohmann::json::parse(in);
    };
    const nlohmann::json schema = read("schemas/screen.schema.json");
    const auto complaints = [&](const nlohmann::json& document) {
        std::string out;
        for (const tools::SchemaError& error : tools::check_schema(schema, document)) {
            out += error.pointer + ": " + error.message + '\n';
        }
        return out;
    };
    for (const char* name : {"smartto-screen", "geeetech-a30", "geeetech-a30t", "btt-tft"}) {
        CHECK(complaints(read(std::string("screens/") + name + ".json")) == "");
    }
    CHECK(complaints(nlohmann::json::parse(R"({"name": "x", "pags": {}})")) != "");
    CHECK(complaints(nlohmann::json::parse(R"({"pages": {"Main": {"buttons": {"A": {"sends": "G28"}}}}})")) !=
          "");
}
