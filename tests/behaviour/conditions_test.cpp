// Every kind of test that a `when` can make.

#include <doctest/doctest.h>

#include <string>

#include "emulator/behaviour/rule_compiler.h"
#include "tests/support/printers.h"
#include "tests/support/small_profile.h"

using namespace fauxboard;
using namespace fauxboard::behaviour;
using std::string;

namespace {

bool holds(const string& when, const string& request = "M1 S2 P5") {
    static const auto profile = fauxboard::testing::small_profile();
    filament::Printer machine(std::static_pointer_cast<const filament::Config>(profile->machine), {}, 1);
    machine.power_on(machine::SimTime{0});
    machine.screen.firmware = "V1.02";
    const std::vector<double> variables{1.5};
    Document document;
    Findings findings{document, {}};
    Names names;
    names.variables.emplace("count", 0);
    names.request = true;
    RuleCompiler compiler(findings, names, {}, *profile->machine);
    const auto conditions = compiler.conditions(Json::parse(when), "");
    for (const Problem& problem : findings.problems) {
        FAIL_CHECK(when << ": " << problem.sentence());
    }
    const auto command = protocol::parse_command(request);
    return all_hold(conditions, {machine, variables, &*command, nullptr, 0});
}

}  // namespace

TEST_CASE("conditions: equal") {
    CHECK(holds(R"({"S": 2})"));
    CHECK_FALSE(holds(R"({"S": 3})"));
    CHECK_FALSE(holds(R"({"Q": 0})"));  // not on the line is not 0
    CHECK(holds(R"({"motors.enabled": false})"));
    CHECK_FALSE(holds(R"({"motors.enabled": true})"));
    CHECK(holds(R"({"screen.firmware": "V1.02"})"));
    CHECK_FALSE(holds(R"({"screen.firmware": "v1.02"})"));
    CHECK(holds(R"({"var.count": 1.5})"));
    CHECK(holds(R"({"arg": "LCD"})", "M20 LCD "));
    CHECK(holds(R"({"arg": ""})", "M20"));
    CHECK(holds(R"({"S?": 1, "Q?": 0})"));
}

TEST_CASE("conditions: not") {
    CHECK(holds(R"({"S": {"not": 3}})"));
    CHECK_FALSE(holds(R"({"S": {"not": 2}})"));
    CHECK(holds(R"({"Q": {"not": 2}})"));
    CHECK(holds(R"({"screen.firmware": {"not": "V9"}})"));
}

TEST_CASE("conditions: min and max, bounds included") {
    CHECK(holds(R"({"S": {"min": 2}})"));
    CHECK(holds(R"({"S": {"max": 2}})"));
    CHECK(holds(R"({"S": {"min": 1, "max": 3}})"));
    CHECK_FALSE(holds(R"({"S": {"min": 2.001}})"));
    CHECK_FALSE(holds(R"({"S": {"max": 1.999}})"));
    CHECK_FALSE(holds(R"({"Q": {"min": -10}})"));  // nothing lies in no range
}

TEST_CASE("conditions: in") {
    CHECK(holds(R"({"S": {"in": [1, 2, 3]}})"));
    CHECK_FALSE(holds(R"({"S": {"in": [1, 3]}})"));
    CHECK_FALSE(holds(R"({"Q": {"in": [0, 1]}})"));
    CHECK(holds(R"({"screen.firmware": {"in": ["V1.01", "V1.02"]}})"));
}

TEST_CASE("conditions: present and absent") {
    CHECK(holds(R"({"S": {"present": true}})"));
    CHECK(holds(R"({"Q": {"present": false}})"));
    CHECK_FALSE(holds(R"({"Q": {"present": true}})"));
    CHECK_FALSE(holds(R"({"S": {"present": false}})"));
    CHECK(holds(R"({"S": {"present": true}})", "M1 S"));  // the letter alone is there
    CHECK(holds(R"({"FW:": {"present": true}})", "M1 FW:1"));
}

TEST_CASE("conditions: starts_with") {
    CHECK(holds(R"({"arg": {"starts_with": "file:"}})", "M20 file:SD1:/x"));
    CHECK_FALSE(holds(R"({"arg": {"starts_with": "file:"}})", "M20 xfile:"));
    CHECK(holds(R"({"arg": {"starts_with": ""}})", "M20"));
    CHECK(holds(R"({"text": {"starts_with": "  a"}})", "M117  a"));
}

TEST_CASE("conditions: all must hold, none is always true") {
    CHECK(holds("{}"));
    CHECK(holds(R"({"S": 2, "P": 5})"));
    CHECK_FALSE(holds(R"({"S": 2, "P": 6})"));
    CHECK(holds(R"({"S": {"min": 1, "not": 3, "in": [2], "present": true}})"));
    CHECK_FALSE(holds(R"({"S": {"min": 1, "not": 2, "in": [2]}})"));
}
