#include "emulator/host/faulty_link.h"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/host/live_helpers.h"

namespace fauxboard::host::test {
namespace {

using fault::Direction;
using fault::fault_from_text;
using link::LinkState;

/// Remembers what it hears; may answer, and may end the link.
struct Ear final : link::LinkListener {
    std::string heard;
    std::vector<std::string> news;
    std::vector<LinkState> states;
    std::function<void()> on_hearing;
    int drained = 0;

    void on_bytes(std::string_view bytes) override {
        CHECK(bytes.size() >= 1);
        CHECK(bytes.size() <= link::Link::read_limit);
        heard += bytes;
        if (on_hearing) {
            on_hearing();
        }
    }
    void on_state(LinkState state, std::string_view why) override {
        states.push_back(state);
        news.emplace_back(why);
    }
    void on_drained() override { ++drained; }
};

/// A screen at a FakeLink, a faulty line, and the ear of the board.
struct Bench {
    FakeLink screen;
    HandClock clock;
    Ear board;
    std::unique_ptr<FaultyLink> line = std::make_unique<FaultyLink>(screen, clock, Direction::to_board);

    void open() {
        line->open(board);
        screen.now = LinkState::up;
    }
    fault::FaultId add(std::string_view spec) { return line->add(fault_from_text(spec)); }
    void say(std::string_view bytes) { screen.listener->on_bytes(bytes); }
    std::string heard() { return std::exchange(board.heard, {}); }
    std::string written() {
        std::string all = screen.all();
        screen.messages.clear();
        return all;
    }
};

TEST_CASE("without a fault bytes pass untouched and at once, the very same bytes, and no alarm is set") {
    Bench b;
    b.open();
    b.clock.pass(0s);
    const std::string bytes = "half a \r\0";
    b.say(bytes);
    CHECK(b.heard() == bytes);
    b.line->write("an");
    b.line->write("swer\r\n");
    CHECK(b.screen.messages == std::vector<std::string>{"an", "swer\r\n"});
    CHECK(b.clock.earliest() == machine::never);
    CHECK(b.line->state() == LinkState::up);
    CHECK(b.line->path() == "nowhere");
    CHECK(b.line->kind() == "fake");
    b.screen.go(LinkState::waiting, "gone");
    CHECK(b.board.news == std::vector<std::string>{"gone"});
    CHECK(b.board.states == std::vector<LinkState>{LinkState::waiting});
    b.screen.listener->on_drained();
    CHECK(b.board.drained == 1);
}

TEST_CASE("each direction has its faults: what is read goes to the board here, and to the screen in a tap") {
    for (const Direction reads : {Direction::to_board, Direction::to_screen}) {
        Bench b;
        b.line = std::make_unique<FaultyLink>(b.screen, b.clock, reads);
        b.add("drop:to_board,every=2");
        b.open();
        b.say("one\ntwo\n");
        b.line->write("three\nfour\n");
        CHECK(b.heard() == (reads == Direction::to_board ? "one\n" : "one\ntwo\n"));
        CHECK(b.written() == (reads == Direction::to_board ? "three\nfour\n" : "three\n"));
        CHECK(b.line->list().at(0).acted == 1);
    }
}

TEST_CASE("a delay is met to the microsecond, both ways, and the answer to a late request is possible") {
    Bench b;
    b.add("delay:time=200ms");
    b.open();
    b.board.on_hearing = [&] { b.line->write("answer\n"); };
    b.say("ask\n");
    b.clock.pass(199'999us);
    CHECK(b.heard().empty());
    b.clock.pass(1us);
    CHECK(b.heard() == "ask\n");
    CHECK(b.written().empty());
    b.clock.pass(199'999us);
    CHECK(b.written().empty());
    b.clock.pass(1us);
    CHECK(b.written() == "answer\n");
}

TEST_CASE("faults come, change and go while the line is in use, and what they held comes out") {
    Bench b;
    b.open();
    b.say("half a");
    const fault::FaultId id = b.add("delay:to_board,time=60s");
    b.say(" line\nnext\n");  // the rest of the line that passed already is no line of the fault's
    CHECK(b.line->list().at(0).seen == 1);
    CHECK(b.heard() == "half a line\n");
    CHECK(b.line->change(id, fault_from_text("drop:to_screen")));
    CHECK(b.heard().empty());  // not from inside change()
    b.clock.pass(0s);
    CHECK(b.heard() == "next\n");
    b.line->write("lost\n");
    CHECK(b.written().empty());
    CHECK(b.line->remove(id));
    CHECK_FALSE(b.line->remove(id));
    CHECK_FALSE(b.line->change(id, fault_from_text("drop")));
    b.line->write("there\n");
    CHECK(b.written() == "there\n");
    b.add("slow:rate=1B/s");
    b.line->write("slowly\n");
    b.say("too\n");
    b.line->clear();
    CHECK(b.written() == "slowly\n");
    b.clock.pass(0s);
    CHECK(b.heard() == "too\n");
    CHECK(b.line->list().empty());
}

TEST_CASE("a disconnection closes the link, says so, and opens it again at its time") {
    Bench b;
    b.add("disconnect:at=10s,for=2s");
    b.open();
    b.clock.pass(9'999'999us);
    CHECK(b.line->state() == LinkState::up);
    b.clock.pass(1us);
    CHECK(b.line->state() == LinkState::waiting);
    CHECK(b.screen.listener == nullptr);
    CHECK(b.line->path() == "nowhere");
    REQUIRE(b.board.news.size() == 1);
    CHECK(b.board.news[0].find("disconnects") != std::string::npos);
    b.line->write("into the void\n");
    CHECK(b.line->stats().bytes_lost == 14);
    CHECK(b.line->stats().writes_lost == 1);
    b.clock.pass(2s);
    REQUIRE(b.screen.listener != nullptr);
    REQUIRE(b.board.news.size() == 2);
    CHECK(b.board.news[1] == "the line is connected again: a fake");
    b.line->write("back\n");
    CHECK(b.written() == "back\n");
    b.say("hello\n");
    CHECK(b.heard() == "hello\n");
}

TEST_CASE("a line that is written may begin a disconnection: nothing is told from inside write()") {
    Bench b;
    b.add("disconnect:to_screen,after=1,count=1,for=1s");
    b.open();
    b.line->write("one\ntwo\n");
    CHECK(b.written() == "one\n");
    CHECK(b.line->state() == LinkState::waiting);
    CHECK(b.board.news.empty());
    b.clock.pass(0s);
    CHECK(b.board.news.size() == 1);
    b.line->clear();
    b.clock.pass(0s);
    CHECK(b.screen.listener != nullptr);
    CHECK(b.board.news.size() == 2);
}

TEST_CASE("a disconnection at the very start lets the link open first") {
    Bench b;
    b.add("disconnect:for=1s");
    b.open();
    CHECK(b.screen.listener != nullptr);
    b.clock.pass(0s);
    CHECK(b.screen.listener == nullptr);
    b.clock.pass(1s);
    CHECK(b.screen.listener != nullptr);
}

/// A link that cannot be opened for a while.
struct Stubborn final : link::Link {
    FakeLink inner;
    int refusals = 0;
    void open(link::LinkListener& who) override {
        if (refusals > 0) {
            --refusals;
            throw link::LinkError("The port is in use.");
        }
        inner.open(who);
    }
    void close() override { inner.close(); }
    void write(std::string_view message) override { inner.write(message); }
    LinkState state() const override { return inner.state(); }
    const link::LinkStats& stats() const override { return inner.stats(); }
    std::string describe() const override { return inner.describe(); }
    std::string kind() const override { return inner.kind(); }
    std::string path() const override { return inner.path(); }
};

TEST_CASE("a link that does not come back at once is tried again every half second, and told of once") {
    Stubborn stubborn;
    HandClock clock;
    Ear ear;
    FaultyLink line(stubborn, clock, Direction::to_board);
    line.open(ear);
    line.add(fault_from_text("disconnect:for=1s"));
    CHECK(stubborn.inner.listener == nullptr);
    stubborn.refusals = 3;
    clock.pass(1s);
    CHECK(stubborn.refusals == 2);
    clock.pass(1'499'999us);
    CHECK(stubborn.refusals == 0);
    CHECK(stubborn.inner.listener == nullptr);
    clock.pass(1us);
    CHECK(stubborn.inner.listener != nullptr);
    REQUIRE(ear.news.size() == 3);
    CHECK(ear.news[1] == "the line does not come back yet: The port is in use.");
}

TEST_CASE("an error of the first opening is the caller's, and the link stays closed") {
    Stubborn stubborn;
    stubborn.refusals = 1;
    HandClock clock;
    Ear ear;
    FaultyLink line(stubborn, clock, Direction::to_board);
    CHECK_THROWS_AS(line.open(ear), link::LinkError);
    CHECK(line.state() == LinkState::opening);
}

TEST_CASE("a listener that holds gets nothing until it goes on") {
    Bench b;
    b.add("delay:to_board,time=1s");
    b.open();
    b.say("late\n");
    b.line->hold(true);
    b.clock.pass(5s);
    CHECK(b.heard().empty());
    b.line->hold(false);
    b.clock.pass(0s);
    CHECK(b.heard() == "late\n");
}

TEST_CASE("a listener may close or destroy the link from inside its call") {
    for (const bool destroy : {false, true}) {
        Bench b;
        b.add("delay:to_board,time=1s");
        b.open();
        b.board.on_hearing = [&] { destroy ? b.line.reset() : b.line->close(); };
        b.say("one\n");
        b.clock.pass(500ms);
        b.say("two\n");
        b.clock.pass(5s);
        CHECK(b.heard() == "one\n");
        CHECK(b.clock.earliest() == machine::never);
    }
}

TEST_CASE("closed, it opens again as new, with its faults still in force") {
    Bench b;
    b.add("drop:to_board,every=2");
    b.open();
    b.line->close();
    CHECK(b.line->state() == LinkState::opening);
    CHECK(b.screen.listener == nullptr);
    b.open();
    b.say("one\ntwo\nthree\n");
    CHECK(b.heard() == "one\nthree\n");
}

TEST_CASE("what a fault did is said in a sentence") {
    Bench b;
    b.add("drop:to_board,every=2");
    b.add("silence:to_screen,for=1s");
    b.open();
    b.say("one\ntwo\n");
    CHECK(fault_sentence(b.line->list()[0]) == "Fault 1, drop:to_board,every=2, acted once on 2 lines.");
    CHECK(fault_sentence(b.line->list()[1]) == "Fault 2, silence:to_screen, acted once.");
}

TEST_CASE("what a fault of both directions did is said for each, and a disconnection counts once") {
    Bench b;
    b.add("disconnect:at=0s,for=1s");
    b.add("silence:at=0s");
    b.add("drop:every=2,from=2s");
    b.add("cut:every=2,from=2s");
    b.open();
    CHECK(fault_sentence(b.line->list()[3]) == "Fault 4, cut:every=2,from=2s, never acted.");
    b.clock.pass(2s);
    b.say("one\n");
    b.line->write("one\ntwo\nthree\n");
    CHECK(fault_sentence(b.line->list()[0]) == "Fault 1, disconnect:at=0s,for=1s, acted once.");
    CHECK(fault_sentence(b.line->list()[1]) == "Fault 2, silence:at=0s, acted once in each direction.");
    CHECK(fault_sentence(b.line->list()[2]) ==
          "Fault 3, drop:every=2,from=2s, acted once on 3 lines to the screen, acted on none of 1 line to "
          "the board.");
}

}  // namespace
}  // namespace fauxboard::host::test
