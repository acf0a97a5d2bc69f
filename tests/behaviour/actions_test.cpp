// Every action, at least once: what it does to the machine.

#include <set>

#include "tests/behaviour/action_bench.h"

using namespace fauxboard::testing;

TEST_CASE("actions: each does what its row says") {
    for (const auto* rows : {&machine_action_rows(), &device_action_rows(), &fault_action_rows(),
                             &host_action_rows(), &transfer_action_rows()}) {
        for (const ActionRow& row : *rows) {
            CAPTURE(row.action);
            Bench bench;
            bench.machine.events.clear();
            row.check(bench);
        }
    }
    for (const ActionRow& row : resin_action_rows()) {
        CAPTURE(row.action);
        Bench bench(small_profile(resin_profile));
        bench.machine.events.clear();
        row.check(bench);
    }
    for (const ActionRow& row : dlp_action_rows()) {
        CAPTURE(row.action);
        Bench bench(small_profile(dlp_profile));
        bench.pass(5);  // its start takes a while
        bench.machine.events.clear();
        row.check(bench);
    }
}

TEST_CASE("actions: those of another kind of machine are refused") {
    for (const auto* rows : {&resin_action_rows(), &dlp_action_rows()}) {
        for (const ActionRow& row : *rows) {
            if (string(row.action) == "board.wedge") {
                continue;  // any board can hang
            }
            CAPTURE(row.action);
            Bench bench;
            ActionContext context{bench.machine, bench.variables, bench};
            std::vector<Value> values;
            for (const ArgInfo& arg : find_action(row.action)->args) {
                values.push_back(arg.type == ArgType::text ? Value::of(std::string_view{"a"})
                                                           : Value::of(1.0));
            }
            find_action(row.action)->run(context, values);
            CHECK(bench.notices.size() == 1);
        }
    }
}

TEST_CASE("actions: none is left out of the tests above, and every one has its words") {
    std::set<std::string_view> tested;
    for (const auto* rows :
         {&machine_action_rows(), &device_action_rows(), &fault_action_rows(), &host_action_rows(),
          &resin_action_rows(), &dlp_action_rows(), &transfer_action_rows()}) {
        for (const ActionRow& row : *rows) {
            CHECK(tested.insert(row.action).second);
        }
    }
    for (const ActionInfo& action : actions()) {
        CAPTURE(action.name);
        CHECK(tested.erase(action.name) == 1);
        CHECK_FALSE(action.help.empty());
        CHECK(action.args.size() <= max_action_args);
        CHECK(find_action(action.name) == &action);
        for (const ArgInfo& arg : action.args) {
            CHECK_FALSE(arg.help.empty());
        }
    }
    CHECK(tested.empty());
}

TEST_CASE("actions: an argument that the line lacks skips the action when it is needed") {
    Bench bench;
    bench.run(R"({"heater.target": {"heater": "bed", "c": "{S}"}})", "M140");
    CHECK(bench.number("heaters.bed.target") == 0);
    REQUIRE(bench.notices.size() == 1);
    CHECK(bench.notices[0] == "heater.target: the line does not say c; nothing done");
    bench.run(R"({"heater.target": {"heater": "bed", "c": "{S|55}"}})", "M140");
    CHECK(bench.number("heaters.bed.target") == 55);
}

TEST_CASE("actions: recordings call some of them by a phrase") {
    for (const auto& [phrase, name] :
         {std::pair{"filament in", "filament.insert"}, std::pair{"filament out", "filament.remove"},
          std::pair{"card in", "card.insert"}, std::pair{"card out", "card.remove"},
          std::pair{"board reset", "board.reset"}, std::pair{"motors off", "motors.disable"},
          std::pair{"board.reset", "board.reset"}}) {
        const auto& shown_phrase = phrase;
        CAPTURE(shown_phrase);
        REQUIRE(find_world_action(phrase) != nullptr);
        CHECK(find_world_action(phrase)->name == name);
    }
    CHECK(find_world_action("set") == nullptr);
    CHECK(find_world_action("") == nullptr);
    CHECK(find_world_action("filament") == nullptr);
}
