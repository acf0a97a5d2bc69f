// The ops at the screen that shows a board.

#include "emulator/control/display.h"
#include "emulator/control/base64.h"
#include "tests/control/bench.h"

namespace fauxboard::control::test {
namespace {

/// A screen that takes note of what is done to it.
struct Noting final : Display {
    Json page(SimTime) override { return {{"page", "Main"}, {"title", "MAIN"}}; }
    std::string png(SimTime) override { return "\x89PNG"; }
    Touched touch(SimTime now, int x, int y, SimTime how_long) override {
        noted = fmt::format("{},{} for {}", x, y, how_long.count());
        return {x < 480 ? "" : "not on the screen", now + how_long};
    }
    Touched touch(SimTime now, std::string_view control, SimTime how_long) override {
        noted = fmt::format("{} for {}", control, how_long.count());
        return {control == "Files" ? "" : "no such control", now + how_long};
    }
    std::string noted;
};

TEST_CASE("page and screenshot answer at once") {
    Bench bench;
    Noting screen;
    bench.shown = &screen;
    Client client(bench);
    CHECK(client.ask(R"({"op": "page"})")["title"] == "MAIN");
    CHECK(client.ask(R"({"op": "screenshot"})")["png"] == to_base64("\x89PNG"));
}

TEST_CASE("touch answers when the finger is off again") {
    Bench bench;
    Noting screen;
    bench.shown = &screen;
    Client client(bench);
    CHECK(client.ask(R"({"op": "touch", "control": "Files"})").is_null());
    CHECK(screen.noted == "Files for 120000");
    bench.pass(100ms);
    CHECK(client.lines().empty());
    bench.pass(50ms);
    const auto answers = client.lines();
    REQUIRE(answers.size() == 1);
    CHECK(answers[0]["ok"] == true);
    CHECK(client.ask(R"({"op": "touch", "x": 330, "y": 17, "for": "2600ms"})").is_null());
    CHECK(screen.noted == "330,17 for 2600000");
}

TEST_CASE("while time is held, a touch lets pass what it takes, and nothing else does") {
    Bench bench;
    Noting screen;
    bench.shown = &screen;
    Client client(bench);
    CHECK_FALSE(bench.held);
    CHECK(client.ask(R"({"op": "hold", "on": true})")["ok"] == true);
    CHECK(bench.held);
    {
        Client other(bench);
        CHECK(other.ask(R"({"op": "hold", "on": true})")["ok"] == true);
    }
    CHECK(bench.held);  // one of two is gone
    const SimTime before = bench.now;
    CHECK(client.ask(R"({"op": "touch", "control": "Files"})").is_null());
    bench.jump();
    CHECK(bench.now == before + 120ms);
    CHECK(client.lines().at(0)["ok"] == true);
    CHECK(client.code(R"({"op": "hold", "on": 1})") == "bad-arguments");
    CHECK(client.code(R"({"op": "hold"})") == "bad-request");
    CHECK(client.ask(R"({"op": "hold", "on": false})")["ok"] == true);
    CHECK_FALSE(bench.held);
    {
        Client other(bench);
        CHECK(other.ask(R"({"op": "hold", "on": true})")["ok"] == true);
        CHECK(bench.held);
    }
    CHECK_FALSE(bench.held);  // who held it is gone
}

TEST_CASE("wrong touches are told") {
    Bench bench;
    Client client(bench);
    CHECK(client.code(R"({"op": "page"})") == "not-here");
    CHECK(client.code(R"({"op": "touch", "control": "Files"})") == "not-here");
    Noting screen;
    bench.shown = &screen;
    CHECK(client.code(R"({"op": "touch"})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "x": 1})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "y": 1})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "x": 1.5, "y": 2})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "x": 1000000000, "y": 2})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "control": "Files", "y": 2})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "x": 1e9, "y": 2})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "control": "Files", "x": 1, "y": 2})") == "bad-arguments");
    CHECK(client.code(R"({"op": "touch", "control": "Files", "for": "11min"})") == "out-of-range");
    CHECK(client.code(R"({"op": "touch", "control": "Nowhere"})") == "refused");
    CHECK(client.code(R"({"op": "touch", "x": 480, "y": 0})") == "refused");
}

TEST_CASE("wrong presses and requests are told") {
    Bench bench;
    Client client(bench);
    for (const char* row : {"0", "-1", "20000", "1.5"}) {
        CAPTURE(std::string(row));
        CHECK(client.code(R"({"op": "press", "button": "File", "row": )" + std::string(row) + "}") ==
              "out-of-range");
    }
    CHECK(client.code(R"({"op": "request", "line": "M117 \u0101"})") == "bad-arguments");
    CHECK(client.code(R"({"op": "request", "line": "M105\nM105"})") == "bad-arguments");
    CHECK(client.code(R"({"op": "request", "line": ")" + std::string(5000, 'x') + "\"}") == "bad-arguments");
    CHECK(client.code(R"({"op": "request", "line": "M105"})").empty());
}

TEST_CASE("base64 goes there and back, and refuses what is none") {
    std::string bytes;
    for (int length = 0; length < 20; ++length) {
        CHECK(from_base64(to_base64(bytes)) == bytes);
        bytes += static_cast<char>(length * 37);
    }
    CHECK(to_base64("fooba") == "Zm9vYmE=");
    CHECK_FALSE(from_base64("Zm9").has_value());
    CHECK_FALSE(from_base64("Zm!=").has_value());
}

}  // namespace
}  // namespace fauxboard::control::test
