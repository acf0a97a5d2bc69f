#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "emulator/link/host_port.h"
#include "helpers.h"

using namespace fauxboard::link;
using namespace fauxboard::link::test;

namespace {

std::uint16_t port_of(const Link& link) {
    return parse_host_port(link.path()).port;
}

/// A client made of plain system calls; -1 if nobody listens.
UniqueFd dial(std::uint16_t port) {
    UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    REQUIRE(fd);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return {};
    REQUIRE(::fcntl(fd.get(), F_SETFL, O_NONBLOCK) == 0);
    return fd;
}

void reset_connection(UniqueFd& fd) {
    const linger at_once{1, 0};
    REQUIRE(::setsockopt(fd.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once) == 0);
    fd.reset();
}

bool at_end(const UniqueFd& fd) {
    char byte = 0;
    return ::recv(fd.get(), &byte, 1, MSG_DONTWAIT | MSG_PEEK) == 0;
}

struct Listening {
    EventLoop loop;
    Recorder heard;
    std::unique_ptr<Link> link = make_tcp_listen_link(loop, "0");

    Listening() { link->open(heard); }
    UniqueFd client_up() {
        UniqueFd fd = dial(port_of(*link));
        REQUIRE(until_states(heard.state_letters() + "u"));
        return fd;
    }
    bool until_states(const std::string& letters) {
        return run_until(loop, [&] { return heard.state_letters() == letters; });
    }
    bool until_heard(const std::string& text) {
        return run_until(loop, [&] { return heard.bytes == text; });
    }
    bool until_said(const UniqueFd& fd, const std::string& text) {
        std::string said;
        return run_until(loop, [&] { return (said += take(fd.get())) == text; });
    }
};

}  // namespace

/// This process's end of the connection of that client.
int other_end(const UniqueFd& client) {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    REQUIRE(::getsockname(client.get(), reinterpret_cast<sockaddr*>(&own), &size) == 0);
    for (int fd = 3; fd < 1024; ++fd) {
        sockaddr_in peer{};
        size = sizeof peer;
        if (::getpeername(fd, reinterpret_cast<sockaddr*>(&peer), &size) == 0 &&
            peer.sin_port == own.sin_port) {
            return fd;
        }
    }
    return -1;
}

int option(int fd, int level, int name) {
    int value = -1;
    socklen_t size = sizeof value;
    REQUIRE(::getsockopt(fd, level, name, &value, &size) == 0);
    return value;
}

TEST_CASE("tcp: a peer that vanishes without a word is noticed in time") {
    Listening listening;
    REQUIRE(listening.until_states("w"));
    const UniqueFd client = listening.client_up();
    const int fd = other_end(client);
    CHECK(option(fd, SOL_SOCKET, SO_KEEPALIVE) == 1);
    CHECK(option(fd, IPPROTO_TCP, TCP_KEEPIDLE) +
              option(fd, IPPROTO_TCP, TCP_KEEPINTVL) * option(fd, IPPROTO_TCP, TCP_KEEPCNT) ==
          35);
    CHECK(option(fd, IPPROTO_TCP, TCP_USER_TIMEOUT) == 35'000);
}

TEST_CASE("tcp: addresses") {
    CHECK(parse_host_port("4000").host == "127.0.0.1");
    CHECK(parse_host_port("4000").port == 4000);
    CHECK(parse_host_port(":4000").host == "127.0.0.1");
    CHECK(parse_host_port("printer:1").host == "printer");
    CHECK(parse_host_port("[::1]:65535").host == "::1");
    CHECK(parse_host_port("[::1]:65535").port == 65535);
    for (const char* bad :
         {"", ":", "host:", "host:x", "host:65536", "host:-1", "host:1x", "::1:4000", "[::1]", "[::1]4000"}) {
        CAPTURE(bad);
        CHECK(contains(link_error([&] { parse_host_port(bad); }), "is not an address"));
    }
    CHECK(format_host_port("::1", 5) == "[::1]:5");
    CHECK(format_host_port("127.0.0.1", 5) == "127.0.0.1:5");
}

TEST_CASE("tcp: port 0 takes a free port of the loopback and path() names it") {
    Listening board;
    CHECK(board.link->kind() == "tcp");
    CHECK(board.link->path().starts_with("127.0.0.1:"));
    CHECK(port_of(*board.link) != 0);
    CHECK(board.link->state() == LinkState::waiting);
}

TEST_CASE("tcp: both ways, with what was said before the first client") {
    Listening board;
    REQUIRE(board.until_states("w"));
    board.link->write("boot\n");
    board.link->write(std::string(4096, 'x'));
    CHECK(board.link->stats().writes_lost == 1);
    const UniqueFd client = board.client_up();
    CHECK(board.until_said(client, "boot\n"));
    say(client.get(), "M105\n");
    CHECK(board.until_heard("M105\n"));
    for (const char* text : {"a", "b", "c"})
        board.link->write(text);
    CHECK(board.until_said(client, "abc"));
}

TEST_CASE("tcp: a second client is turned away and the first keeps its line") {
    Listening board;
    REQUIRE(board.until_states("w"));
    const UniqueFd first = board.client_up();
    const UniqueFd second = dial(port_of(*board.link));
    CHECK(run_until(board.loop, [&] { return at_end(second); }));
    CHECK(board.until_states("wuu"));
    CHECK(contains(board.heard.last_why(), "turned away"));
    board.link->write("for the first");
    CHECK(board.until_said(first, "for the first"));
}

TEST_CASE("tcp: a client that ends, half-closes or resets is gone, and the next is served afresh") {
    Listening board;
    REQUIRE(board.until_states("w"));
    UniqueFd client = board.client_up();
    say(client.get(), "last words");
    SUBCASE("ends") {
        client.reset();
    }
    SUBCASE("half-closes") {
        REQUIRE(::shutdown(client.get(), SHUT_WR) == 0);
    }
    SUBCASE("resets") {
        REQUIRE(board.until_heard("last words"));
        reset_connection(client);
    }
    REQUIRE(board.until_states("wuw"));
    CHECK(board.heard.bytes == "last words");
    board.link->write("to nobody");
    CHECK(board.link->stats().bytes_lost == 9);
    const UniqueFd next = board.client_up();
    board.link->write("new");
    CHECK(board.until_said(next, "new"));
}

TEST_CASE("tcp: one that reconnects before its end was noticed is not turned away") {
    Listening board;
    REQUIRE(board.until_states("w"));
    UniqueFd client = board.client_up();
    const std::string much(3 * Link::read_limit, 'x');
    say(client.get(), much);
    client.reset();
    client = dial(port_of(*board.link));
    CHECK(board.until_states("wuwu"));
    CHECK(board.heard.bytes == much);
    board.link->write("hello again");
    CHECK(board.until_said(client, "hello again"));
}

TEST_CASE("tcp: writing to a client that has reset neither kills nor calls back") {
    Listening board;
    REQUIRE(board.until_states("w"));
    UniqueFd client = board.client_up();
    reset_connection(client);
    for (int i = 0; i < 10; ++i)
        board.link->write("x");
    CHECK(board.heard.state_letters() == "wu");
    CHECK(board.until_states("wuw"));
    CHECK(board.link->stats().bytes_lost + board.link->stats().bytes_out == 10);
}

TEST_CASE("tcp: a flood comes in pieces and leaves other handlers their turn") {
    Listening board;
    REQUIRE(board.until_states("w"));
    const UniqueFd client = board.client_up();
    const std::string flood(64 * 1024, 'f');
    say(client.get(), flood);
    int turns = 0;
    int pieces = 0;
    board.heard.then = [&](std::string_view) {
        ++pieces;
        board.loop.post([&] { ++turns; });
        CHECK(turns >= pieces - 1);
    };
    CHECK(board.until_heard(flood));
    CHECK(board.heard.most_at_once == Link::read_limit);
    CHECK(pieces >= 16);
}

TEST_CASE("tcp: what follows urgent data is heard") {
    Listening board;
    REQUIRE(board.until_states("w"));
    const UniqueFd client = board.client_up();
    say(client.get(), "ab");
    REQUIRE(::send(client.get(), "!", 1, MSG_OOB) == 1);
    say(client.get(), "M105\n");
    CHECK(board.until_heard("abM105\n"));
}

TEST_CASE("tcp: a client that never reads costs whole messages and is still heard") {
    Listening board;
    REQUIRE(board.until_states("w"));
    const UniqueFd client = board.client_up();
    const std::string message(1000, 'm');
    const LinkStats& stats = board.link->stats();
    std::uint64_t written = 0;
    while (stats.writes_lost < 100) {
        board.link->write(message);
        written += message.size();
    }
    CHECK(stats.bytes_lost == stats.writes_lost * 1000);
    CHECK(written - stats.bytes_lost - stats.bytes_out <= Link::pending_limit);
    say(client.get(), "still here");
    CHECK(board.until_heard("still here"));
    std::size_t said = 0;
    CHECK(run_until(board.loop,
                    [&] { return (said += take(client.get()).size()) + stats.bytes_lost == written; }));
}

TEST_CASE("tcp: a port in use, an unknown host and a bad address are sentences") {
    Listening board;
    Recorder heard;
    const auto second = make_tcp_listen_link(board.loop, board.link->path());
    CHECK(contains(link_error([&] { second->open(heard); }), "Address already in use"));
    CHECK(second->state() == LinkState::opening);
    const auto nowhere = make_tcp_listen_link(board.loop, "192.0.2.1:0");
    CHECK(contains(link_error([&] { nowhere->open(heard); }), "Cannot listen on 192.0.2.1:0"));
    const auto bad = make_tcp_connect_link(board.loop, "1.2.3.4.5");
    CHECK(contains(link_error([&] { bad->open(heard); }), "is not an address"));
    const auto zero = make_tcp_connect_link(board.loop, "127.0.0.1:0");
    CHECK(contains(link_error([&] { zero->open(heard); }), "Cannot connect to 127.0.0.1:0"));
}

TEST_CASE("tcp: IPv6") {
    EventLoop loop;
    Recorder heard;
    Recorder heard_by_screen;
    const auto board = make_tcp_listen_link(loop, "[::1]:0");
    try {
        board->open(heard);
    } catch (const LinkError& error) {
        MESSAGE("skipped, no IPv6 here: ", error.what());
        return;
    }
    CHECK(board->path().starts_with("[::1]:"));
    const auto screen = make_tcp_connect_link(loop, board->path());
    screen->open(heard_by_screen);
    CHECK(screen->path() == board->path());
    screen->write("hello");
    CHECK(run_until(loop, [&] { return heard.bytes == "hello"; }));
}

TEST_CASE("tcp: the screen's side connects, loses its board, and finds it again") {
    EventLoop loop;
    Recorder board_heard;
    Recorder screen_heard;
    auto board = make_tcp_listen_link(loop, ":0");
    board->open(board_heard);
    const std::string address = board->path();
    const auto screen = make_tcp_connect_link(loop, address);
    screen->open(screen_heard);
    CHECK(screen->state() == LinkState::up);
    screen->write("M115\n");
    REQUIRE(run_until(loop, [&] { return board_heard.bytes == "M115\n"; }));
    board->write("ok\n");
    REQUIRE(run_until(loop, [&] { return screen_heard.bytes == "ok\n"; }));

    board.reset();
    REQUIRE(run_until(loop, [&] { return screen_heard.state_letters() == "uw"; }));
    screen->write("lost");
    CHECK(screen->stats().bytes_lost == 4);
    // At least one try that fails before the board is back: the timer's turn and the refusal's.
    loop.run_one();
    loop.run_one();
    board = make_tcp_listen_link(loop, address);
    board->open(board_heard);
    REQUIRE(run_until(loop, [&] { return screen_heard.state_letters() == "uwu"; }));
    screen->write("again");
    CHECK(run_until(loop, [&] { return board_heard.bytes == "M115\nagain"; }));
}

TEST_CASE("tcp: nobody there at the start is an error that says so") {
    EventLoop loop;
    Recorder heard;
    std::string address;
    {
        const auto board = make_tcp_listen_link(loop, "0");
        board->open(heard);
        address = board->path();
    }
    const auto screen = make_tcp_connect_link(loop, address);
    CHECK(contains(link_error([&] { screen->open(heard); }),
                   "Cannot connect to " + address + ": Connection refused"));
    CHECK(screen->state() == LinkState::opening);
    run_ready(loop);
    CHECK(heard.states.empty());
}

TEST_CASE("tcp: closing stops the retrying") {
    EventLoop loop;
    Recorder heard;
    Recorder board_heard;
    auto board = make_tcp_listen_link(loop, "0");
    board->open(board_heard);
    const auto screen = make_tcp_connect_link(loop, board->path());
    screen->open(heard);
    board.reset();
    REQUIRE(run_until(loop, [&] { return heard.state_letters() == "uw"; }));
    screen->close();
    // Ends because no timer is left.
    loop.run();
    CHECK(heard.state_letters() == "uw");
}
