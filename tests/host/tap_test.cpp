#include "emulator/host/tap.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "emulator/host/tap_end.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/unique_fd.h"
#include "tests/host/live_helpers.h"

namespace fauxboard::host {
namespace {

using link::LinkState;
using link::UniqueFd;
using test::HandClock;

/// A link that takes as many bytes as the test lets it.
struct SlowLink final : link::Link {
    link::LinkListener* listener = nullptr;
    LinkState now = LinkState::up;
    std::string written;
    std::size_t room = std::string::npos;
    std::size_t waiting = 0;
    bool held = false;
    link::LinkStats counted;

    void open(link::LinkListener& who) override { listener = &who; }
    void close() override { listener = nullptr; }
    void write(std::string_view message) override {
        written += message;
        const std::size_t taken = std::min(room, message.size());
        room -= room == std::string::npos ? 0 : taken;
        waiting += message.size() - taken;
    }
    std::size_t pending() const override { return waiting; }
    void hold(bool hold_it) override { held = hold_it; }
    LinkState state() const override { return now; }
    const link::LinkStats& stats() const override { return counted; }
    std::string describe() const override { return "slow"; }
    std::string kind() const override { return "fake"; }
    std::string path() const override { return "nowhere"; }
};

struct Passed final : TapObserver {
    std::array<std::string, 2> bytes;
    std::vector<std::string> links;
    std::vector<SimTime> times;

    void on_passed(SimTime now, TapSide from, std::string_view more) override {
        bytes[static_cast<std::size_t>(from)] += more;
        times.push_back(now);
    }
    void on_link(SimTime, TapSide side, LinkState, std::string_view why) override {
        links.push_back((side == TapSide::a ? "A: " : "B: ") + std::string(why));
    }
};

struct FakeTap {
    SlowLink a;
    SlowLink b;
    HandClock clock;
    Passed passed;
    Tap tap{a, b, clock, passed};
    FakeTap() { tap.open(); }
};

TEST_CASE("what one end says is written to the other at once, and told with its time") {
    FakeTap f;
    f.clock.hand = SimTime{1'234};
    f.a.listener->on_bytes("abc");
    f.b.listener->on_bytes("xyz");
    CHECK(f.b.written == "abc");
    CHECK(f.a.written == "xyz");
    CHECK(f.passed.bytes[0] == "abc");
    CHECK(f.passed.bytes[1] == "xyz");
    CHECK(f.passed.times == std::vector<SimTime>{SimTime{1'234}, SimTime{1'234}});
    CHECK(f.tap.delay().count() == 2);
    CHECK(f.tap.delay().max() == SimTime{0});
}

TEST_CASE("an end that takes no more holds up the one that sends, and counts as late") {
    FakeTap f;
    f.b.room = 2;
    f.a.listener->on_bytes("abc");
    CHECK(f.a.held);
    CHECK_FALSE(f.b.held);
    CHECK(f.tap.delay().count() == 0);
    f.clock.hand += SimTime{500};
    f.b.waiting = 0;
    f.b.listener->on_drained();
    CHECK_FALSE(f.a.held);
    CHECK(f.tap.delay().count() == 1);
    CHECK(f.tap.delay().median() >= SimTime{480});
    CHECK(f.tap.delay().max() == SimTime{500});
}

TEST_CASE("an end that goes away holds nobody up") {
    FakeTap f;
    f.b.room = 0;
    f.a.listener->on_bytes("abc");
    REQUIRE(f.a.held);
    f.b.now = LinkState::waiting;
    f.b.waiting = 0;
    f.b.listener->on_state(LinkState::waiting, "it vanished");
    CHECK_FALSE(f.a.held);
    f.a.listener->on_bytes("lost");
    CHECK_FALSE(f.a.held);
    CHECK(f.passed.links == std::vector<std::string>{"B: it vanished"});
}

TEST_CASE("delays: smallest, middle and largest in fixed memory") {
    TapDelay delay;
    CHECK(delay.median() == SimTime{0});
    for (const int us : {5, 3, 1'000, 7, 90'000'000}) {
        delay.add(SimTime{us});
    }
    CHECK(delay.count() == 5);
    CHECK(delay.min() == SimTime{3});
    CHECK(delay.median() == SimTime{7});
    CHECK(delay.max() == SimTime{90'000'000});
    for (const SimTime::rep us : {63L, 64L, 65L, 127L, 128L, 1'000L, 123'456L, 987'654'321L}) {
        TapDelay one;
        one.add(SimTime{us});
        one.add(SimTime{us});
        CHECK(one.median() <= SimTime{us});
        CHECK(one.median().count() * 32 >= us * 31);
    }
    delay.add(machine::never);
    CHECK(delay.max() == machine::never);
}

TEST_CASE("the ends of a line as the command line names them") {
    CHECK(parse_tap_end("pty") == TapEnd{TapEnd::Kind::pty, ""});
    CHECK(parse_tap_end("pty=/tmp/x") == TapEnd{TapEnd::Kind::pty, "/tmp/x"});
    CHECK(parse_tap_end("tcp:localhost:1") == TapEnd{TapEnd::Kind::tcp_connect, "localhost:1"});
    CHECK(parse_tap_end("tcp-listen:0") == TapEnd{TapEnd::Kind::tcp_listen, "0"});
    CHECK(parse_tap_end("/dev/ttyUSB0") == TapEnd{TapEnd::Kind::port, "/dev/ttyUSB0"});
    for (const char* none : {"", "tcp:", "tcp-listen:", "pty="}) {
        CHECK_THROWS_AS(parse_tap_end(none), link::LinkError);
    }
}

// ---- with real ptys and sockets, in one process ----

/// A person at one end of a line, who writes and reads without waiting.
struct Peer {
    UniqueFd fd;
    std::string heard;

    explicit Peer(const std::string& path) { come(path); }
    void come(const std::string& path) {
        fd.reset(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
        REQUIRE(fd);
    }
    void go() { fd.reset(); }
    /// How many bytes were taken.
    std::size_t say(std::string_view bytes) const {
        const ssize_t count = ::write(fd.get(), bytes.data(), bytes.size());
        return count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    void listen(std::size_t at_most = 65'536) {
        std::string buffer(at_most, '\0');
        const ssize_t count = ::read(fd.get(), buffer.data(), buffer.size());
        if (count > 0) {
            heard.append(buffer, 0, static_cast<std::size_t>(count));
        }
    }
};

struct RealTap {
    link::EventLoop loop;
    HandClock clock;
    Passed passed;
    std::unique_ptr<link::Link> a = make_tap_link(loop, parse_tap_end("pty"), 115200);
    std::unique_ptr<link::Link> b = make_tap_link(loop, parse_tap_end("pty"), 115200);
    Tap tap{*a, *b, clock, passed};
    RealTap() { tap.open(); }

    /// Lets the loop do what is ready until `done`. The bound is only there so that a broken test ends.
    template <class Done>
    bool run_until(Done&& done) {
        for (int i = 0; i < 2'000; ++i) {
            if (done()) {
                return true;
            }
            loop.run_one_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    bool both_up() {
        return run_until([&] { return a->state() == LinkState::up && b->state() == LinkState::up; });
    }
};

std::string random_bytes(std::size_t size, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::string bytes(size, '\0');
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random() >> 56); });
    return bytes;
}

/// One direction of a flood: what is to be said, and how far that has come.
struct Flood {
    std::string bytes;
    Peer& from;
    Peer& to;
    std::mt19937 random;
    std::size_t said = 0;

    void step() {
        const std::size_t size = std::min<std::size_t>(1 + random() % 20'000, bytes.size() - said);
        if (size != 0) {
            said += from.say(std::string_view(bytes).substr(said, size));
        }
        to.listen(1 + random() % 30'000);
    }
    bool done() const { return to.heard.size() >= bytes.size(); }
};

TEST_CASE("10 MB each way at once, in pieces of any size, pass unchanged") {
    constexpr std::size_t size = 10'000'000;
    RealTap f;
    Peer at_a(f.a->path());
    Peer at_b(f.b->path());
    REQUIRE(f.both_up());
    Flood there{random_bytes(size, 1), at_a, at_b, std::mt19937(3)};
    Flood back{random_bytes(size, 2), at_b, at_a, std::mt19937(4)};
    for (int idle = 0; idle < 2'000 && !(there.done() && back.done()); ++idle) {
        const std::size_t before = at_a.heard.size() + at_b.heard.size();
        there.step();
        back.step();
        if (!f.loop.poll()) {
            f.loop.run_one_for(std::chrono::milliseconds(1));
        }
        idle = at_a.heard.size() + at_b.heard.size() == before ? idle : 0;
    }
    CHECK((at_b.heard == there.bytes));
    CHECK((at_a.heard == back.bytes));
    CHECK((f.passed.bytes[0] == there.bytes));
    CHECK((f.passed.bytes[1] == back.bytes));
    CHECK(f.b->stats().bytes_lost == 0);
    CHECK(f.a->stats().bytes_lost == 0);
}

TEST_CASE("a reader that sleeps loses nothing, and the other direction goes on") {
    RealTap f;
    Peer at_a(f.a->path());
    Peer at_b(f.b->path());
    REQUIRE(f.both_up());
    const std::string much = random_bytes(2'000'000, 7);
    std::size_t said = 0;
    // Until nothing more is taken: B does not read.
    for (int idle = 0; idle < 20; ++idle) {
        const std::size_t taken = at_a.say(std::string_view(much).substr(said));
        said += taken;
        idle = taken != 0 ? 0 : idle;
        f.loop.run_one_for(std::chrono::milliseconds(1));
    }
    CHECK(said < much.size());
    REQUIRE(at_b.say("still here") == 10);
    CHECK(f.run_until([&] {
        at_a.listen();
        return at_a.heard == "still here";
    }));
    CHECK(f.run_until([&] {
        said += said < much.size() ? at_a.say(std::string_view(much).substr(said)) : 0;
        at_b.listen();
        f.loop.poll();
        return at_b.heard.size() >= much.size();
    }));
    CHECK((at_b.heard == much));
    CHECK(f.b->stats().bytes_lost == 0);
}

TEST_CASE("an end that goes and comes back: only what was said meanwhile is lost, and counted") {
    RealTap f;
    Peer at_a(f.a->path());
    Peer at_b(f.b->path());
    REQUIRE(f.both_up());
    for (int round = 0; round < 4; ++round) {
        Peer& stays = round % 2 == 0 ? at_a : at_b;
        Peer& leaves = round % 2 == 0 ? at_b : at_a;
        const link::Link& left = round % 2 == 0 ? *f.b : *f.a;
        // Last words are heard though who says them goes at once.
        REQUIRE(leaves.say("bye\r\n") == 5);
        leaves.go();
        REQUIRE(f.run_until([&] {
            stays.listen();
            return left.state() == LinkState::waiting && stays.heard.ends_with("bye\r\n");
        }));
        const std::uint64_t lost = left.stats().bytes_lost;
        REQUIRE(stays.say("anybody?\r\n") == 10);
        REQUIRE(f.run_until([&] { return left.stats().bytes_lost == lost + 10; }));
        leaves.heard.clear();
        leaves.come(left.path());
        REQUIRE(f.both_up());
        REQUIRE(stays.say("hello\r\n") == 7);
        REQUIRE(leaves.say("hello to you\r\n") == 14);
        CHECK(f.run_until([&] {
            stays.listen();
            leaves.listen();
            return leaves.heard == "hello\r\n" && stays.heard.ends_with("hello to you\r\n");
        }));
    }
}

TEST_CASE("a screen at a socket, a board at somebody's pty") {
    link::EventLoop loop;
    HandClock clock;
    Passed passed;
    const auto a = make_tap_link(loop, parse_tap_end("tcp-listen:127.0.0.1:0"), 115200);
    const auto pty = link::make_pty_link(loop, "");
    struct Board final : link::LinkListener {
        std::string heard;
        void on_bytes(std::string_view bytes) override { heard += bytes; }
        void on_state(LinkState, std::string_view) override {}
    } board;
    pty->open(board);
    const auto b = make_tap_link(loop, parse_tap_end(pty->path()), 115200);
    Tap tap(*a, *b, clock, passed);
    tap.open();
    const auto screen = make_tap_link(loop, parse_tap_end("tcp:" + a->path()), 115200);
    Board at_screen;
    screen->open(at_screen);
    for (int i = 0; i < 500 && (a->state() != LinkState::up || pty->state() != LinkState::up); ++i) {
        loop.run_one_for(std::chrono::milliseconds(10));
    }
    screen->write("M27\r\n");
    pty->write("N-0 L21 P0 S0*63\r\n");
    for (int i = 0; i < 500 && (board.heard.size() < 5 || at_screen.heard.size() < 18); ++i) {
        loop.run_one_for(std::chrono::milliseconds(10));
    }
    CHECK(board.heard == "M27\r\n");
    CHECK(at_screen.heard == "N-0 L21 P0 S0*63\r\n");
    screen->close();
    tap.close();
    pty->close();
}

TEST_CASE("an end that cannot be opened closes the other again") {
    link::EventLoop loop;
    HandClock clock;
    Passed passed;
    const auto a = make_tap_link(loop, parse_tap_end("pty"), 115200);
    const auto b = make_tap_link(loop, parse_tap_end("/dev/no-such-port"), 115200);
    Tap tap(*a, *b, clock, passed);
    CHECK_THROWS_AS(tap.open(), link::LinkError);
    CHECK(a->state() == LinkState::opening);
}

}  // namespace
}  // namespace fauxboard::host
