// What was done to a machine, as recordings hold it, and back.

#include "emulator/behaviour/action_words.h"

#include "tests/behaviour/action_bench.h"
#include "tests/support/printers.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

/// The words of what `words` mean.
std::string there_and_back(const Bench& bench, std::string_view words) {
    std::string out;
    for (const ActionCall& call : parse_action_words(words, *bench.profile)) {
        out += action_words(call, {bench.machine, bench.variables, nullptr, nullptr, 0},
                            bench.profile->variables);
    }
    return out;
}

std::string refusal(const Bench& bench, std::string_view words) {
    try {
        parse_action_words(words, *bench.profile);
    } catch (const ActionWordsError& error) {
        return error.what();
    }
    return "(none)";
}

}  // namespace

TEST_CASE("action words: a phrase where there is one, a name where that says all, else JSON") {
    Bench bench;
    for (const char* words :
         {"filament in", "board reset", "job.start", R"({"heater.target":{"heater":"bed","c":60.0}})",
          R"({"set":{"wifi.signal":3.0}})", R"({"set":{"var.count":2.0}})", R"({"add":{"var.count":-1.0}})",
          R"({"card.enter":{"name":"Gr\u00fc\u00dfe"}})"}) {
        CAPTURE(std::string(words));
        CHECK(there_and_back(bench, words) == words);
    }
    CHECK(there_and_back(bench, "filament.insert") == "filament in");
}

TEST_CASE("action words: a value that is looked up stands as it was when it was done") {
    Bench bench;
    bench.printer().thermal.set_target(filament::HeaterId::bed, 45);
    CHECK(there_and_back(bench, R"({"heater.target": {"heater": "nozzle", "c": "{heaters.bed.target}"}})") ==
          R"({"heater.target":{"heater":"nozzle","c":45.0}})");
}

TEST_CASE("action words: what means nothing is refused with the reason") {
    Bench bench;
    CHECK(refusal(bench, "coffee in") == "is nothing that can be done to the machine");
    CHECK(refusal(bench, "") == "is nothing that can be done to the machine");
    CHECK(refusal(bench, "heater.target") == "is nothing that can be done to the machine");
    CHECK(refusal(bench, "{").starts_with("cannot be read: "));
    CHECK(refusal(bench, R"({"coffee.make":{}})") ==
          "cannot be done to the machine: unknown action \"coffee.make\"");
    CHECK(refusal(bench, R"({"set":{"no.such":1}})").starts_with("cannot be done to the machine: "));
    CHECK(refusal(bench, R"({"heater.target":{"heater":"bed"}})").find("\"c\"") != std::string::npos);
}
