// The little language of screens at its edges: numbers as the C library reads them, formats, conditions and
// the sentences about them.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/operand.h"
#include "emulator/screen/c_numbers.h"
#include "tests/screen/harness.h"

namespace fauxboard::testing {
namespace {

using screen::Condition;
using screen::Expression;
using screen::Scope;
using screen::Shown;
using screen::Template;
using screen::ValueInfo;
using screen::ValueKind;
using screen::ValueTable;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::vector<std::string> columns{"date"};
const std::vector<std::string> cells{"2020-09-08"};

/// A number n, a text t and a list l; what stands in them is given anew for each look.
struct Language {
    Language() {
        for (const auto& [name, kind] : {std::pair{"n", ValueKind::number}, std::pair{"t", ValueKind::text},
                                         std::pair{"l", ValueKind::list}}) {
            ValueInfo info;
            info.name = name;
            info.kind = kind;
            info.names = {{1, "one"}, {0, "none"}};
            table.add(info);
        }
        values.resize(3);
        values[2].list = {"first", "second"};
    }
    Scope scope() const { return {values, 2, "second", 7, cells}; }
    std::string text(std::string_view source) {
        return Template(source, table, {true, true, &columns}).render(scope());
    }
    double number(std::string_view source) {
        return Expression(source, table, {true, true}).evaluate(scope());
    }
    Condition condition(std::string_view left, std::string_view right) {
        return {left, behaviour::Json::parse(right), table, {true, true, &columns}};
    }
    /// What is wrong with a template; "" for nothing.
    std::string fault(std::string_view source, screen::Allowed allowed = {true, true, &columns}) {
        try {
            const Template made(source, table, allowed);
        } catch (const behaviour::ExpressionError& error) {
            return error.what();
        }
        return {};
    }

    ValueTable table;
    std::vector<Shown> values;
};

}  // namespace

TEST_CASE("numbers on the line are read as strtol and strtof read them") {
    struct Row {
        std::string text;
        double value;
        std::size_t used;
    };
    const std::string zeros(400, '0');
    for (const Row& row : std::vector<Row>{{"", 0, 0},
                                           {" \t\v-12x", -12, 6},
                                           {"\x0e"
                                            "5",
                                            0, 0},
                                           {"+7", 7, 2},
                                           {"+-7", 0, 0},
                                           {"-", 0, 0},
                                           {"2147483648", 2147483647, 10},
                                           {"-99999999999999999999", -2147483648.0, 21},
                                           {"/:", 0, 0}}) {
        CAPTURE(row.text);
        CHECK(screen::read_integer(row.text).value == row.value);
        CHECK(screen::read_integer(row.text).used == row.used);
    }
    for (const Row& row : std::vector<Row>{{"", 0, 0},
                                           {"--1", 0, 0},
                                           {"-+1", 0, 0},
                                           {"x", 0, 0},
                                           {"-1.5e1z", -15, 6},
                                           {"0XA", 10, 3},
                                           {"0x1.8p1", 3, 7},
                                           {"0x", 0, 1},
                                           {"0y", 0, 1},
                                           {"-0xg", 0, 2},
                                           {"1e-400", 0, 6},
                                           {"1E-400", 0, 6},
                                           {"1e-99999999999999999999", 0, 23},
                                           {"1e400", inf, 5},
                                           {"-1e+400", -inf, 7},
                                           {"1e99999999999999999999", inf, 22},
                                           {"0.1e999", inf, 7},
                                           {".1e999", inf, 6},
                                           {"0." + zeros + "1", 0, 403},
                                           {"1" + zeros, inf, 401},
                                           {"1" + zeros + "e-2", inf, 404},
                                           {"0x1p9999", inf, 8},
                                           {"0x1p-9999", 0, 9},
                                           {"1e39", inf, 4},
                                           {"infinity", inf, 8}}) {
        CAPTURE(row.text);
        CHECK(static_cast<double>(screen::read_real(row.text).value) == row.value);
        CHECK(screen::read_real(row.text).used == row.used);
    }
    CHECK(std::isnan(screen::read_real("nan").value));
}

TEST_CASE("expressions at their bounds") {
    Language of;
    of.values[0].number = 5;
    CHECK(of.number("mod(n, 0)") == 0);
    CHECK(of.number("mod(-1, 3)") == 2);
    CHECK(of.number(
              "days(2, 4) + days(2, 5) + days(4, 1) + days(6, 1) + days(9, 1) + days(11, 1) + days(1, 1)") ==
          29 + 28 + 4 * 30 + 31);
    CHECK(of.number("row * 100 + input + l") == 209);
    CHECK(Expression("n + l + 1", of.table, {}).values() == std::vector<std::size_t>{0, 2});
    CHECK(of.fault("{(n]}") == "in \"(n]\": expected ')' before \"]\"");
    CHECK(of.fault("{min(n)}") == "in \"min(n)\": expected ',' before \")\"");
    CHECK(of.fault("{n + [}") == "in \"n + [\": expected a number or a name before \"[\"");
    CHECK(of.fault("{Nozzle}") == "in \"Nozzle\": expected a number or a name before \"Nozzle\"");
    CHECK(of.fault("{row}", {}) == "in \"row\": \"row\" is known only to a button with \"rows\"");
    CHECK(of.fault("{row.text}", {}) ==
          "in \"row.text\": \"row.text\" is known only to a button with \"rows\"");
    CHECK(of.fault("{input}", {}) == "in \"input\": \"input\" is known only to a button with \"input\"");
    std::string steps = "1";
    for (int i = 0; i < 31; ++i)
        steps += "+1";
    CHECK(of.fault("{" + steps + "}") == "");
    CHECK(of.fault("{" + steps + "+1}").ends_with("more than 64 steps"));
    CHECK(of.fault("{1" + std::string(400, '0') + "}").ends_with("a number beyond all bounds"));
}

TEST_CASE("formats: each that there is, and what is like one") {
    Language of;
    of.values[0].number = 3725.5;
    of.values[1].text = "a.b.pws";
    CHECK(of.text("{n:.0f} {n:.6f} {n:d} {n:09d} {n:hms} {n:hm}") ==
          "3726 3725.500000 3725 000003725 01:02:05 01:02");
    CHECK(of.text("{t:0+1}|{t:2+1}|{t:7+9}|{t:stem}|{t:ending}|{row.date:5+2}|{row.text:1+2}") ==
          "a|b||a.b|.pws|09|ec");
    CHECK(of.text("}}{{{n:name}{n*0:d}") == "}{3725.50");
    of.values[0].number = 1;
    CHECK(of.text("{n:name}") == "one");
    of.values[0].number = nan;
    CHECK(of.text("{n} {n:d} {n:hms} {n:.2f} {n:name}") == "nan 0 00:00:00 nan none");
    of.values[0].number = -inf;
    CHECK(of.text("{n} {n:d} {n:.1f}") == "-inf 0 -inf");
    of.values[0].number = -1e300;
    CHECK(of.text("{n:d}") == "-1000000000000000");
    for (const char* bad : {"n:.7f", "n:.af", "n:./f", "n:.2d", "n:x2f", "n:1d", "n:02f", "n:0xd", "n:0/d",
                            "n:123d", "n:stem", "n + 1:name"}) {
        CAPTURE(bad);
        CHECK(of.fault("{" + std::string(bad) + "}").find("unknown format") == 0);
    }
    for (const char* bad : {"t:hms", "t:1", "t:+2", "t:1-2", "t:1+", "t:1+x", "t:1+2x", "t:1234+1"}) {
        CAPTURE(bad);
        CHECK(of.fault("{" + std::string(bad) + "}").find("is a text; expected no format") !=
              std::string::npos);
    }
    CHECK(of.fault("{n") == "a brace without its partner in \"{n\"");
}

TEST_CASE("conditions hold, and say what they want and what is") {
    Language of;
    of.values[0].number = 5;
    of.values[1].text = "part.gcode";
    struct Row {
        const char* left;
        const char* right;
        bool holds;
        const char* words;
        const char* now;
    };
    for (const Row& row : std::vector<Row>{
             {"n", "5", true, "n is 5", "5"},
             {"n", "true", false, "n is 1", "5"},
             {"n", "false", false, "n is 0", "5"},
             {"n", R"("l + 3")", true, "n is 5", "5"},
             {"n", R"({"in": [1, 5]})", true, "n is one of 1, 5", "5"},
             {"n", R"({"in": []})", false, "n is ", "5"},
             {"n", R"({"not": 5})", false, "n is not 5", "5"},
             {"n", R"({"min": 5})", true, "n is at least 5", "5"},
             {"n", R"({"min": 5.1})", false, "n is at least 5.1", "5"},
             {"n", R"({"max": 4})", false, "n is at most 4", "5"},
             {"n", R"({"max": 4, "min": 1})", false, "n is 1 to 4", "5"},
             {"n", R"({"max": 9, "min": 1})", true, "n is 1 to 9", "5"},
             {"t", R"("part.gcode")", true, "t is \"part.gcode\"", "\"part.gcode\""},
             {"t", R"({"not": ["a", "b"]})", true, "t is not \"a\", \"b\"", "\"part.gcode\""},
             {"t", R"({"ends_with": [".gco", ".gcode"]})", true, "t ends with \".gco\", \".gcode\"",
              "\"part.gcode\""},
             {"t", R"({"ends_not_with": ".gcode"})", false, "t does not end with \".gcode\"",
              "\"part.gcode\""},
             {"t", R"({"starts_with": "par"})", true, "t starts with \"par\"", "\"part.gcode\""},
             {"t", R"({"starts_not_with": "par"})", false, "t does not start with \"par\"", "\"part.gcode\""},
             {"row.text", R"("second")", true, "row.text is \"second\"", "\"second\""},
             {"row.date", R"({"starts_with": "2021"})", false, "row.date starts with \"2021\"",
              "\"2020-09-08\""}}) {
        CAPTURE(row.left);
        CAPTURE(row.right);
        const Condition one = of.condition(row.left, row.right);
        CHECK(one.holds(of.scope()) == row.holds);
        CHECK(one.words(of.scope()) == row.words);
        CHECK(one.now(of.scope()) == row.now);
    }
    // What is no number is within no bounds, and is nothing.
    of.values[0].number = nan;
    CHECK_FALSE(of.condition("n", R"({"min": 1})").holds(of.scope()));
    CHECK_FALSE(of.condition("n", R"({"max": 1})").holds(of.scope()));
    CHECK_FALSE(of.condition("n", "5").holds(of.scope()));
    CHECK(of.condition("n", R"({"not": 5})").holds(of.scope()));
}

}  // namespace fauxboard::testing
