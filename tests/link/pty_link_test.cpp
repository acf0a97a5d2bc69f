#include "emulator/link/pty_link.h"

#include <doctest/doctest.h>

#include <termios.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "helpers.h"

using namespace fauxboard::link;
using namespace fauxboard::link::test;

namespace {

struct Pty {
    EventLoop loop;
    Recorder heard;
    std::unique_ptr<Link> link;

    explicit Pty(const std::string& name = "", bool watch = true) : link(make_pty_link(loop, name, watch)) {
        link->open(heard);
    }
    UniqueFd peer() { return open_terminal(link->path()); }
    UniqueFd peer_up() {
        UniqueFd fd = peer();
        REQUIRE(until(LinkState::up));
        return fd;
    }
    bool until(LinkState state) {
        const bool reached = run_until(loop, [&] { return link->state() == state; });
        run_ready(loop);
        return reached;
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

TEST_CASE("pty: bytes pass unchanged both ways") {
    Pty pty;
    CHECK(pty.link->kind() == "pty");
    CHECK(pty.link->state() == LinkState::waiting);
    const UniqueFd peer = pty.peer_up();
    std::string all;
    for (int i = 0; i < 256; ++i)
        all += static_cast<char>(i);
    say(peer.get(), all);
    CHECK(pty.until_heard(all));
    pty.link->write(all);
    CHECK(pty.until_said(peer, all));
    CHECK(pty.link->stats().bytes_in == 256);
    CHECK(pty.link->stats().bytes_out == 256);
    CHECK(pty.link->stats().bytes_lost == 0);
}

TEST_CASE("pty: a peer at another speed than the board's is told of, once, and heard all the same") {
    for (const auto& [speed, told] : {std::pair{B9600, true}, std::pair{B115200, false}}) {
        EventLoop loop;
        Recorder heard;
        const auto link = make_pty_link(loop, "", PtyUse{115200, true});
        link->open(heard);
        const UniqueFd peer = open_terminal(link->path());
        termios settings{};
        REQUIRE(::tcgetattr(peer.get(), &settings) == 0);
        REQUIRE(::cfsetspeed(&settings, static_cast<speed_t>(speed)) == 0);
        REQUIRE(::tcsetattr(peer.get(), TCSANOW, &settings) == 0);
        say(peer.get(), "one");
        REQUIRE(run_until(loop, [&] { return heard.bytes == "one"; }));
        say(peer.get(), "two");
        REQUIRE(run_until(loop, [&] { return heard.bytes == "onetwo"; }));
        const auto notes = std::count_if(heard.states.begin(), heard.states.end(), [](const auto& state) {
            return state.second.find("was opened at 9600 baud, the board has 115200") != std::string::npos;
        });
        CHECK(notes == (told ? 1 : 0));
    }
}

TEST_CASE("pty: messages written together arrive in order") {
    Pty pty;
    const UniqueFd peer = pty.peer_up();
    say(peer.get(), "one\ntwo\nthree\n");
    CHECK(pty.until_heard("one\ntwo\nthree\n"));
    for (const char* text : {"a\r\n", "b\r\n", "c\r\n"})
        pty.link->write(text);
    CHECK(pty.until_said(peer, "a\r\nb\r\nc\r\n"));
}

TEST_CASE("pty: the link name is made, described and removed") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    {
        Pty pty(name);
        CHECK(std::filesystem::read_symlink(name) == pty.link->path());
        CHECK(pty.link->describe() == "pty " + pty.link->path() + " (link " + name + ")");
        pty.link->close();
        CHECK_FALSE(std::filesystem::is_symlink(name));
        pty.link->close();
        pty.link->open(pty.heard);
        CHECK(std::filesystem::is_symlink(name));
    }
    CHECK_FALSE(std::filesystem::is_symlink(name));
}

TEST_CASE("pty: a name that is taken stops the start and leaves nothing open") {
    const TemporaryFolder folder;
    std::ofstream(folder.file("screen")) << "precious";
    EventLoop loop;
    Recorder heard;
    const auto link = make_pty_link(loop, folder.file("screen"));
    CHECK(contains(link_error([&] { link->open(heard); }), "not a symlink"));
    CHECK(link->state() == LinkState::opening);
    CHECK(std::filesystem::is_regular_file(folder.file("screen")));
}

TEST_CASE("pty: peers that come, go and come again are noticed") {
    Pty pty;
    for (int i = 0; i < 3; ++i) {
        UniqueFd peer = pty.peer_up();
        peer.reset();
        REQUIRE(pty.until(LinkState::waiting));
    }
    CHECK(pty.heard.state_letters() == "wuwuwuw");
    CHECK(contains(pty.heard.last_why(), pty.link->path()));
}

TEST_CASE("pty: it stays up until the last of several openers has gone") {
    Pty pty;
    // Opened without a turn of the loop in between, the kernel reports the two as one.
    UniqueFd one = pty.peer();
    UniqueFd two = pty.peer();
    REQUIRE(pty.until(LinkState::up));
    one.reset();
    run_ready(pty.loop);
    say(two.get(), "still here");
    CHECK(pty.until_heard("still here"));
    CHECK(pty.link->state() == LinkState::up);
    two.reset();
    CHECK(pty.until(LinkState::waiting));
}

TEST_CASE("pty: what a peer says before it leaves at once is heard") {
    Pty pty;
    say(pty.peer().get(), "M105\n");
    CHECK(pty.until_heard("M105\n"));
    const std::string much(2 * Link::read_limit + 1, 'x');
    {
        const UniqueFd peer = pty.peer_up();
        say(peer.get(), much);
    }
    CHECK(pty.until_heard("M105\n" + much));
    CHECK(pty.until(LinkState::waiting));
    CHECK(pty.heard.most_at_once <= Link::read_limit);
}

TEST_CASE("pty: what is said before the first peer is kept for it, up to the limit") {
    Pty pty;
    const std::string message(1024, 'b');
    for (int i = 0; i < 4; ++i)
        pty.link->write(message);
    CHECK(pty.link->stats().bytes_lost == 0);
    pty.link->write("one too many");
    CHECK(pty.link->stats().bytes_lost == 12);
    CHECK(pty.link->stats().writes_lost == 1);
    const UniqueFd peer = pty.peer_up();
    CHECK(pty.until_said(peer, std::string(4096, 'b')));
    CHECK(pty.link->stats().bytes_out == 4096);
}

TEST_CASE("pty: one that only looked in does not take the backlog away") {
    Pty pty;
    pty.link->write("boot\n");
    pty.peer().reset();
    run_ready(pty.loop);
    const UniqueFd peer = pty.peer_up();
    CHECK(pty.until_said(peer, "boot\n"));
}

TEST_CASE("pty: a new peer never reads the past") {
    Pty pty;
    UniqueFd first = pty.peer_up();
    pty.link->write("old, unread\n");
    SUBCASE("noticed in between") {
        first.reset();
        REQUIRE(pty.until(LinkState::waiting));
        pty.link->write("to nobody\n");
        CHECK(pty.link->stats().writes_lost == 1);
    }
    SUBCASE("not noticed in between") {
        first.reset();
    }
    const UniqueFd second = pty.peer();
    REQUIRE(run_until(pty.loop, [&] { return pty.heard.state_letters() == "wuwu"; }));
    pty.link->write("new\n");
    CHECK(pty.until_said(second, "new\n"));
}

TEST_CASE("pty: the settings of one peer are not the next one's") {
    Pty pty;
    {
        const UniqueFd peer = pty.peer_up();
        termios cooked{};
        REQUIRE(::tcgetattr(peer.get(), &cooked) == 0);
        cooked.c_lflag |= ICANON | ECHO;
        cooked.c_oflag |= OPOST | ONLCR;
        REQUIRE(::tcsetattr(peer.get(), TCSANOW, &cooked) == 0);
    }
    REQUIRE(pty.until(LinkState::waiting));
    const UniqueFd peer = pty.peer_up();
    termios settings{};
    REQUIRE(::tcgetattr(peer.get(), &settings) == 0);
    CHECK((settings.c_lflag & (ICANON | ECHO)) == 0);
    CHECK((settings.c_oflag & OPOST) == 0);
}

TEST_CASE("pty: a peer that never reads costs whole messages, not memory, and is still heard") {
    Pty pty;
    const UniqueFd peer = pty.peer_up();
    std::string message(999, 'm');
    message += '\n';
    for (int i = 0; i < 10000; ++i)
        pty.link->write(message);
    const LinkStats& stats = pty.link->stats();
    CHECK(stats.bytes_lost == stats.writes_lost * 1000);
    CHECK(10'000'000 - stats.bytes_lost - stats.bytes_out <= Link::pending_limit);
    CHECK(stats.bytes_out < 1'000'000);
    say(peer.get(), "still here");
    CHECK(pty.until_heard("still here"));

    std::string said;
    CHECK(run_until(pty.loop, [&] {
        said += take(peer.get());
        return said.size() + stats.bytes_lost == 10'000'000;
    }));
    bool whole = said.size() % 1000 == 0;
    for (std::size_t at = 0; whole && at < said.size(); at += 1000)
        whole = said.compare(at, 1000, message) == 0;
    CHECK(whole);
    pty.link->write("fresh\n");
    CHECK(pty.until_said(peer, "fresh\n"));
}

TEST_CASE("pty: what was pending for a peer that left is counted as lost") {
    Pty pty;
    UniqueFd peer = pty.peer_up();
    const std::string message(1000, 'm');
    std::uint64_t written = 0;
    for (; pty.link->stats().writes_lost == 0; written += message.size())
        pty.link->write(message);
    peer.reset();
    REQUIRE(pty.until(LinkState::waiting));
    const LinkStats& stats = pty.link->stats();
    CHECK(stats.bytes_out + stats.bytes_lost == written);
    CHECK(stats.writes_lost > 1);
}

TEST_CASE("pty: a message longer than all the room there is is lost as a whole") {
    Pty pty;
    const UniqueFd peer = pty.peer_up();
    pty.link->write(std::string(Link::pending_limit + 1, 'x'));
    CHECK(pty.link->stats().bytes_lost == Link::pending_limit + 1);
    pty.link->write("");
    pty.link->write("ok\n");
    CHECK(pty.until_said(peer, "ok\n"));
    CHECK(pty.link->stats().writes_lost == 1);
}

TEST_CASE("pty: without watches it is up from the start and outlives its peers") {
    Pty pty("", false);
    CHECK(pty.link->state() == LinkState::up);
    for (const char* text : {"one", "two"}) {
        UniqueFd peer = pty.peer();
        pty.link->write(text);
        CHECK(pty.until_said(peer, text));
        pty.heard.bytes.clear();
        say(peer.get(), text);
        CHECK(pty.until_heard(text));
        peer.reset();
        run_ready(pty.loop);
        CHECK(pty.link->state() == LinkState::up);
    }
    CHECK(pty.heard.state_letters() == "u");
}

TEST_CASE("pty: the listener may close or destroy the link from inside a call") {
    Pty pty;
    const UniqueFd peer = pty.peer_up();
    SUBCASE("close") {
        pty.heard.then = [&](std::string_view) { pty.link->close(); };
    }
    SUBCASE("destroy") {
        pty.heard.then = [&](std::string_view) { pty.link.reset(); };
    }
    SUBCASE("close and open") {
        pty.heard.then = [&](std::string_view) {
            pty.link->close();
            pty.link->open(pty.heard);
        };
    }
    say(peer.get(), "x");
    CHECK(pty.until_heard("x"));
    run_ready(pty.loop);
    CHECK(pty.heard.bytes == "x");
}

TEST_CASE("a closed link loses what is written and tells nobody anything") {
    Pty pty;
    pty.link->close();
    run_ready(pty.loop);
    CHECK(pty.heard.states.empty());
    pty.link->write("x");
    CHECK(pty.link->stats().bytes_lost == 1);
    CHECK(pty.link->state() == LinkState::opening);
}

TEST_CASE("opening twice is refused and harms nothing") {
    Pty pty;
    CHECK(contains(link_error([&] { pty.link->open(pty.heard); }), "open already"));
    const UniqueFd peer = pty.peer_up();
    say(peer.get(), "x");
    CHECK(pty.until_heard("x"));
}
