// Lines, bad input, events, and clients that do not read.

#include "emulator/control/session.h"

#include <algorithm>

#include "tests/control/bench.h"

namespace fauxboard::control::test {
namespace {

TEST_CASE("what is no request is answered with an error that says what to do, and the session goes on") {
    Bench bench;
    Client client(bench);
    struct Wrong {
        std::string line;
        std::string code;
        std::string says;
    };
    const std::vector<Wrong> all{
        {"hello", "bad-json", "parse error"},
        {"{", "bad-json", "parse error"},
        {"{\"op\": \"get\"} x", "bad-json", "parse error"},
        {"{\"op\": NaN}", "bad-json", "parse error"},
        {"{\"op\": \"get\", \"id\": 1e999}", "bad-json", "number overflow"},
        {"{\"op\": \"get\", \"op\": \"quit\"}", "bad-json", "twice"},
        {"{\"op\": \"\xff\"}", "bad-json", "UTF-8"},
        {std::string("{\"op\": \"g\0t\"}", 13), "bad-json", "parse error"},
        {std::string(200, '['), "bad-json", "deeper"},
        {R"({"op": "get", "id": )" + std::string(100, '[') + std::string(100, ']') + "}", "bad-json",
         "deeper"},
        {"[]", "bad-json", "expected a JSON object"},
        {"5", "bad-json", "expected a JSON object"},
        {"null", "bad-json", "expected a JSON object"},
        {"{}", "bad-request", "describe"},
        {R"({"op": 5})", "bad-request", "describe"},
        {R"({"op": "gett"})", "unknown-op", "known: get, set"},
        {R"({"op": ""})", "unknown-op", "known"},
        {R"({"op": "get", "feilds": "heaters"})", "bad-request", "takes no \"feilds\""},
        {R"({"op": "get", "fields": 5})", "wrong-type", "a text or a list of texts"},
        {R"({"op": "get", "fields": ["heaters", 5]})", "wrong-type", "a text or a list of texts"},
        {R"({"op": "set"})", "bad-request", "needs \"fields\""},
        {R"({"op": "set", "fields": []})", "wrong-type", "an object"},
        {R"({"op": "get", "fields": ""})", "unknown-field", "describe"},
        {R"({"op": "get", "fields": "heaters."})", "unknown-field", "describe"},
        {R"({"op": "subscribe", "topic": "sate"})", "bad-request", "expected one of state"},
        {R"({"op": "subscribe", "topic": "link", "every": 1})", "bad-request", "state only"},
        {R"({"op": "subscribe", "topic": "state", "every": "1us"})", "out-of-range", "10ms to 3600s"},
    };
    for (const Wrong& wrong : all) {
        CAPTURE(wrong.line);
        const Json answer = client.ask(wrong.line);
        REQUIRE(answer.is_object());
        CHECK(answer["ok"] == false);
        CHECK(answer["error"]["code"] == wrong.code);
        CAPTURE(answer.dump());
        CHECK(has(answer["error"]["message"], wrong.says));
    }
    CHECK(client.ask(R"({"op": "gett"})")["error"]["nearest"] == "get");
    CHECK(client.ask(R"({"op": "get", "feilds": 1})")["error"]["nearest"] == "fields");
    CHECK_FALSE(client.session.over());
    CHECK(client.code(R"({"op": "status"})").empty());
    CHECK(bench.answers());
}

TEST_CASE("ids come back as they were, whatever they are") {
    Bench bench;
    Client client(bench);
    for (const char* id : {"1", "null", "\"a\\u0000b\"", "[1,{\"x\":2}]", "-0.5", "true"}) {
        const std::string asked = std::string(R"({"id":)") + id + R"(,"op":"status"})";
        CHECK(client.ask(asked)["id"] == Json::parse(id));
        CHECK(client.ask(std::string(R"({"id":)") + id + R"(,"op":"no"})")["id"] == Json::parse(id));
    }
}

TEST_CASE("any split of the bytes gives the same answers; empty lines are nothing") {
    const std::string requests =
        "{\"id\": 1, \"op\": \"get\", \"fields\": \"heaters\"}\r\n\n  \n{\"id\": 2, \"op\": \"x\"}\n"
        "nonsense\n{\"id\": 3, \"op\": \"status\"}\n";
    std::string whole;
    for (std::size_t piece = requests.size(); piece > 0; --piece) {
        Bench bench;
        Client client(bench);
        for (std::size_t at = 0; at < requests.size(); at += piece) {
            client.session.receive(std::string_view(requests).substr(at, piece));
        }
        const std::string output = client.session.take_output();
        if (piece == requests.size()) {
            whole = output;
            CHECK(std::count(whole.begin(), whole.end(), '\n') == 4);
        }
        CHECK(output == whole);
        piece = piece > 20 ? piece / 2 : piece;  // few of the long ones, all of the short
    }
}

TEST_CASE("a line that is too long, with or without an end, is answered and ends the session") {
    for (const bool ended : {true, false}) {
        Bench bench;
        Client client(bench);
        const std::string piece(4096, 'x');
        std::size_t taken = 0;
        while (client.session.wants_input() && taken < 10'000'000) {
            client.session.receive(piece);
            taken += piece.size();
        }
        if (ended) {
            client.session.receive("\n{\"op\": \"quit\"}\n");
        }
        CHECK(taken <= Session::most_line + 4096);
        const auto lines = client.lines();
        REQUIRE(lines.size() == 1);
        CHECK(lines[0]["error"]["code"] == "too-long");
        CHECK(client.session.over());
        CHECK_FALSE(bench.ended);
        CHECK(bench.answers());
    }
    Bench bench;
    Client client(bench);
    client.session.receive(std::string(10'000'000, ' ') + "\n{\"op\": \"quit\"}\n");
    CHECK(client.lines()[0]["error"]["code"] == "too-long");
    CHECK_FALSE(bench.ended);
    Client other(bench);
    const std::string blanks(Session::most_line - 20, ' ');
    CHECK(other.code(blanks + R"({"op": "status"})").empty());
}

TEST_CASE("half a line is not carried out") {
    Bench bench;
    Client client(bench);
    client.session.receive(R"({"op": "status"})"
                           "\n"
                           R"({"op": "quit"})");
    client.session.finish();
    const auto lines = client.lines();
    REQUIRE(lines.size() == 2);
    CHECK(lines[0]["ok"] == true);
    CHECK(lines[1]["error"]["code"] == "half-line");
    CHECK(client.session.over());
    CHECK_FALSE(bench.ended);
    CHECK(bench.answers());
}

TEST_CASE("a client that has closed its side still gets the answer it waits for") {
    Bench bench;
    Client client(bench);
    client.session.receive("{\"op\": \"advance\", \"by\": \"5s\"}\n{\"op\": \"status\"}\n");
    client.session.finish();
    CHECK_FALSE(client.session.over());
    bench.jump();
    client.session.proceed();
    CHECK(client.lines().size() == 2);
    CHECK(client.session.over());
}

TEST_CASE("state: all at first, then what changed, at its times") {
    Bench bench;
    Client client(bench);
    CHECK(client
              .code(R"({"op": "subscribe", "topic": "state", "every": "1s", "fields": )"
                    R"(["heaters.nozzle.target", "heaters.bed.target"]})")
              .empty());
    bench.pass(SimTime{1});
    auto events = client.lines();
    REQUIRE(events.size() == 1);
    CHECK(events[0]["event"] == "state");
    CHECK(events[0]["fields"].size() == 2);
    bench.pass(10s);
    CHECK(client.lines().empty());
    bench.own.receive(bench.now, protocol::frame("M104 S200"));
    bench.pass(3s);
    events = client.lines();
    REQUIRE(events.size() == 1);
    CHECK(events[0]["fields"] == Json{{"heaters.nozzle.target", 200.0}});
    CHECK(events[0]["t"] == 12.0);
    CHECK(client.code(R"({"op": "unsubscribe", "topic": "state"})").empty());
    bench.own.receive(bench.now, protocol::frame("M104 S0"));
    bench.pass(3s);
    CHECK(client.lines().empty());
}

TEST_CASE("traffic, notices and link are told to those who asked, with their time") {
    Bench bench;
    Client client(bench);
    Client other(bench);
    for (const char* topic : {"traffic", "notices", "link"}) {
        CHECK(client.code(Json{{"op", "subscribe"}, {"topic", topic}}.dump()).empty());
    }
    bench.pass(100ms);
    client.lines();
    bench.own.receive(bench.now, protocol::frame("M9999") + "N-0 M105*1\r\n" + protocol::frame("M105"));
    bench.hub.on_link(bench.now, "up", "somebody came");
    bench.take();
    const auto events = client.lines();
    std::string kinds;
    for (const Json& event : events) {
        kinds += event["event"].get<std::string>() + " ";
        CHECK(event["t"] == 1.1);
    }
    CHECK(kinds == "traffic notice traffic traffic traffic link ");
    CHECK(events[0]["from"] == "screen");
    CHECK(events[0]["line"] ==
          protocol::frame("M9999").substr(0, events[0]["line"].get<std::string>().size()));
    CHECK(has(events[1]["text"], "M9999 is not in the profile"));
    CHECK(events[2]["refused"] == "bad frame");
    CHECK(events[4]["from"] == "board");
    CHECK(events[5]["why"] == "somebody came");
    CHECK(other.lines().empty());
    CHECK(client.code(R"({"op": "unsubscribe"})").empty());
    bench.pass(10s);
    CHECK(client.lines().empty());
}

TEST_CASE("a client that never reads loses events, is told how many, and is dropped in the end") {
    Bench bench;
    Client deaf(bench);
    Client slow(bench);
    Client good(bench);
    for (Client* client : {&deaf, &slow, &good}) {
        client->code(R"({"op": "subscribe", "topic": "traffic"})");
    }
    std::size_t heard = 0;
    bool told = false;
    for (int i = 0; i < 400 && !deaf.session.dropped(); ++i) {
        bench.pass(60s);
        heard += good.lines().size();
        if (i % 100 == 99) {
            for (const Json& event : slow.lines()) {
                told = told || (event["event"] == "lost" && event["count"] > 0);
            }
        }
    }
    CHECK(deaf.session.dropped());
    CHECK(deaf.session.over());
    CHECK(deaf.session.take_output().size() < 2 * Session::most_waiting);
    CHECK(told);
    CHECK(heard > Session::most_lost);
    CHECK_FALSE(good.session.dropped());
    CHECK(good.code(R"({"op": "status"})").empty());
    CHECK(bench.answers());
}

TEST_CASE("requests wait while answers are not taken, and are all answered in the end") {
    Bench bench;
    Client client(bench);
    std::size_t asked = 0;
    while (client.session.wants_input() && asked < 10'000) {
        client.session.receive("{\"op\": \"get\"}\n");
        ++asked;
    }
    CHECK(asked < 10'000);
    client.session.receive("{\"op\": \"status\"}\n{\"op\": \"status\"}\n");
    std::size_t answered = 0;
    for (int i = 0; i < 5; ++i) {
        const auto lines = client.lines();
        answered += lines.size();
        client.session.proceed();
    }
    CHECK(answered == asked + 2);
    CHECK(client.session.wants_input());
}

TEST_CASE("a session wakes its owner once until its output is taken") {
    Bench bench;
    Client client(bench);
    client.session.receive("{\"op\": \"status\"}\n{\"op\": \"status\"}\n");
    CHECK(client.wakes == 1);
    client.lines();
    client.session.receive("{\"op\": \"status\"}\n");
    CHECK(client.wakes == 2);
}

TEST_CASE("a hundred sessions are told what passes, and may leave at any time") {
    Bench bench;
    std::vector<std::unique_ptr<Client>> all;
    for (int i = 0; i < 100; ++i) {
        all.push_back(std::make_unique<Client>(bench));
        CHECK(all.back()->code(R"({"op": "subscribe", "topic": "traffic"})").empty());
    }
    CHECK(all[0]->ask(R"({"op": "status"})")["clients"] == 100);
    bench.pass(5s);
    all.erase(all.begin(), all.begin() + 50);
    bench.pass(5s);
    for (const auto& client : all) {
        CHECK(client->lines().size() > 5);
    }
    CHECK(bench.answers());
}

}  // namespace
}  // namespace fauxboard::control::test
