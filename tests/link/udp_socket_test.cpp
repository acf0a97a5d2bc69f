// Datagrams over the loopback interface.

#include "emulator/link/udp_socket.h"

#include "tests/link/helpers.h"
#include "tests/link/udp_helpers.h"

namespace fauxboard::link {
namespace {

using test::contains;
using test::run_until;
using test::UdpClient;

/// The bound is only there so that a broken test ends.
constexpr int patience_ms = 20'000;

struct Heard : UdpListener {
    std::vector<std::pair<UdpPeer, std::string>> datagrams;
    std::function<void(UdpPeer)> then;
    void on_datagram(UdpPeer from, std::string_view bytes) override {
        datagrams.emplace_back(from, std::string(bytes));
        if (then) then(from);
    }
    void on_trouble(std::string_view why) override { FAIL_CHECK(why); }
};

struct Bench {
    EventLoop loop;
    Heard heard;
    std::unique_ptr<UdpSocket> socket = make_udp_socket(loop, ":0");
    Bench() { socket->open(heard); }
    bool hear(std::size_t count) {
        return run_until(loop, [&] { return heard.datagrams.size() >= count; });
    }
};

TEST_CASE("udp: datagrams come whole with their sender, and answers go to it alone") {
    Bench bench;
    CHECK(bench.socket->path().starts_with("127.0.0.1:"));
    const UdpClient one(bench.socket->path());
    const UdpClient two(bench.socket->path());
    const std::string binary("\0M4000\r\n\x83\xFF", 10);
    one.send("M99999");
    two.send(binary);
    one.send("");
    one.send(std::string(20'000, 'x'));
    REQUIRE(bench.hear(4));
    const auto& got = bench.heard.datagrams;
    CHECK(got[0].second == "M99999");
    CHECK(got[1].second == binary);
    CHECK(got[2].second == "");
    CHECK(got[3].second == std::string(20'000, 'x'));
    CHECK(got[0].first != got[1].first);
    CHECK(got[0].first == got[2].first);
    CHECK(got[0].first != 0);
    CHECK(bench.socket->name(got[0].first) == one.address());

    bench.socket->send(got[1].first, "for two");
    bench.socket->send(got[0].first, "ok\r\n");
    CHECK(two.receive(patience_ms) == "for two");
    CHECK(one.receive(patience_ms) == "ok\r\n");
    CHECK(one.receive() == "(silence)");
    CHECK(bench.socket->stats().datagrams_in == 4);
    CHECK(bench.socket->stats().datagrams_out == 2);
    CHECK(bench.socket->stats().datagrams_lost == 0);
}

TEST_CASE("udp: what cannot be sent is lost and counted") {
    Bench bench;
    bench.socket->send(0, "to nobody");
    bench.socket->send(7, "to somebody never heard of");
    CHECK(bench.socket->stats().datagrams_lost == 2);
    const UdpClient client(bench.socket->path());
    client.send("x");
    REQUIRE(bench.hear(1));
    bench.socket->send(bench.heard.datagrams[0].first, std::string(UdpSocket::max_datagram + 1, 'x'));
    CHECK(bench.socket->stats().datagrams_lost == 3);
    bench.socket->close();
    bench.socket->close();
    bench.socket->send(bench.heard.datagrams[0].first, "x");
    CHECK(bench.socket->stats().datagrams_lost == 4);
    CHECK(bench.socket->stats().datagrams_out == 0);
    CHECK(bench.socket->pending() == 0);
}

TEST_CASE("udp: an answer to somebody who left troubles nobody else") {
    Bench bench;
    {
        const UdpClient gone(bench.socket->path());
        gone.send("M99999");
        REQUIRE(bench.hear(1));
    }
    for (int i = 0; i < 3; ++i) {
        bench.socket->send(bench.heard.datagrams[0].first, "into the void");
    }
    const UdpClient here(bench.socket->path());
    here.send("M4002");
    REQUIRE(bench.hear(2));
    CHECK(bench.heard.datagrams[1].second == "M4002");
}

TEST_CASE("udp: only so many senders are remembered, the latest") {
    Bench bench;
    std::vector<std::unique_ptr<UdpClient>> clients;
    for (std::size_t i = 0; i <= UdpSocket::peers_limit; ++i) {
        clients.push_back(std::make_unique<UdpClient>(bench.socket->path()));
        clients.back()->send("x");
        if (i == 1) {
            clients[0]->send("again");  // so that the second becomes the oldest
        }
        REQUIRE(bench.hear(i + (i == 0 ? 1 : 2)));
    }
    const auto& got = bench.heard.datagrams;
    const UdpPeer first = got[0].first;
    const UdpPeer second = got[1].first;
    CHECK(bench.socket->name(first) == clients[0]->address());
    CHECK(bench.socket->name(second) == "");
    bench.socket->send(second, "lost");
    CHECK(bench.socket->stats().datagrams_lost == 1);
    clients[1]->send("back");
    REQUIRE(bench.hear(clients.size() + 2));
    CHECK(got.back().first != second);
}

TEST_CASE("udp: the listener may close and destroy the socket from within") {
    Bench bench;
    bench.heard.then = [&](UdpPeer) { bench.socket.reset(); };
    const UdpClient client(bench.socket->path());
    client.send("a");
    client.send("b");
    REQUIRE(bench.hear(1));
    bench.loop.poll();
    CHECK(bench.heard.datagrams.size() == 1);
}

TEST_CASE("udp: what cannot be opened says why") {
    const auto why = [](const std::string& where) {
        EventLoop loop;
        Heard heard;
        try {
            make_udp_socket(loop, where)->open(heard);
        } catch (const LinkError& error) {
            return std::string(error.what());
        }
        return std::string("opened");
    };
    const Bench bench;
    CHECK(contains(why(bench.socket->path()), "Address already in use"));
    CHECK(contains(why("nonsense"), "is not an address"));
    CHECK(contains(why("127.0.0.1:70000"), "0 to 65535"));
    CHECK(contains(why("192.0.2.1:3000"), "cannot be listened on"));
}

}  // namespace
}  // namespace fauxboard::link
