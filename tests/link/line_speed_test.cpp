#include "emulator/link/line_speed.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <termios.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "tests/link/helpers.h"

namespace fauxboard::link::test {
namespace {

void set_speed(const UniqueFd& peer, speed_t speed) {
    termios settings{};
    REQUIRE(::tcgetattr(peer.get(), &settings) == 0);
    ::cfmakeraw(&settings);
    REQUIRE(::cfsetspeed(&settings, speed) == 0);
    REQUIRE(::tcsetattr(peer.get(), TCSANOW, &settings) == 0);
}

TEST_CASE("what is heard at a wrong speed, bit by bit") {
    CHECK(as_heard("N1 M105*38\n", 115200, 115200) == "N1 M105*38\n");
    // 'U' is a start bit, 1 0 1 0 1 0 1 0, and the stop bit: twice as fast each bit is seen twice.
    CHECK(as_heard("U", 9600, 19200) == "\x66\xE6");
    // Each low bit is twelve of the receiver's: a start bit and eight of data.
    CHECK(as_heard("U", 9600, 115200) == std::string(5, '\0'));
    CHECK(as_heard(std::string(1, '\0'), 9600, 115200) == std::string(1, '\0'));
    // A start bit of half a bit's length is none.
    CHECK(as_heard("\xFF", 9600, 4800).empty());
    // What ten characters take at 115200 is less than one at 9600.
    const std::string all = as_heard(std::string(1000, 'a'), 115200, 9600);
    CHECK(all.size() > 50);
    CHECK(all.size() <= 84);
}

TEST_CASE("a wrong speed gives the same garbage each time, and never more than it may") {
    std::string all;
    for (int i = 0; i < 256; ++i) {
        all += static_cast<char>(i);
    }
    for (const auto& [sent, heard] : {std::tuple{115200U, 250000U},
                                      {115200U, 9600U},
                                      {115200U, 57600U},
                                      {50U, 4'000'000U},
                                      {4'000'000U, 50U}}) {
        const std::string garbage = as_heard(all, sent, heard);
        CHECK(garbage == as_heard(all, sent, heard));
        CHECK(garbage != all);
        CHECK(garbage.size() <= all.size() * most_heard_per_byte);
        for (const char byte : all) {
            CHECK(as_heard({&byte, 1}, sent, heard).size() <= most_heard_per_byte);
        }
    }
    // A clock that is a little off is no harm.
    CHECK(as_heard(all, 115200, 117000) == all);
}

TEST_CASE("pty: with exact speeds a peer at a wrong one hears garbage and is heard so, until it is right") {
    EventLoop loop;
    Recorder heard;
    const auto link = make_pty_link(loop, "", PtyUse{115200, true, true});
    link->open(heard);
    const UniqueFd peer = open_terminal(link->path());
    REQUIRE(run_until(loop, [&] { return link->state() == LinkState::up; }));
    const std::string line = "N1 M105*38\n";
    const std::string answer = "ok T:22.00 /0.00 B:22.00 /0.00 @:0 B@:0\n";

    // Nobody has chosen the speed of a new one.
    say(peer.get(), line);
    REQUIRE(run_until(loop, [&] { return heard.bytes == line; }));

    set_speed(peer, B9600);
    heard.bytes.clear();
    say(peer.get(), line);
    const std::string to_board = as_heard(line, 9600, 115200);
    REQUIRE(run_until(loop, [&] { return heard.bytes.size() >= to_board.size(); }));
    CHECK(heard.bytes == to_board);
    link->write(answer);
    std::string said;
    const std::string to_peer = as_heard(answer, 115200, 9600);
    REQUIRE(run_until(loop, [&] { return (said += take(peer.get())).size() >= to_peer.size(); }));
    CHECK(said == to_peer);
    CHECK(link->stats().bytes_out == answer.size());

    set_speed(peer, B115200);
    heard.bytes.clear();
    say(peer.get(), line);
    REQUIRE(run_until(loop, [&] { return heard.bytes == line; }));
    link->write(answer);
    said.clear();
    REQUIRE(run_until(loop, [&] { return (said += take(peer.get())) == answer; }));
}

TEST_CASE("pty: garbage of which nothing is heard is not the peer's end, and a flood of it is read whole") {
    EventLoop loop;
    Recorder heard;
    const auto link = make_pty_link(loop, "", PtyUse{115200, true, true});
    link->open(heard);
    const UniqueFd peer = open_terminal(link->path());
    set_speed(peer, B230400);
    say(peer.get(), std::string(100, '\xFF'));
    say(peer.get(), std::string(4000, '\xFF'));
    run_ready(loop);
    CHECK(heard.bytes.empty());
    CHECK(link->state() == LinkState::up);
    set_speed(peer, B115200);
    say(peer.get(), "still there");
    CHECK(run_until(loop, [&] { return heard.bytes.ends_with("still there"); }));
}

}  // namespace
}  // namespace fauxboard::link::test
