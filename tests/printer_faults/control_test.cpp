// The verbs of the control channel for faults of the printer, their times, and the bounds of the list.

#include <doctest/doctest.h>

#include <set>

#include "emulator/behaviour/fields.h"
#include "emulator/fault/kind.h"
#include "tests/printer_faults/rig.h"
#include "tests/support/printers.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using control::Json;

namespace {

Json add(const std::string& spec) {
    return {{"op", "faults.add"}, {"spec", spec}};
}

std::string code(Rig& rig, const Json& request) {
    const Json answer = rig.ask(request);
    return answer["ok"].get<bool>() ? "" : answer["error"]["code"].get<std::string>();
}

std::string state(Rig& rig, const std::string& id) {
    const Json answer = rig.do_it({{"op", "faults.list"}});
    for (const Json& fault : answer["faults"]) {
        if (fault["id"] == id) {
            return fault["state"];
        }
    }
    return "gone";
}

}  // namespace

TEST_CASE("add, list, change, remove and clear, and their mistakes") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    CHECK(rig.do_it(add("jam:lost=50"))["fault"] == "p1");
    CHECK(rig.do_it(Json{{"op", "faults.add"},
                         {"spec", {{"kind", "endstop_dead"}, {"axis", "z"}}}})["fault"] == "p2");
    const Json list = rig.do_it({{"op", "faults.list"}})["faults"];
    REQUIRE(list.size() == 2);
    CHECK(list[0] == Json{{"id", "p1"},
                          {"fault", {{"kind", "jam"}, {"lost", 50.0}}},
                          {"state", "active"},
                          {"begin", 5.0},
                          {"over", false}});
    CHECK(rig.do_it({{"op", "status"}})["faults"] == 2);
    CHECK(rig.number("faults.jam") == 1);
    CHECK(rig.do_it({{"op", "faults.change"}, {"fault", "p1"}, {"spec", "refused"}})["fault"] == "p3");
    CHECK(rig.number("faults.jam") == 0);
    CHECK(rig.number("faults.refused") == 1);
    CHECK(code(rig, {{"op", "faults.remove"}, {"fault", "p3"}}).empty());
    CHECK(rig.number("faults.refused") == 0);
    CHECK(code(rig, {{"op", "faults.remove"}, {"fault", "endstop_dead"}}).empty());
    CHECK(rig.do_it({{"op", "faults.list"}})["faults"].empty());

    for (const char* id : {"p1", "p0", "p99", "p", "p1x", "p4294967296", "endstop_dead", ""}) {
        CAPTURE(std::string(id));
        CHECK(code(rig, {{"op", "faults.remove"}, {"fault", id}}) == "unknown-fault");
    }
    CHECK(rig.ask({{"op", "faults.remove"}, {"fault", "endstop-dead"}})["error"]["nearest"] ==
          "endstop_dead");
    CHECK(code(rig, {{"op", "faults.change"}, {"fault", "p9"}, {"spec", "jam"}}) == "unknown-fault");
    CHECK(code(rig, {{"op", "faults.change"}, {"fault", "p9"}, {"spec", "drop"}}) == "bad-arguments");
    CHECK(code(rig, add("heater_ded")) == "bad-arguments");
    CHECK(rig.ask(add("heater_ded"))["error"]["message"].get<std::string>().find(
              "did you mean \"heater_dead\"?") != std::string::npos);
    CHECK(rig.number("faults.jam") == 0);
    CHECK(rig.answers());
}

TEST_CASE("times: at, from, until and for, a past one, and one that was over before it began") {
    Rig rig("geeetech-a30t", "geeetech-a30t", {"jam:at=10s,for=5s", "refused:from=12s,until=20s"});
    const auto both = [&] { return rig.number("faults.jam") + 10 * rig.number("faults.refused"); };
    rig.run_until(9.99);
    CHECK(both() == 0);
    rig.run_until(10);
    CHECK(both() == 1);
    rig.run_until(12);
    CHECK(both() == 11);
    rig.run_until(15);
    CHECK(both() == 10);
    CHECK(state(rig, "p1") == "over");
    rig.run_until(20);
    CHECK(both() == 0);
    rig.add_fault("jam:at=1s");
    CHECK(both() == 1);
    rig.do_it({{"op", "faults.clear"}});
    rig.add_fault("jam:until=19s");
    CHECK(both() == 0);
    CHECK(state(rig, "p4") == "over");
    rig.add_fault("jam:at=1h");
    CHECK(state(rig, "p5") == "waiting");
    rig.do_it({{"op", "faults.remove"}, {"fault", "jam"}});
    CHECK(state(rig, "p5") == "gone");
}

TEST_CASE("of one kind and part there is one: the newer takes the older's place; other parts are let be") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    rig.add_fault("heater_dead:power=50");
    rig.add_fault("heater_dead:heater=bed");
    rig.add_fault("heater_dead:power=20");
    CHECK(state(rig, "p1") == "over");
    CHECK(state(rig, "p2") == "active");
    CHECK(filament_printer(rig.machine()).thermal.trouble(filament::HeaterId::nozzle).strength == 0.2);
    CHECK(filament_printer(rig.machine()).thermal.trouble(filament::HeaterId::bed).strength == 0);
    rig.do_it({{"op", "faults.remove"}, {"fault", "p1"}});
    CHECK(filament_printer(rig.machine()).thermal.trouble(filament::HeaterId::nozzle).strength == 0.2);
    rig.do_it({{"op", "faults.clear"}});
    CHECK(filament_printer(rig.machine()).thermal.trouble(filament::HeaterId::nozzle) ==
          filament::HeaterTrouble{});
    CHECK(filament_printer(rig.machine()).thermal.trouble(filament::HeaterId::bed) ==
          filament::HeaterTrouble{});
}

TEST_CASE("the list is bounded: what is over makes room, what is not does not") {
    Rig rig("geeetech-a30t", "geeetech-a30t");
    rig.run_until(5);
    for (int i = 0; i < 500; ++i) {
        rig.add_fault("jam");
    }
    CHECK(rig.do_it({{"op", "faults.list"}})["faults"].size() == machine::Faults::most);
    rig.do_it({{"op", "faults.clear"}});
    for (std::size_t i = 0; i < machine::Faults::most; ++i) {
        rig.add_fault("jam:at=1h");
    }
    CHECK(code(rig, add("jam")) == "refused");
    CHECK(rig.answers());
}

TEST_CASE("the table: words, a field, parameters in bounds, an event that exists, and a way back") {
    std::set<std::string_view> names;
    for (const machine::FaultInfo* row : machine::fault_rows()) {
        const machine::FaultInfo& info = *row;
        const std::string name(info.name);
        CAPTURE(name);
        CHECK(names.insert(info.name).second);
        CHECK(info.help.size() > 20);
        CHECK(info.help.back() != '.');
        const bool begins = info.begin != nullptr;
        CHECK(begins);
        const bool ends = info.end != nullptr || info.gone == nullptr;
        CHECK(ends);
        CHECK(behaviour::find_field("faults." + name) != nullptr);
        CHECK(fault::find_kind(name) != nullptr);
        CHECK(info.length > machine::SimTime{0});
        for (const machine::FaultParameter& parameter : info.parameters) {
            CHECK(parameter.help.size() > 8);
            CHECK(parameter.min < parameter.max);
            CHECK(parameter.fallback >= parameter.min);
            CHECK(parameter.fallback <= parameter.max);
            CHECK((parameter.unit == machine::FaultUnit::choice) != parameter.choices.empty());
            CHECK((parameter.choices.empty() ||
                   parameter.max == static_cast<double>(parameter.choices.size() - 1)));
        }
        for (const machine::EventId event : info.events) {
            CHECK(machine::find_event(event->name) == event);
        }
    }
    CHECK(machine::find_fault("") == nullptr);
}
