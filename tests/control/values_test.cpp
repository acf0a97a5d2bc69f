// What can be put into a place on the control channel: texts, switches, whole numbers, variables of the
// profile.

#include "tests/control/bench.h"

namespace fauxboard::control::test {
namespace {

struct Values {
    explicit Values(std::string_view profile = "geeetech-a30t") : bench(profile), client(bench) {}
    /// The error's code; "" when it was set.
    std::string set(const std::string& path, const Json& value) {
        return client.code(Json{{"op", "set"}, {"fields", {{path, value}}}}.dump());
    }
    Json get(const std::string& path) {
        return client.ask(Json{{"op", "get"}, {"fields", path}}.dump())["fields"][path];
    }
    Bench bench;
    Client client;
};

TEST_CASE("set: texts are texts, of bytes that a line carries, and as long as the machine keeps them") {
    Values values;
    CHECK(values.set("wifi.ssid", "caf\u00e9").empty());
    CHECK(values.get("wifi.ssid") == "caf\u00e9");
    CHECK(values.set("wifi.ssid", std::string(39, 'x')).empty());
    CHECK(values.set("wifi.ssid", std::string(40, 'y')) == "out-of-range");
    CHECK(values.set("wifi.ssid", 5) == "wrong-type");
    CHECK(values.set("wifi.ssid", "\u2192") == "wrong-type");
    CHECK(values.get("wifi.ssid") == std::string(39, 'x'));
}

TEST_CASE("set: switches take true, false, 1 and 0") {
    Values values;
    CHECK(values.set("wifi.enabled", true).empty());
    CHECK(values.get("wifi.enabled") == true);
    CHECK(values.set("wifi.enabled", 0).empty());
    CHECK(values.get("wifi.enabled") == false);
    CHECK(values.set("wifi.enabled", 0.5) == "wrong-type");
    CHECK(values.set("wifi.enabled", "on") == "wrong-type");
    CHECK(values.set("wifi.enabled", 2) == "out-of-range");
}

TEST_CASE("set: what is counted in whole numbers takes no other ones") {
    Values values;
    CHECK(values.set("wifi.signal", 3).empty());
    CHECK(values.set("wifi.signal", 3.0).empty());
    CHECK(values.set("wifi.signal", 2.5) == "wrong-type");
    CHECK(values.get("wifi.signal") == 3);
}

TEST_CASE("set: variables of the profile are places of their own, and rules act by them") {
    Values values;
    CHECK(values.get("var.l5_replies") == 0.0);
    values.bench.sent.clear();
    values.bench.own.receive(values.bench.now, protocol::frame("M220 S90"));
    values.bench.pass(1s);
    CHECK(values.bench.sent.find("L5 ") == std::string::npos);
    CHECK(values.set("var.l5_replies", 1).empty());
    CHECK(values.get("var.l5_replies") == 1.0);
    values.bench.sent.clear();
    values.bench.own.receive(values.bench.now, protocol::frame("M220 S90"));
    values.bench.pass(1s);
    CHECK(values.bench.sent.find("L5 ") != std::string::npos);
    CHECK(values.set("var.l5_replies", true).empty());
    CHECK(values.set("var.l5_replies", "one") == "wrong-type");
    CHECK(values.set("var.l5_reply", 1) == "unknown-field");
    CHECK(values.client.code(R"({"op": "do", "do": {"set": {"var.l5_replies": 0}}})").empty());
    CHECK(values.get("var.l5_replies") == 0.0);
}

TEST_CASE("do, advance: what is too much for one request is refused") {
    Values values;
    Json many = Json::array();
    for (int i = 0; i < 65; ++i) {
        many.push_back("motion.home");
    }
    CHECK(values.client.code(Json{{"op", "do"}, {"do", many}}.dump()) == "bad-arguments");
    CHECK(values.client.code(R"({"op": "advance", "by": "900000h"})") == "out-of-range");
    CHECK(values.bench.answers());
}

TEST_CASE("reload: who watches fields watches on, and variables too") {
    Values values;
    values.client.ask(
        R"({"op": "subscribe", "topic": "state", "fields": ["heaters.bed.target", "var.l5_replies"]})");
    values.bench.hub.on_reload();
    CHECK(values.set("heaters.bed.target", 55).empty());
    values.bench.pass(1s);
    CHECK(values.get("heaters.bed.target") == 55.0);
    CHECK(values.bench.answers());
}

}  // namespace
}  // namespace fauxboard::control::test
