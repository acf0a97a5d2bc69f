// The control channel's socket: clients that come, hang, flood and go, on a real event loop with time by
// hand.

#include "emulator/host/control_server.h"
#include "emulator/host/live_target.h"

#include <sys/socket.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "emulator/control/session.h"
#include "emulator/link/local_path.h"
#include "protocol/framing.h"
#include "tests/host/live_helpers.h"
#include "tests/link/helpers.h"

namespace fauxboard::host::test {
namespace {

using link::UniqueFd;
using link::test::run_until;
using link::test::TemporaryFolder;
using nlohmann::json;

struct Bench {
    explicit Bench(SimTime duration = machine::never)
        : board(load_profile_by_name("geeetech-a30t"), {}, {false, 1, &observers}),
          live(board, link, clock, &observers),
          target({loop, board, live, clock, link, nullptr, [this] { quit = true; }, 1, nullptr, nullptr,
                  [this](SimTime, std::string_view text) { did += text; }}),
          server(loop, target.hub(), [this](board::Level level, std::string_view text) {
              (level == board::Level::debug ? came_and_left : said) += text;
          }) {
        observers.add(target);
        server.open(path);
        link.open(live);
        live.start(duration, [this] { ended = true; });
        clock.pass(1s);
    }
    /// The board still does what it is for.
    bool answers() {
        link.messages.clear();
        live.on_bytes(protocol::frame("M105"));
        return link.wrote("L2 B:");
    }

    TemporaryFolder folder;
    std::string path = folder.file("control");
    link::EventLoop loop;
    Observers observers;
    FakeLink link;
    HandClock clock;
    board::Board board;
    LiveBoard live;
    bool quit = false;
    bool ended = false;
    std::string said;
    std::string came_and_left;
    std::string did;
    LiveTarget target;
    ControlServer server;
};

struct Client {
    explicit Client(Bench& b) : bench(b), fd(link::connect_local(b.path)) {
        REQUIRE(::fcntl(fd.get(), F_SETFL, O_NONBLOCK) == 0);
    }
    void say(std::string_view text) const { link::test::say(fd.get(), text); }
    /// The next line; "(end)" when the server has closed; "" when nothing comes.
    std::string line() {
        run_until(bench.loop, [&] { return take() || rest.find('\n') != std::string::npos; });
        const std::size_t end = rest.find('\n');
        if (end == std::string::npos) {
            return ended ? "(end)" : "";
        }
        std::string out = rest.substr(0, end);
        rest.erase(0, end + 1);
        return out;
    }
    /// True at the end of the stream.
    bool take() {
        std::array<char, 65536> buffer{};
        ssize_t got = 0;
        while ((got = ::read(fd.get(), buffer.data(), buffer.size())) > 0) {
            rest.append(buffer.data(), static_cast<std::size_t>(got));
        }
        ended = got == 0 || errno == ECONNRESET;
        return ended;
    }
    json ask(const std::string& request) {
        say(request + "\n");
        return json::parse(line(), nullptr, false);
    }
    Bench& bench;
    UniqueFd fd;
    std::string rest;
    bool ended = false;
};

TEST_CASE("a request on the socket reaches the board, and the board's line") {
    Bench b;
    Client client(b);
    const json set = client.ask(R"({"id": 1, "op": "set", "fields": {"heaters.nozzle.target": 203}})");
    CHECK(set["ok"] == true);
    CHECK(b.answers());
    CHECK(b.link.wrote("/203.0 /1"));
    b.link.messages.clear();
    CHECK(client.ask(R"({"op": "send", "line": "L18 P1 S2"})")["ok"] == true);
    CHECK(b.link.all() == protocol::frame("L18 P1 S2"));
    CHECK(b.did == "a client: send line=L18 P1 S2");  // `set` is told by the board itself
    CHECK(b.came_and_left == "a client came to the control channel; clients: 1");
    const json status = client.ask(R"({"op": "status"})");
    CHECK(status["link"]["kind"] == "fake");
    CHECK(status["clients"] == 1);
}

TEST_CASE("several requests in one write, and one in many") {
    Bench b;
    Client client(b);
    client.say(
        "{\"id\": 1, \"op\": \"status\"}\n{\"id\": 2, \"op\": \"nonsense\"}\n{\"id\": 3, \"op\": "
        "\"status\"}\n");
    for (int id = 1; id <= 3; ++id) {
        CHECK(json::parse(client.line())["id"] == id);
    }
    for (const char c : std::string("{\"id\": 4, \"op\": \"status\"}\n")) {
        client.say({&c, 1});
        link::test::run_ready(b.loop);
    }
    CHECK(json::parse(client.line())["id"] == 4);
}

TEST_CASE("a client that floods is slowed down; the others and the line have their turn") {
    Bench b;
    Client flood(b);
    Client other(b);
    std::string requests;
    for (int i = 0; i < 150; ++i) {
        requests += "{\"op\": \"status\"}\n";
    }
    flood.say(requests);
    link::test::run_ready(b.loop);
    other.say("{\"id\": 7, \"op\": \"status\"}\n");
    // So many turns of the loop, and so many times the line's own, are between what the flood asks.
    for (int turn = 0; turn < 8; ++turn) {
        link::test::run_ready(b.loop);
    }
    other.take();
    CHECK(other.rest.find("\"id\":7") != std::string::npos);
    flood.take();
    CHECK(std::count(flood.rest.begin(), flood.rest.end(), '\n') < 12);
    CHECK(b.answers());
    for (int i = 0; i < 150; ++i) {
        CHECK(json::parse(flood.line())["ok"] == true);
    }
}

TEST_CASE("time jumps: everything due on the way is done at its moment, however far it is") {
    Bench b;
    Witness witness;
    b.observers.add(witness);
    Client client(b);
    client.ask(R"({"op": "set", "fields": {"heaters.nozzle.target": 200}})");
    const json done = client.ask(R"({"op": "advance", "by": "10min"})");
    CHECK(done["ok"] == true);
    CHECK(done["t"] == 601.0);
    CHECK(b.clock.now() == 601s);
    CHECK(b.live.now() == 601s);
    CHECK(witness.sent.size() > 500);
    const json hot = client.ask(R"({"op": "get", "fields": "heaters.nozzle.true"})");
    CHECK(hot["fields"]["heaters.nozzle.true"] > 190);
    CHECK(b.answers());
}

TEST_CASE("two who jump at once both get there") {
    Bench b;
    Client one(b);
    Client two(b);
    one.say("{\"op\": \"advance\", \"by\": \"2min\"}\n");
    two.say("{\"op\": \"advance\", \"by\": \"3min\"}\n");
    const json first = json::parse(one.line());
    const json second = json::parse(two.line());
    CHECK(std::max(first["t"].get<double>(), second["t"].get<double>()) == 301.0);
    CHECK(b.clock.now() == 301s);
}

TEST_CASE("a jump beyond the end of the run is told so") {
    Bench b(10s);
    Client client(b);
    client.say("{\"id\": 1, \"op\": \"advance\", \"by\": \"1h\"}\n");
    CHECK(run_until(b.loop, [&] { return b.ended; }));
    b.server.close();
    const json end = json::parse(client.line());
    CHECK(end["id"] == 1);
    CHECK(end["error"]["code"] == "ended");
    CHECK(client.line() == "(end)");
}

TEST_CASE("subscriptions: state at its times, traffic and link as they come") {
    Bench b;
    Client client(b);
    client.ask(R"({"op": "subscribe", "topic": "state", "fields": "heaters.nozzle.target", "every": "1s"})");
    b.clock.pass(0s);
    CHECK(json::parse(client.line())["fields"]["heaters.nozzle.target"] == 0.0);
    b.live.on_bytes(protocol::frame("M104 S210"));
    b.clock.pass(2s);
    const json event = json::parse(client.line());
    CHECK(event["fields"]["heaters.nozzle.target"] == 210.0);
    CHECK(event["t"] == 2.0);
    client.ask(R"({"op": "unsubscribe"})");
    client.ask(R"({"op": "subscribe", "topic": "link"})");
    b.link.go(link::LinkState::up, "somebody came");
    CHECK(json::parse(client.line())["state"] == "up");
}

TEST_CASE("a hundred clients at once; beyond the most there can be, each is turned away with a sentence") {
    Bench b;
    std::vector<std::unique_ptr<Client>> all;
    for (std::size_t i = 0; i < ControlServer::most_clients; ++i) {
        all.push_back(std::make_unique<Client>(b));
        CHECK(all.back()->ask(R"({"op": "subscribe", "topic": "traffic"})")["ok"] == true);
    }
    CHECK(all.size() >= 100);
    Client late(b);
    CHECK(json::parse(late.line())["error"]["code"] == "too-many-clients");
    CHECK(late.line() == "(end)");
    CHECK(b.answers());
    for (const auto& client : all) {
        CHECK(json::parse(client->line())["line"] == "N-0 M105*10");
    }
    all.resize(50);
    CHECK(run_until(b.loop, [&] { return Client(b).ask(R"({"op": "status"})").value("ok", false); }));
    CHECK(b.answers());
}

TEST_CASE("a client that never reads is dropped; the board and the others do not wait for it") {
    Bench b;
    Client deaf(b);
    Client good(b);
    deaf.say("{\"op\": \"subscribe\", \"topic\": \"traffic\"}\n");
    CHECK(good.ask(R"({"op": "status"})")["clients"] == 2);
    for (int i = 0; i < 400 && b.said.empty(); ++i) {
        b.clock.pass(60s);
        link::test::run_ready(b.loop);
    }
    CHECK(b.said.find("does not read") != std::string::npos);
    CHECK(good.ask(R"({"op": "status"})")["clients"] == 1);
    CHECK(b.answers());
}

TEST_CASE("ten megabytes without a line end: an error, and the client is dropped") {
    Bench b;
    Client client(b);
    const std::string piece(65536, 'x');
    std::size_t sent = 0;
    run_until(b.loop, [&] {
        const ssize_t more = ::send(client.fd.get(), piece.data(), piece.size(), MSG_NOSIGNAL);
        sent += more > 0 ? static_cast<std::size_t>(more) : 0;
        return sent >= 10'000'000 || (more < 0 && errno == EPIPE);
    });
    CHECK(sent < 10'000'000);
    CHECK(json::parse(client.line())["error"]["code"] == "too-long");
    CHECK(client.line() == "(end)");
    Client next(b);
    CHECK(next.ask(R"({"op": "status"})")["clients"] == 1);
    CHECK(b.answers());
}

TEST_CASE("half a line and gone: an error, and nothing is done; a quiet half line harms nobody") {
    Bench b;
    Client half(b);
    half.say("{\"op\": \"quit\"");
    Client leaving(b);
    leaving.say("{\"op\": \"quit\"}");
    ::shutdown(leaving.fd.get(), SHUT_WR);
    CHECK(json::parse(leaving.line())["error"]["code"] == "half-line");
    CHECK(leaving.line() == "(end)");
    CHECK_FALSE(b.quit);
    half.say("}\n");
    CHECK(json::parse(half.line())["ok"] == true);
    CHECK(run_until(b.loop, [&] { return b.quit; }));
}

TEST_CASE("clients that vanish in the middle of anything") {
    Bench b;
    for (int i = 0; i < 50; ++i) {
        Client client(b);
        client.say(
            "{\"op\": \"subscribe\", \"topic\": \"traffic\"}\n{\"op\": \"get\"}\n{\"op\": \"advance\", "
            "\"by\": 1}\n");
        if (i % 2 == 0) {
            link::test::run_ready(b.loop);
        }
    }
    b.clock.pass(5s);
    Client last(b);
    CHECK(run_until(b.loop, [&] { return last.ask(R"({"op": "status"})")["clients"] == 1; }));
    CHECK(b.answers());
}

TEST_CASE("closed, the socket is gone, and clients have what was said to them") {
    Bench b;
    Client client(b);
    client.ask(R"({"op": "subscribe", "topic": "traffic"})");
    CHECK(b.answers());
    b.server.close();
    CHECK_FALSE(std::filesystem::exists(b.path));
    CHECK(json::parse(client.line())["line"] == "N-0 M105*10");
    CHECK(client.line().find("L2 B:") != std::string::npos);
    CHECK(client.line() == "(end)");
    CHECK(b.answers());
}

}  // namespace
}  // namespace fauxboard::host::test
