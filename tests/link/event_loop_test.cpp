// The loop itself: whose turn it is, what may end inside a call, edges that must not be lost.

#include "emulator/link/event_loop.h"

#include <sys/socket.h>
#include <sys/time.h>

#include <cerrno>
#include <csignal>
#include <optional>

#include "tests/link/helpers.h"

namespace fauxboard::link::test {
namespace {

using namespace std::chrono_literals;

/// Two connected sockets that do not block.
struct Pair {
    UniqueFd ours;
    UniqueFd theirs;

    Pair() {
        std::array<int, 2> fds{};
        REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, fds.data()) == 0);
        ours.reset(fds[0]);
        theirs.reset(fds[1]);
    }
};

/// Reads as everybody should: one read, and drained() after one that found less than it asked for.
struct Reader {
    Reader(EventLoop& loop, int fd) : watch(loop, [this] { read(); }) { watch.start(fd); }
    void read() {
        ++calls;
        std::array<char, 4> four{};
        const ssize_t size = ::read(watch.fd(), four.data(), four.size());
        if (size > 0) heard.append(four.data(), static_cast<std::size_t>(size));
        if (size == 0) {
            ended = true;
            watch.stop();
        } else if (size < static_cast<ssize_t>(four.size()) && (size < 0 || !watch.hung_up())) {
            watch.drained();
        }
    }
    int calls = 0;
    bool ended = false;
    std::string heard;
    Watch watch;
};

TEST_CASE("loop: with nothing to wait for it ends at once") {
    EventLoop loop;
    loop.run();
    CHECK_FALSE(loop.run_one());
    CHECK_FALSE(loop.run_one_for(1h));
    CHECK_FALSE(loop.poll());
    Timer unset(loop, [] { FAIL("rung"); });
    unset.after(1h);
    unset.cancel();
    loop.run();
    const Pair pair;
    Watch watch(loop, [] {});
    watch.start(pair.ours.get());
    CHECK(loop.run_one_for(0ms));
    watch.stop();
    loop.run();
    CHECK_FALSE(loop.stopped());
}

TEST_CASE("loop: what was posted comes in order, what it posts on the next turn") {
    EventLoop loop;
    std::string order;
    loop.post([&] {
        order += 'a';
        loop.post([&] { order += 'c'; });
    });
    loop.post([&] { order += 'b'; });
    CHECK(loop.poll());
    CHECK(order == "ab");
    loop.run();
    CHECK(order == "abc");
}

TEST_CASE("loop: stop() ends the turn at once, and for good") {
    EventLoop loop;
    const Pair pair;
    Reader reader(loop, pair.ours.get());
    say(pair.theirs.get(), "x");
    std::string order;
    loop.post([&] {
        order += 'a';
        loop.stop();
    });
    loop.post([&] { order += 'b'; });
    loop.run();
    CHECK(order == "a");
    CHECK(reader.calls == 0);
    CHECK(loop.stopped());
    loop.run();
    CHECK(order == "a");
}

TEST_CASE("watch: a flood is read in pieces, and what was posted gets its turn in between") {
    EventLoop loop;
    const Pair pair;
    Reader reader(loop, pair.ours.get());
    say(pair.theirs.get(), "0123456789");
    int turns = 0;
    while (reader.heard != "0123456789") {
        REQUIRE(loop.run_one());
        loop.post([&] { ++turns; });
    }
    CHECK(reader.calls == 3);
    CHECK(turns == 2);
    CHECK(loop.poll());
    CHECK_FALSE(loop.poll());  // drained: not called again
    CHECK(reader.calls == 3);
    say(pair.theirs.get(), "!");
    CHECK(loop.run_one());
    CHECK(reader.heard == "0123456789!");
}

TEST_CASE("watch: last words and the end that came at once are both found") {
    EventLoop loop;
    Pair pair;
    Reader reader(loop, pair.ours.get());
    say(pair.theirs.get(), "bye");
    pair.theirs.reset();
    loop.run();
    CHECK(reader.heard == "bye");
    CHECK(reader.ended);
}

TEST_CASE("watch: held it is not called, and what came meanwhile is not forgotten") {
    EventLoop loop;
    const Pair pair;
    Reader reader(loop, pair.ours.get());
    reader.watch.hold(true);
    say(pair.theirs.get(), "one");
    loop.poll();
    loop.poll();
    CHECK(reader.calls == 0);
    reader.watch.hold(false);
    loop.poll();
    CHECK(reader.heard == "one");
}

TEST_CASE("watch: one call when it can be written to, as often as is asked") {
    EventLoop loop;
    const Pair pair;
    int calls = 0;
    Watch watch(
        loop, [] {}, [&] { ++calls; });
    watch.await_writable();  // watches nothing: does nothing
    watch.start(pair.ours.get());
    loop.poll();
    CHECK(calls == 0);
    watch.await_writable();
    watch.await_writable();
    loop.poll();
    loop.poll();
    CHECK(calls == 1);
    std::string filler(1024, 'x');
    while (::write(pair.ours.get(), filler.data(), filler.size()) > 0) {
    }
    watch.await_writable();
    loop.poll();
    CHECK(calls == 1);
    take(pair.theirs.get());
    REQUIRE(loop.run_one());
    CHECK(calls == 2);
    // Nobody asked: what the other end reads wakes nobody.
    while (::write(pair.ours.get(), filler.data(), filler.size()) > 0) {
    }
    take(pair.theirs.get());
    CHECK_FALSE(loop.poll());
}

TEST_CASE("watch: a peer that is gone answers a wish to write, too") {
    EventLoop loop;
    Pair pair;
    int calls = 0;
    Watch watch(
        loop, [&] { watch.drained(); }, [&] { ++calls; });
    watch.start(pair.ours.get());
    std::string filler(1024, 'x');
    while (::write(pair.ours.get(), filler.data(), filler.size()) > 0) {
    }
    watch.await_writable();
    pair.theirs.reset();
    loop.poll();
    CHECK(calls == 1);
}

TEST_CASE("watch: a call may stop and destroy others whose turn was next, and itself") {
    EventLoop loop;
    std::vector<std::unique_ptr<Pair>> pairs;
    std::vector<std::unique_ptr<Watch>> watches;
    int calls = 0;
    for (int i = 0; i < 40; ++i) {  // more than one turn takes
        pairs.push_back(std::make_unique<Pair>());
        watches.push_back(std::make_unique<Watch>(loop, [&] {
            ++calls;
            watches.clear();
        }));
        watches.back()->start(pairs.back()->ours.get());
        say(pairs.back()->theirs.get(), "x");
    }
    loop.run();
    CHECK(calls == 1);
}

TEST_CASE("watch: stopped and started again inside its own call it sees what the new descriptor has") {
    EventLoop loop;
    const Pair first;
    const Pair second;
    std::optional<Watch> watch;
    std::string heard;
    watch.emplace(loop, [&] {
        const int fd = watch->fd();
        heard += take(fd);
        watch->stop();
        if (fd == first.ours.get()) watch->start(second.ours.get());
    });
    watch->start(first.ours.get());
    say(second.theirs.get(), "two");
    say(first.theirs.get(), "one ");
    loop.run();
    CHECK(heard == "one two");
}

TEST_CASE("watch: what cannot be watched is a sentence, and leaves the watch as if never started") {
    EventLoop loop;
    const TemporaryFolder folder;
    const UniqueFd file(::open(folder.file("plain").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
    Watch watch(loop, [] {});
    CHECK(contains(link_error([&] { watch.start(file.get()); }), "Operation not permitted"));
    CHECK(contains(link_error([&] { watch.start(9999); }), "descriptor 9999"));
    CHECK_FALSE(watch.active());
    loop.run();
}

TEST_CASE("timer: in the order of their moments, never too early, each once, the latest wish counts") {
    EventLoop loop;
    std::string order;
    const auto start = Timer::Clock::now();
    Timer a(loop, [&] { order += 'a'; });
    Timer b(loop, [&] { order += 'b'; });
    Timer c(loop, [&] { order += 'c'; });
    a.at(start + 3ms);
    b.at(start + 1ms);
    c.at(start - 1h);
    b.after(std::chrono::hours(1));
    b.at(start + 2ms);
    loop.run();
    CHECK(order == "cba");
    CHECK(Timer::Clock::now() >= start + 3ms);
}

TEST_CASE("timer: one that asks for the past again and again leaves others their turn") {
    EventLoop loop;
    int rung = 0;
    std::optional<Timer> greedy;
    greedy.emplace(loop, [&] {
        ++rung;
        greedy->at({});
    });
    greedy->at({});
    bool came = false;
    Timer modest(loop, [&] { came = true; });
    modest.after(0ms);
    for (int i = 0; i < 3; ++i)
        loop.run_one();
    CHECK(came);
    CHECK(rung == 3);
}

TEST_CASE("timer: may destroy itself and others") {
    EventLoop loop;
    std::optional<Timer> one;
    std::optional<Timer> two;
    const auto end_both = [&] {
        one.reset();
        two.reset();
    };
    one.emplace(loop, end_both);
    two.emplace(loop, end_both);
    one->at({});
    two->at({});
    loop.run();
    CHECK_FALSE(one);
}

TEST_CASE("loop: what has come is heard before a moment that is past is told") {
    EventLoop loop;
    const Pair pair;
    std::string order;
    Watch watch(loop, [&] {
        order += take(pair.ours.get());
        watch.drained();
    });
    watch.start(pair.ours.get());
    Timer timer(loop, [&] { order += " late"; });
    timer.at({});
    say(pair.theirs.get(), "in time");
    CHECK(run_until(loop, [&] { return order == "in time late"; }));
}

bool is_default(int number) {
    struct sigaction now {};
    REQUIRE(::sigaction(number, nullptr, &now) == 0);
    return now.sa_handler == SIG_DFL;
}

TEST_CASE("signals: come by the loop, one call each, and do nothing else to the process") {
    EventLoop loop;
    std::vector<int> came;
    {
        Signals signals(loop, {SIGUSR1, SIGUSR2}, [&](int number) { came.push_back(number); });
        ::raise(SIGUSR2);
        ::raise(SIGUSR1);
        CHECK(run_until(loop, [&] { return came.size() == 2; }));
        ::raise(SIGUSR1);  // swallowed at the end
        CHECK_FALSE(is_default(SIGUSR1));
    }
    CHECK(came == std::vector<int>{SIGUSR2, SIGUSR1});
    CHECK(is_default(SIGUSR1));
    CHECK(is_default(SIGUSR2));
    loop.run();  // nothing is left to wait for
}

TEST_CASE("signals: more than a pipe holds end no less well") {
    EventLoop loop;
    int came = 0;
    Signals signals(loop, {SIGUSR1}, [&](int) { ++came; });
    for (int i = 0; i < 100'000; ++i)
        ::raise(SIGUSR1);
    CHECK(run_until(loop, [&] { return came > 0; }));
}

TEST_CASE("signals: interrupt a call that blocks") {
    EventLoop loop;
    int came = 0;
    Signals signals(loop, {SIGALRM}, [&](int) { ++came; });
    const itimerval soon{{0, 1000}, {0, 1000}};  // again and again: the first may come too early
    REQUIRE(::setitimer(ITIMER_REAL, &soon, nullptr) == 0);
    std::array<int, 2> ends{};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    const UniqueFd out(ends[0]);
    const UniqueFd in(ends[1]);
    char byte = 0;
    const ssize_t got = ::read(out.get(), &byte, 1);
    const int error = errno;
    const itimerval never{};
    ::setitimer(ITIMER_REAL, &never, nullptr);
    CHECK(got == -1);
    CHECK(error == EINTR);
    CHECK(run_until(loop, [&] { return came > 0; }));
}

}  // namespace
}  // namespace fauxboard::link::test
