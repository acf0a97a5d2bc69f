// Passing on to a slower line: hold(), pending(), on_drained().

#include <doctest/doctest.h>

#include <string>

#include "tests/link/helpers.h"

namespace fauxboard::link::test {
namespace {

/// Counts how often all has been handed over.
struct DrainCounter final : Recorder {
    int drained = 0;
    void on_drained() override { ++drained; }
};

TEST_CASE("a held link reads nothing, and all of it when it goes on") {
    EventLoop loop;
    OtherPty other;
    Recorder heard;
    const auto link = make_port_link(loop, other.path, 115200);
    link->open(heard);
    say(other.master.get(), "one");
    REQUIRE(run_until(loop, [&] { return heard.bytes == "one"; }));
    link->hold(true);
    say(other.master.get(), "two");
    for (int i = 0; i < 5; ++i) {
        loop.run_one_for(std::chrono::milliseconds(1));
    }
    CHECK(heard.bytes == "one");
    link->hold(false);
    CHECK(run_until(loop, [&] { return heard.bytes == "onetwo"; }));
    link->close();
}

TEST_CASE("a listener may hold its link from inside on_bytes, and let it go again") {
    EventLoop loop;
    OtherPty other;
    Recorder heard;
    const auto link = make_port_link(loop, other.path, 115200);
    heard.then = [&](std::string_view) {
        link->hold(true);
        link->hold(false);
        link->hold(false);
    };
    link->open(heard);
    say(other.master.get(), "one");
    REQUIRE(run_until(loop, [&] { return heard.bytes == "one"; }));
    say(other.master.get(), "two");
    CHECK(run_until(loop, [&] { return heard.bytes == "onetwo"; }));
    link->close();
}

TEST_CASE("an end that came while the link was held is found, and opening it again lets it read") {
    EventLoop loop;
    Recorder heard;
    const auto link = make_pty_link(loop, "");
    link->open(heard);
    UniqueFd peer = open_terminal(link->path());
    REQUIRE(run_until(loop, [&] { return link->state() == LinkState::up; }));
    link->hold(true);
    say(peer.get(), "last words");
    peer.reset();
    run_ready(loop);
    link->hold(false);
    CHECK(run_until(loop, [&] { return link->state() == LinkState::waiting; }));
    CHECK(heard.bytes == "last words");
    link->hold(true);
    link->close();
    link->open(heard);
    peer = open_terminal(link->path());
    REQUIRE(run_until(loop, [&] { return link->state() == LinkState::up; }));
    say(peer.get(), "!");
    CHECK(run_until(loop, [&] { return heard.bytes == "last words!"; }));
    link->close();
}

TEST_CASE("what the system does not take is pending, and the listener hears when it has gone") {
    EventLoop loop;
    DrainCounter heard;
    const auto link = make_pty_link(loop, "");
    link->open(heard);
    const UniqueFd peer = open_terminal(link->path());
    REQUIRE(run_until(loop, [&] { return link->state() == LinkState::up; }));
    CHECK(link->pending() == 0);
    std::size_t written = 0;
    while (link->pending() == 0 && written < 10'000'000) {
        link->write(std::string(1000, 'x'));
        written += 1000;
    }
    REQUIRE(link->pending() != 0);
    CHECK(heard.drained == 0);
    std::size_t read = 0;
    CHECK(run_until(loop, [&] {
        read += take(peer.get()).size();
        return heard.drained == 1;
    }));
    CHECK(link->pending() == 0);
    CHECK(run_until(loop, [&] {
        read += take(peer.get()).size();
        return read == written;
    }));
    CHECK(link->stats().bytes_lost == 0);
    link->close();
}

}  // namespace
}  // namespace fauxboard::link::test
