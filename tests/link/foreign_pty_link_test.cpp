#include "emulator/link/foreign_pty_link.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <optional>

#include "helpers.h"

using namespace fauxboard::link;
using namespace fauxboard::link::test;
namespace fs = std::filesystem;

TEST_CASE("another's pty: recognised by its path, or through symlinks, even when it is gone") {
    const TemporaryFolder folder;
    const OtherPty other;
    fs::create_symlink(other.path, folder.file("live"));
    fs::create_symlink(folder.file("live"), folder.file("twice"));
    fs::create_symlink("/dev/pts/99999", folder.file("gone"));
    CHECK(is_pty_path(other.path));
    CHECK(is_pty_path(folder.file("live")));
    CHECK(is_pty_path(folder.file("twice")));
    CHECK(is_pty_path(folder.file("gone")));
    CHECK(is_pty_path("/dev/pts/99999"));
    CHECK_FALSE(is_pty_path("/dev/ttyUSB0"));
    CHECK_FALSE(is_pty_path(folder.file("nothing")));
}

TEST_CASE("another's pty: both ways, raw, and what was said before we came is heard") {
    EventLoop loop;
    Recorder heard;
    const OtherPty other;
    say(other.master.get(), "early\n");
    const auto link = make_port_link(loop, other.path, 115200);
    link->open(heard);
    CHECK(link->kind() == "pty");
    CHECK(link->path() == other.path);
    CHECK(link->state() == LinkState::up);
    say(other.master.get(), "\r\x03\x04\n");
    CHECK(run_until(loop, [&] { return heard.bytes == "early\n\r\x03\x04\n"; }));
    link->write("L1\r\n");
    std::string said;
    CHECK(run_until(loop, [&] { return (said += take(other.master.get())) == "L1\r\n"; }));
}

TEST_CASE("another's pty: set to lines under us, one burst of several is heard whole") {
    EventLoop loop;
    Recorder heard;
    const OtherPty other;
    const auto link = make_port_link(loop, other.path, 115200);
    link->open(heard);
    termios settings{};
    REQUIRE(::tcgetattr(other.master.get(), &settings) == 0);
    settings.c_lflag |= ICANON;
    settings.c_cc[VEOF] = 4;
    REQUIRE(::tcsetattr(other.master.get(), TCSANOW, &settings) == 0);
    say(other.master.get(), "M105\nM114\n\x04M115\n");
    CHECK(run_until(loop, [&] { return heard.bytes == "M105\nM114\nM115\n"; }));
    CHECK(heard.state_letters() == "u");
}

TEST_CASE("another's pty: vanishes, is waited for, and comes back under another number") {
    const TemporaryFolder folder;
    const std::string name = folder.file("board");
    EventLoop loop;
    Recorder heard;
    std::optional<OtherPty> other(std::in_place);
    fs::create_symlink(other->path, name);
    const auto link = make_port_link(loop, name, 250000);
    link->open(heard);
    say(other->master.get(), "last words");
    other.reset();
    REQUIRE(run_until(loop, [&] { return heard.state_letters() == "uw"; }));
    CHECK(contains(heard.last_why(), name + " vanished ("));
    link->write("lost");
    CHECK(link->stats().bytes_lost == 4);

    other.emplace();
    fs::remove(name);
    fs::create_symlink(other->path, name);
    REQUIRE(run_until(loop, [&] { return heard.state_letters() == "uwu"; }));
    heard.bytes.clear();
    say(other->master.get(), "again");
    CHECK(run_until(loop, [&] { return heard.bytes == "again"; }));
}

TEST_CASE("another's pty: a write that finds it gone is told by the loop, not by the call") {
    EventLoop loop;
    Recorder heard;
    std::optional<OtherPty> other(std::in_place);
    const auto link = make_port_link(loop, other->path, 9600);
    link->open(heard);
    run_ready(loop);
    other.reset();
    link->write("x");
    link->write("y");
    CHECK(heard.state_letters() == "u");
    CHECK(link->stats().writes_lost == 2);
    REQUIRE(run_until(loop, [&] { return link->state() == LinkState::waiting; }));
    run_ready(loop);
    CHECK(heard.state_letters() == "uw");
}

TEST_CASE("another's pty: one that does not exist is an error that says what to do") {
    EventLoop loop;
    Recorder heard;
    const auto link = make_port_link(loop, "/dev/pts/99999", 115200);
    const std::string error = link_error([&] { link->open(heard); });
    CHECK(contains(error, "/dev/pts/99999"));
    CHECK(contains(error, "must run first"));
    CHECK(link->state() == LinkState::opening);
}
