// The panel on a real socket of this computer, asked by a client that is no browser.

#include "emulator/panel/panel.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "emulator/host/live_board.h"
#include "emulator/link/link.h"
#include "emulator/panel/assets.h"
#include "protocol/framing.h"
#include "tests/host/live_helpers.h"
#include "tests/link/helpers.h"

namespace fauxboard::panel::test {
namespace {

using host::test::FakeLink;
using host::test::HandClock;
using link::UniqueFd;
using link::test::run_until;
using nlohmann::json;
using namespace std::chrono_literals;

/// One board and its panel.
struct Bench {
    Bench()
        : board(host::load_profile_by_name("geeetech-a30t"), {}, {false, 1, &observers}),
          live(board, line, clock, &observers),
          target({loop, board, live, clock, line, nullptr, [this] { quit = true; }, 1, nullptr, nullptr, {}}),
          panel(loop, "127.0.0.1:0",
                {{"left", target, [this](const std::string& text) { told.push_back(text); }}}) {
        observers.add(target);
        line.open(live);
        live.start(machine::never, [] {});
        clock.pass(1s);
        address = panel.address();
        const std::size_t colon = address.rfind(':');
        const std::size_t slash = address.find('/', colon);
        port = static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1, slash - colon - 1)));
        path = address.substr(slash);
    }
    bool answers() {
        line.messages.clear();
        live.on_bytes(protocol::frame("M105"));
        return line.wrote("L2 B:");
    }

    link::EventLoop loop;
    host::Observers observers;
    FakeLink line;
    HandClock clock;
    board::Board board;
    host::LiveBoard live;
    bool quit = false;
    host::LiveTarget target;
    std::vector<std::string> told;  ///< of pages that come and go
    Panel panel;
    std::string address;
    std::string path;  ///< "/TOKEN/"
    std::uint16_t port = 0;
};

struct Client {
    explicit Client(Bench& b) : bench(b), fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(b.port);
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        REQUIRE(::connect(fd.get(), reinterpret_cast<sockaddr*>(&to), sizeof to) == 0);
        REQUIRE(::fcntl(fd.get(), F_SETFL, O_NONBLOCK) == 0);
    }
    /// As much as goes; false when the other side is gone.
    bool say(std::string_view text) {
        while (!text.empty()) {
            const ssize_t sent = ::send(fd.get(), text.data(), text.size(), MSG_NOSIGNAL);
            if (sent > 0) {
                text.remove_prefix(static_cast<std::size_t>(sent));
            } else if (errno != EAGAIN) {
                return false;
            } else if (!bench.loop.run_one_for(50ms)) {
                return false;
            }
        }
        return true;
    }
    bool take() {
        std::array<char, 65536> buffer{};
        ssize_t got = 0;
        while ((got = ::read(fd.get(), buffer.data(), buffer.size())) > 0) {
            came.append(buffer.data(), static_cast<std::size_t>(got));
        }
        ended = got == 0 || (got < 0 && errno != EAGAIN);
        return ended;
    }
    bool until(std::string_view part) {
        run_until(bench.loop, [&] { return take() || came.find(part) != std::string::npos; });
        return came.find(part) != std::string::npos;
    }
    /// The status line's number of the answer to a whole request; 0 when none comes.
    int ask(std::string_view request) {
        came.clear();
        say(request);
        until("\r\n\r\n");
        return came.starts_with("HTTP/1.1 ") ? std::stoi(came.substr(9, 3)) : 0;
    }
    int get(const std::string& what, const std::string& more = {}) {
        return ask("GET " + what + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(bench.port) + "\r\n" +
                   more + "\r\n");
    }
    int post(const std::string& what, const std::string& body) {
        return ask("POST " + what + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(bench.port) +
                   "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }
    /// The next event of a stream, as JSON; null when none comes.
    json event() {
        constexpr std::string_view mark = "\ndata: ";  // at the start of a line: a header has the word, too
        if (!until(mark)) return nullptr;
        const std::size_t start = came.find(mark) + mark.size();
        run_until(bench.loop, [&] { return take() || came.find("\n\n", start) != std::string::npos; });
        const std::size_t end = came.find("\n\n", start);
        const json out = json::parse(came.substr(start, end - start), nullptr, false);
        came.erase(0, end + 1);  // the second line feed stays: it stands before the next mark
        return out;
    }

    Bench& bench;
    UniqueFd fd;
    std::string came;
    bool ended = false;
};

/// A stream to board 0, and a second connection for its requests.
struct Reader {
    explicit Reader(Bench& bench) : stream(bench), asker(bench) {
        REQUIRE(stream.get(bench.path + "live/0") == 200);
        session = stream.event().value("session", 0);
        REQUIRE(session != 0);
    }
    json ask(const json& request) {
        REQUIRE(asker.post(stream.bench.path + "live/0/" + std::to_string(session), request.dump() + "\n") ==
                204);
        return stream.event();
    }
    Client stream;
    Client asker;
    int session = 0;
};

TEST_CASE("the page, its parts and the library of the curves are in the program") {
    Bench b;
    Client client(b);
    CHECK(client.get(b.path) == 200);
    CHECK(client.until("</html>"));
    CHECK(client.came.find("text/html") != std::string::npos);
    CHECK(client.came.find("Content-Security-Policy: default-src 'none'; script-src 'self'") !=
          std::string::npos);
    CHECK(client.came.find("no real printer here") != std::string::npos);
    REQUIRE(find_asset("dygraph.min.js") != nullptr);
    CHECK(find_asset("dygraph.min.js")->bytes.find("MIT") != std::string_view::npos);
    for (const Asset& asset : assets()) {
        CAPTURE(std::string(asset.name));
        Client each(b);
        CHECK(each.get(b.path + std::string(asset.name)) == 200);
        run_until(b.loop, [&] { return each.take() || each.came.size() > asset.bytes.size(); });
        CHECK(each.came.ends_with(asset.bytes.substr(asset.bytes.size() / 2)));
    }
    CHECK(client.get(b.path + "boards") == 200);
    CHECK(client.until("\"left\""));
}

TEST_CASE("nothing else is served, and nobody without the address") {
    Bench b;
    for (const char* name :
         {"../../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "index.html/x", "live/7", "live/0x", "live/-1",
          "live", "app.js%00", "profiles/geeetech-a30t.json", "live/0/1/2"}) {
        CAPTURE(name);
        Client client(b);
        CHECK(client.get(b.path + name) == 404);
    }
    Client bare(b);
    CHECK(bare.get("/") == 404);
    Client other(b);
    CHECK(other.ask("GET " + b.path + " HTTP/1.1\r\nHost: evil.example\r\n\r\n") == 403);
    Client page(b);
    CHECK(page.get(b.path, "Origin: http://evil.example\r\n") == 403);
    Client old(b);
    CHECK(old.ask("GET " + b.path + " HTTP/1.0\r\n\r\n") == 403);
    CHECK(b.answers());
}

TEST_CASE("a session on a stream: requests go by POST, answers and events come") {
    Bench b;
    Reader reader(b);
    const json answer = reader.ask({{"id", 5}, {"op", "get"}, {"fields", "heaters.nozzle.target"}});
    CHECK(answer["id"] == 5);
    CHECK(answer["fields"]["heaters.nozzle.target"] == 0.0);
    CHECK(reader.ask({{"op", "set"}, {"fields", {{"heaters.nozzle.target", 9999}}}})["error"]["code"] ==
          "out-of-range");
    CHECK(reader.ask({{"op", "subscribe"}, {"topic", "traffic"}, {"words", true}})["ok"] == true);
    CHECK(b.answers());
    const json asked = reader.stream.event();
    CHECK(asked["from"] == "screen");
    CHECK(asked["words"].get<std::string>() != "");
    const json said = reader.stream.event();
    CHECK(said["line"].get<std::string>().find("L2 B:") != std::string::npos);
}

TEST_CASE("a session that is not there, or not of that board, takes nothing") {
    Bench b;
    Reader reader(b);
    Client client(b);
    CHECK(client.post(b.path + "live/0/999", "{}\n") == 410);
    CHECK(client.post(b.path + "live/1/" + std::to_string(reader.session), "{}\n") == 410);
    CHECK(client.post(b.path + "live/0/x", "{}\n") == 404);
    CHECK(client.post(b.path, "{}\n") == 404);
}

TEST_CASE("the shelf tells each board, and then what has changed") {
    Bench b;
    Client client(b);
    REQUIRE(client.get(b.path + "shelf") == 200);
    const json first = client.event();
    REQUIRE(first.size() == 1);
    CHECK(first[0]["n"] == 0);
    CHECK(first[0]["link"] == "waiting");
    CHECK(first[0]["faults"] == 0);
    CHECK(first[0]["words"].get<std::string>().find("°C") != std::string::npos);
}

TEST_CASE("curves, the talk and the rest of what people look at") {
    Bench b;
    b.clock.pass(3s);
    Reader reader(b);
    const json curves = reader.ask({{"op", "curves"}});
    REQUIRE(curves["series"].size() >= 4);
    CHECK(curves["t"].size() == curves["values"][0].size());
    CHECK(curves["t"].size() >= 3);
    const json talk = reader.ask({{"op", "talk"}});
    CHECK(talk["lines"].size() > 5);
    CHECK(talk["lines"][0].contains("words"));
    CHECK(reader.ask({{"op", "scenario"}})["scenario"].is_null());
    CHECK(reader.ask({{"op", "press"}, {"button", "Home"}})["error"]["code"] == "not-here");
    b.line.messages.clear();
    CHECK(reader.ask({{"op", "request"}, {"line", "M105"}})["ok"] == true);
    CHECK(b.line.wrote("L2 B:"));
    CHECK(reader.ask({{"op", "request"}, {"line", "M105\nM106"}})["error"]["code"] == "bad-arguments");
}

TEST_CASE("hostile: endless heads, bodies and garbage end that connection and no other") {
    Bench b;
    Reader reader(b);
    {
        Client client(b);
        client.say("GET " + b.path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Long: ");
        for (int i = 0; i < 160 && client.say(std::string(65536, 'a')) && !client.take(); ++i) {
        }
        CHECK(client.until("431"));
    }
    {
        Client client(b);
        client.say("POST " + b.path + "live/0/1 HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(b.port) +
                   "\r\nContent-Length: 99999999\r\n\r\n");
        for (int i = 0; i < 50 && client.say(std::string(65536, 'a')) && !client.take(); ++i) {
        }
        run_until(b.loop, [&] { return client.take(); });
        CHECK(client.ended);
    }
    for (const std::string& garbage :
         {std::string("\r\n\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"),
          std::string(4096, '\0'), std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11),
          std::string("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzzzz\r\n"),
          std::string("GET /\xff\xfe HTTP/1.1\r\nHost: \r\nHost: \r\n\r\n")}) {
        Client client(b);
        client.say(garbage);
        b.loop.run_one_for(20ms);
    }
    CHECK(reader.ask({{"op", "status"}})["ok"] == true);
    CHECK(b.answers());
}

TEST_CASE("a body that is too long is refused with its bound") {
    Bench b;
    Reader reader(b);
    Client client(b);
    CHECK(client.post(b.path + "live/0/" + std::to_string(reader.session), std::string(17'000, 'x')) == 413);
    CHECK(reader.ask({{"op", "status"}})["ok"] == true);
}

TEST_CASE("hostile: two hundred connections; those that are served stay served") {
    Bench b;
    Reader reader(b);
    std::vector<std::unique_ptr<Client>> many;
    for (int i = 0; i < 200; ++i) {
        many.push_back(std::make_unique<Client>(b));
        b.loop.poll();
    }
    CHECK(reader.ask({{"op", "status"}})["ok"] == true);
    CHECK(b.answers());
    many.clear();
    Client after(b);
    CHECK(after.get(b.path) == 200);
}

TEST_CASE("hostile: a page that asks and never reads is bounded, and dropped in the end") {
    Bench b;
    Reader reader(b);
    REQUIRE(reader.ask({{"op", "subscribe"}, {"topic", "traffic"}, {"words", true}})["ok"] == true);
    int refused = 0;
    for (int i = 0; i < 400 && refused == 0; ++i) {
        for (int line = 0; line < 100; ++line)
            b.live.on_bytes(protocol::frame("M290 Z0.01"));
        b.loop.run_one_for(5ms);
        const int status = reader.asker.post(b.path + "live/0/" + std::to_string(reader.session),
                                             std::string(12'000, ' ') + "{\"op\": \"get\"}\n");
        refused += status == 503 || status == 410 ? 1 : 0;
    }
    CHECK(refused == 1);
    CHECK(b.answers());
}

TEST_CASE("sessions are bounded, and free again when their pages are gone") {
    Bench b;
    std::vector<std::unique_ptr<Client>> many;
    for (std::size_t i = 0; i < Panel::most_sessions; ++i) {
        many.push_back(std::make_unique<Client>(b));
        REQUIRE(many.back()->get(b.path + "live/0") == 200);
    }
    Client more(b);
    CHECK(more.get(b.path + "live/0") == 404);
}

TEST_CASE("an address of the user's lasts; a bad one is refused with a sentence") {
    Bench b;
    Panel own(b.loop, "127.0.0.1:0/my-desk-screen", {{"left", b.target}});
    CHECK(own.address().ends_with("/my-desk-screen/"));
    CHECK_THROWS_WITH_AS(Panel(b.loop, "127.0.0.1:0/short", {}), doctest::Contains("12 to 64"),
                         link::LinkError);
    CHECK_THROWS_AS(Panel(b.loop, "nonsense", {}), link::LinkError);
}

TEST_CASE("panel: pages that come and go are told of") {
    Bench b;
    {
        Client page(b);
        REQUIRE(page.get(b.path + "live/0") == 200);
        REQUIRE(b.told.size() == 1);
        CHECK(b.told.back() == "a page came to the board; pages in browsers: 1");
    }
    run_until(b.loop, [&] { return b.told.size() == 2; });
    CHECK(b.told.back() == "a page left the board; pages in browsers: 0");
}

}  // namespace
}  // namespace fauxboard::panel::test
