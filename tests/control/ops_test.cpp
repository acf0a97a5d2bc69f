// Every op, and every way to get it wrong.

#include "emulator/control/ops.h"

#include <algorithm>
#include <set>

#include "emulator/behaviour/kind.h"
#include "tests/control/bench.h"
#include "tests/support/printers.h"

namespace fauxboard::control::test {
namespace {

/// Fields of kinds of machine other than the bench's own, which is the first.
bool of_another_kind(std::string_view path) {
    const auto others = behaviour::kinds().subspan(1);
    return std::any_of(others.begin(), others.end(), [&](const behaviour::KindRow* kind) {
        const auto fields = kind->fields();
        return std::any_of(fields.begin(), fields.end(),
                           [&](const behaviour::Field& field) { return field.path == path; });
    });
}

TEST_CASE("get: fields, groups, variables, all of them, with their types") {
    Bench bench;
    Client client(bench);
    const Json one = client.ask(R"({"id": 7, "op": "get", "fields": "heaters.nozzle.target"})");
    CHECK(one["id"] == 7);
    CHECK(one["ok"] == true);
    CHECK(one["fields"]["heaters.nozzle.target"] == 0.0);
    CHECK(one["t"] == 1.0);
    const Json group = client.ask(R"({"op": "get", "fields": ["heaters.nozzle", "heaters.bed.on"]})");
    CHECK_FALSE(group.contains("id"));
    CHECK(group["fields"].size() > 4);
    CHECK(group["fields"]["heaters.bed.on"] == false);
    CHECK(group["fields"]["heaters.nozzle.true"].is_number_float());
    const Json all = client.ask(R"({"op": "get"})");
    CHECK(all["fields"].size() == all_places(bench.own).size());
    for (const behaviour::Field& field : behaviour::fields()) {
        CAPTURE(std::string(field.path));
        const Json& value = all["fields"][std::string(field.path)];
        const bool fits = field.type == behaviour::FieldType::text ? value.is_string()
                          : field.type == behaviour::FieldType::boolean
                              ? value.is_boolean()
                              : value.is_number() || value.is_null();
        // What only another kind of machine has has no value here.
        const bool absent =
            value.is_null() && (of_another_kind(field.path) || field.path.starts_with("config."));
        CHECK((fits || absent));
    }
}

TEST_CASE("get: values are of this moment, not of when the board last did something") {
    Bench bench;
    Client client(bench);
    client.ask(R"({"op": "set", "fields": {"heaters.nozzle.target": 200}})");
    bench.pass(20s);  // the sensor feels it late
    double last = 0;
    for (int i = 0; i < 20; ++i) {
        bench.pass(SimTime{1'003'001});
        const Json answer = client.ask(R"({"op": "get", "fields": "heaters.nozzle.true"})");
        CHECK(answer["fields"]["heaters.nozzle.true"] > last);
        last = answer["fields"]["heaters.nozzle.true"];
    }
}

TEST_CASE("looking changes nothing: with a client that looks all the time the board says the same bytes") {
    Bench alone;
    Bench watched;
    Client client(watched);
    client.ask(R"({"op": "subscribe", "topic": "state", "every": "10ms"})");
    for (Bench* bench : {&alone, &watched}) {
        bench->own.receive(bench->now, protocol::frame("M104 S210") + protocol::frame("G28"));
    }
    for (int i = 0; i < 300; ++i) {
        alone.pass(137ms);
        watched.pass(137ms);
        client.ask(R"({"op": "get"})");
    }
    CHECK(alone.sent.size() > 1000);
    CHECK(alone.sent == watched.sent);
}

TEST_CASE("set: the field, and its page on the screen, have the value") {
    Bench bench;
    Client client(bench);
    const Json answer =
        client.ask(R"({"op": "set", "fields": {"heaters.nozzle.target": 205, "heaters.bed.target": 61}})");
    CHECK(answer["ok"] == true);
    CHECK(answer["fields"] == Json{{"heaters.nozzle.target", 205.0}, {"heaters.bed.target", 61.0}});
    CHECK(bench.answers());
    CHECK(bench.sent.find("/205.0 /1") != std::string::npos);
}

TEST_CASE("set: what is out of bounds, read only or of the wrong type is an error, and nothing is set") {
    Bench bench;
    Client client(bench);
    const auto error = [&](const std::string& fields) {
        return client.ask(R"({"op": "set", "fields": {"heaters.bed.target": 50, )" + fields + "}}")["error"];
    };
    const Json beyond = error(R"("heaters.nozzle.target": 1001)");
    CHECK(beyond["code"] == "out-of-range");
    CHECK(has(beyond["message"], "expected 0 to 1000 C"));
    CHECK(error(R"("heaters.nozzle.target": -0.5)")["code"] == "out-of-range");
    CHECK(error(R"("heaters.nozzle.target": 1e308)")["code"] == "out-of-range");
    CHECK(error(R"("heaters.nozzle.target": 18446744073709551615)")["code"] == "out-of-range");
    CHECK(error(R"("heaters.nozzle.true": 20)")["code"] == "read-only");
    CHECK(error(R"("heaters.nozzle.target": "hot")")["code"] == "wrong-type");
    CHECK(error(R"("heaters.nozzle.target": true)")["code"] == "wrong-type");
    CHECK(error(R"("heaters.nozzle.target": null)")["code"] == "wrong-type");
    CHECK(error(R"("heaters.nozzle.target": [200])")["code"] == "wrong-type");
    const Json unknown = error(R"("heaters.nozle.target": 200)");
    CHECK(unknown["code"] == "unknown-field");
    CHECK(unknown["nearest"] == "heaters.nozzle.target");
    CHECK(client.ask(R"({"op": "get", "fields": "heaters.bed.target"})")["fields"]["heaters.bed.target"] ==
          0.0);
    CHECK(bench.answers());
}

TEST_CASE("set, do: what the machine does not allow it keeps within its limit, and both say so") {
    Bench bench;
    Client client(bench);
    const Json set = client.ask(R"({"op": "set", "fields": {"heaters.nozzle.target": 999}})");
    CHECK(set["ok"] == true);
    CHECK(set["fields"]["heaters.nozzle.target"] == 250.0);
    CHECK(has(set["notices"][0]["text"],
              "heaters.nozzle.target: 999 is beyond what the machine allows; taken as 250"));
    const Json done = client.ask(R"({"op": "do", "do": {"heater.target": {"heater": "nozzle", "c": 999}}})");
    CHECK(done["ok"] == true);
    CHECK(has(done["notices"][0]["text"], "taken as 250 C"));
}

TEST_CASE("set: every settable field takes both of its bounds, and nothing beyond them") {
    Bench bench;
    Client client(bench);
    int tried = 0;
    for (const behaviour::Field& field : behaviour::fields()) {
        if (field.set == nullptr || field.type == behaviour::FieldType::text) {
            continue;
        }
        CAPTURE(std::string(field.path));
        const auto set = [&](const Json& value) {
            return client.code(Json{{"op", "set"}, {"fields", {{field.path, value}}}}.dump());
        };
        const bool has_it = !field.get(bench.own.machine()).none();  // boards of other kinds do
        CHECK(set(field.min) == (has_it ? "" : "refused"));
        CHECK(set(field.max) == (has_it ? "" : "refused"));
        CHECK(set(field.max + 1) == "out-of-range");
        CHECK(set(field.min - 1) == "out-of-range");
        ++tried;
    }
    CHECK(tried > 20);
    bench.pass(10s);
    CHECK(bench.answers());
}

TEST_CASE("do: actions as in profiles, by phrase, in lists; refusals are errors") {
    Bench bench;
    Client client(bench);
    CHECK(client.code(R"({"op": "do", "do": {"heater.target": {"heater": "nozzle", "c": 199}}})").empty());
    CHECK(testing::filament_printer(bench.own.machine()).thermal.target_c(filament::HeaterId::nozzle) == 199);
    CHECK(client.code(R"({"op": "do", "do": "filament in"})").empty());
    CHECK(client.code(R"({"op": "do", "do": ["motion.home", {"set": {"heaters.bed.target": 40}}]})").empty());
    CHECK(client.code(R"({"op": "do", "do": {"stepper.select": {"motor": 9}}})") == "refused");
    CHECK(client.code(R"({"op": "do", "do": {"heater.target": {"c": 199}}})") == "bad-arguments");
    CHECK(client.code(R"({"op": "do", "do": {"heater.target": {"heater": "nozzle", "c": "x"}}})") ==
          "bad-arguments");
    CHECK(client.code(R"({"op": "do", "do": {"heater.target": {"heater": "nozzle", "c": "{S}"}}})") ==
          "bad-arguments");
    CHECK(client.code(R"({"op": "do", "do": {"set": {"heaters.bed.target": 4000}}})") == "out-of-range");
    CHECK(client.code(R"({"op": "do", "do": 5})") == "bad-arguments");
    CHECK(client.code(R"({"op": "do", "do": [["motion.home"]]})") == "bad-arguments");
    const Json unknown = client.ask(R"({"op": "do", "do": "motion.hom"})")["error"];
    CHECK(unknown["code"] == "unknown-action");
    CHECK(unknown["nearest"] == "motion.home");
    CHECK(client.code(R"({"op": "do", "do": "heater.target"})") == "bad-arguments");
    bench.pass(60s);
    CHECK(testing::filament_printer(bench.own.machine()).motion.busy() == false);
    CHECK(bench.answers());
}

TEST_CASE("world: phrases of recordings; notices come with the answer") {
    Bench bench;
    Client client(bench);
    CHECK(client.code(R"({"op": "world", "do": "card out"})").empty());
    CHECK(client.code(R"({"op": "world", "do": "card in"})").empty());
    const Json wrong = client.ask(R"({"op": "world", "do": "filament inn"})")["error"];
    CHECK(wrong["code"] == "unknown-action");
    CHECK(wrong["nearest"] == "filament in");
    const Json nothing = client.ask(R"({"op": "do", "do": "job.start"})");
    CHECK(nothing["ok"] == true);
    CHECK(has(nothing["notices"][0]["text"], "nothing to start"));
    CHECK(client.code(R"({"op": "world", "do": "board reset"})").empty());
    bench.pass(2s);
    CHECK(bench.sent.find("L9 ") != std::string::npos);
    CHECK(bench.answers());
}

TEST_CASE("send: a frame of the profile, a line, raw bytes") {
    Bench bench;
    Client client(bench);
    bench.sent.clear();
    CHECK(client.code(R"({"op": "send", "frame": "L2"})").empty());
    CHECK(bench.sent.find("L2 B:") != std::string::npos);
    bench.sent.clear();
    CHECK(client.code(R"({"op": "send", "line": "L18 P1 S2"})").empty());
    CHECK(bench.sent == protocol::frame("L18 P1 S2"));
    bench.sent.clear();
    CHECK(client.code(R"({"op": "send", "raw": "\u00ff\u0000x"})").empty());
    CHECK(bench.sent == std::string("\xff\0x\r\n", 5));
    const Json unknown = client.ask(R"({"op": "send", "frame": "L22x"})")["error"];
    CHECK(unknown["code"] == "unknown-frame");
    CHECK(unknown["nearest"] == "L22");
    CHECK(client.code(R"({"op": "send"})") == "bad-request");
    CHECK(client.code(R"({"op": "send", "frame": "L2", "raw": "x"})") == "bad-request");
    CHECK(client.code(R"({"op": "send", "line": "two\nlines"})") == "bad-arguments");
    CHECK(client.code(R"({"op": "send", "raw": "\u0100"})") == "wrong-type");
    CHECK(client.code(R"({"op": "send", "line": ")" + std::string(513, 'x') + "\"}") == "out-of-range");
    CHECK(client.code(R"({"op": "send", "raw": ")" + std::string(2049, 'x') + "\"}") == "out-of-range");
    CHECK(bench.answers());
}

TEST_CASE("faults: add, list, change, remove, clear, and the mistakes") {
    Bench bench;
    Client client(bench);
    CHECK(client.ask(R"({"op": "faults.list"})")["faults"].empty());
    const Json id = client.ask(R"({"op": "faults.add", "spec": "drop:to_screen,every=2"})")["fault"];
    CHECK(id == 1);
    CHECK(
        client.code(R"({"op": "faults.add", "spec": {"kind": "garble", "direction": "to_board"}})").empty());
    CHECK(client.ask(R"({"op": "faults.list"})")["faults"].size() == 2);
    CHECK(client.code(R"({"op": "faults.change", "fault": 1, "spec": "drop:to_screen,every=3"})").empty());
    CHECK(client.ask(R"({"op": "faults.list"})")["faults"][0].dump().find("3") != std::string::npos);
    CHECK(client.ask(R"({"op": "status"})")["faults"] == 2);
    CHECK(client.code(R"({"op": "faults.remove", "fault": 1})").empty());
    CHECK(client.code(R"({"op": "faults.remove", "fault": 1})") == "unknown-fault");
    CHECK(client.code(R"({"op": "faults.remove", "fault": -1})") == "unknown-fault");
    CHECK(client.code(R"({"op": "faults.remove", "fault": 1.5})") == "unknown-fault");
    CHECK(client.code(R"({"op": "faults.change", "fault": 99, "spec": "drop"})") == "unknown-fault");
    CHECK(client.code(R"({"op": "faults.add", "spec": "dorp"})") == "bad-arguments");
    CHECK(client.code(R"({"op": "faults.add", "spec": 5})") == "bad-arguments");
    CHECK(client.code(R"({"op": "faults.add"})") == "bad-request");
    CHECK(client.code(R"({"op": "faults.clear"})").empty());
    CHECK(client.ask(R"({"op": "faults.list"})")["faults"].empty());
    bench.with_faults = false;
    CHECK(client.code(R"({"op": "faults.add", "spec": "drop"})") == "not-here");
    CHECK(client.ask(R"({"op": "faults.list"})")["faults"].empty());
    CHECK(bench.answers());
}

TEST_CASE("advance: is answered when time has got there, and further requests wait for that") {
    Bench bench;
    Client client(bench);
    client.session.receive(
        "{\"id\": 1, \"op\": \"set\", \"fields\": {\"heaters.bed.target\": 60}}\n"
        "{\"id\": 2, \"op\": \"advance\", \"by\": \"10min\"}\n{\"id\": 3, \"op\": \"status\"}\n");
    CHECK(client.lines().size() == 1);
    CHECK_FALSE(client.session.wants_input());
    bench.jump();
    const auto done = client.lines();
    REQUIRE(done.size() == 1);
    CHECK(done[0]["id"] == 2);
    CHECK(done[0]["t"] == 601.0);
    client.session.proceed();
    const auto rest = client.lines();
    REQUIRE(rest.size() == 1);
    CHECK(rest[0]["id"] == 3);
    CHECK(rest[0]["t"] == 601.0);
    CHECK(client.session.wants_input());
    CHECK(testing::filament_printer(bench.own.machine()).thermal.temperature_c(filament::HeaterId::bed) > 55);
    for (const char* by : {"0s", "31h5", "\"", "-5s", "1e999s", "9000h", ""}) {
        CAPTURE(by);
        CHECK_FALSE(client.code(Json{{"op", "advance"}, {"by", by}}.dump()).empty());
    }
    CHECK(client.code(R"({"op": "advance", "by": 0})") == "out-of-range");
    CHECK(client.code(R"({"op": "advance", "by": 1e300})") == "out-of-range");
    CHECK(client.code(R"({"op": "advance", "by": []})") == "wrong-type");
    CHECK(bench.answers());
}

TEST_CASE("advance: the end of the run answers who still waits") {
    Bench bench;
    Client client(bench);
    client.session.receive("{\"id\": 5, \"op\": \"advance\", \"by\": 100}\n");
    bench.hub.on_end();
    const auto lines = client.lines();
    REQUIRE(lines.size() == 1);
    CHECK(lines[0]["id"] == 5);
    CHECK(lines[0]["error"]["code"] == "ended");
    CHECK(client.session.over());
}

TEST_CASE("status, describe, quit") {
    Bench bench;
    Client client(bench);
    const Json status = client.ask(R"({"op": "status"})");
    CHECK(status["profile"] == "geeetech-a30t");
    CHECK(status["clients"] == 1);
    CHECK(status["link"]["kind"] == "none");
    CHECK(status["counters"]["lines_sent"] > 5);
    const Json all = client.ask(
        R"({"op": "describe", "what": ["control", "fields", "variables", "actions", "frames", "faults"]})");
    CHECK(all["control"] == describe_control());
    CHECK(all["fields"].size() == behaviour::fields().size());
    CHECK(all["actions"].size() == behaviour::actions().size());
    CHECK(all["frames"].size() == bench.own.profile().frames.size());
    const Json wrong = client.ask(R"({"op": "describe", "what": "feilds"})")["error"];
    CHECK(wrong["nearest"] == "fields");
    CHECK_FALSE(bench.ended);
    CHECK(client.code(R"({"op": "quit"})").empty());
    CHECK(bench.ended);
}

TEST_CASE("each op, topic and error has its words, and a name of its own") {
    std::set<std::string_view> names;
    for (const Op& op : ops()) {
        CHECK(names.insert(op.name).second);
        CHECK(op.help.size() > 10);
        const bool runs = op.run != nullptr;
        CHECK(runs);
        for (const Param& param : op.params) {
            CHECK(param.help.size() > 5);
        }
    }
    std::set<ErrorCode> codes;
    for (const ErrorInfo& error : errors()) {
        CHECK(codes.insert(error.code).second);
        CHECK(error_name(error.code) == error.name);
    }
    CHECK(codes.size() == static_cast<std::size_t>(ErrorCode::internal) + 1);
    for (const Topic& topic : topics()) {
        CHECK(Json::parse(topic.example)["event"].is_string());
    }
}

}  // namespace
}  // namespace fauxboard::control::test
