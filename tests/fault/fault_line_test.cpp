#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/fault/helpers.h"

using namespace fauxboard::fault;
using fauxboard::machine::never;
using namespace std::string_literals;

TEST_CASE("without faults everything passes at once, also half lines, and nothing is held") {
    LineRig rig;
    const std::string all = "half\0 a\r"s;
    CHECK(rig.push(all) == all);
    CHECK(rig.line.held() == 0);
    CHECK(rig.line.advance(ms(1)) == never);
    std::string bytes(1 << 20, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<char>(i * 7 % 256);
    }
    CHECK(rig.push(bytes, 4096) == bytes);
}

TEST_CASE("a fault that comes to nothing changes no byte of anything") {
    std::string bytes = "a\rb\nc\r\n\r\n\n\rd\n\0e\0f\r\n\0"s + std::string(10'000, 'x') + "\r\n" +
                        std::string(4096, 'y') + "\r" + std::string(4096, 'z') + "\nend\r";
    for (const std::size_t chunk : {1UL, 2UL, 5UL, 1000UL, 100'000UL}) {
        CHECK(spoiled("drop:probability=0", bytes, Direction::to_screen, chunk) == bytes);
        CHECK(spoiled("delay:time=0ms", bytes, Direction::to_screen, chunk) == bytes);
        CHECK(spoiled("slow:rate=100kB/s", bytes, Direction::to_screen, chunk) == bytes);
    }
}

TEST_CASE("under a fault half a line waits 100 ms for its end, then it passes") {
    LineRig rig;
    rig.add("drop:probability=0");
    CHECK(rig.push("half").empty());
    CHECK(rig.line.advance(rig.now) == ms(100));
    rig.pass(ms(60));
    CHECK(rig.push(" a").empty());
    CHECK(rig.pass(ms(99)).empty());
    CHECK(rig.pass(ms(1)) == "half a");
    CHECK(rig.push(" line") == " line");
    CHECK(rig.push("\r").empty());
    CHECK(rig.pass(ms(100)) == "\r");
    CHECK(rig.push("\nnext\n") == "\nnext\n");
    CHECK(rig.status().seen == 2);
}

TEST_CASE("overdue work is done before new bytes are taken") {
    LineRig rig;
    rig.add("drop:every=2");
    rig.push("one");
    rig.now = ms(500);  // nobody called at 100 ms
    CHECK(rig.push("\ntwo\n") == "one\n");
}

TEST_CASE("an endless line passes in parts and is one line") {
    LineRig rig;
    rig.add("drop:every=2");
    const std::string big(20'000, 'x');
    CHECK(rig.push(big + "\n" + big + "\n" + "three\n", 999) == big + "\nthree\n");
    CHECK(rig.status().seen == 3);
}

TEST_CASE("a fault that is added in the midst of a line begins with the next one") {
    LineRig rig;
    CHECK(rig.push("half") == "half");
    rig.add("drop");
    CHECK(rig.push(" a line\r\nlost\r\n") == " a line\r\n");
    CHECK(rig.status().seen == 1);
}

TEST_CASE("a fault whose time comes in the midst of a line begins with the next one") {
    LineRig rig;
    rig.add("drop:from=1s");
    CHECK(rig.push("half") == "half");
    rig.pass(ms(1000));
    CHECK(rig.push(" a line\r\nlost\r\n") == " a line\r\n");
}

TEST_CASE("at acts once, on the first line from then on") {
    LineRig rig;
    rig.add("drop:at=1s");
    CHECK(rig.push("one\n") == "one\n");
    rig.pass(ms(1500));
    CHECK(rig.push("two\nthree\n") == "three\n");
    CHECK(rig.status().over);
}

TEST_CASE("every, after and probability work together") {
    LineRig rig;
    rig.add("drop:after=2,every=3,count=2");
    CHECK(rig.push("1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n") == "1\n2\n3\n4\n6\n7\n9\n10\n11\n12\n");
    std::size_t dropped = 0;
    const std::string out = spoiled("drop:probability=0.25,seed=11", frames(2000));
    dropped = 2000 - static_cast<std::size_t>(std::count(out.begin(), out.end(), '\n'));
    CHECK(dropped > 400);
    CHECK(dropped < 600);
}

TEST_CASE("faults act in the order of their ids, a changed one in its place and anew") {
    LineRig rig;
    const FaultId first = rig.add("drop:every=2");
    rig.add("nul_burst:bytes=1,every=2");
    CHECK(rig.push("a\nb\nc\nd\n") == "a\n\0c\n"s);
    CHECK(rig.line.change(rig.now, first, fault_from_text("duplicate")));
    CHECK(rig.push("e\n") == "e\n\0e\n"s);
    CHECK(rig.line.list(rig.now)[0].seen == 1);
    CHECK(rig.line.list(rig.now)[1].seen == 4);
    CHECK_FALSE(rig.line.change(rig.now, 9, fault_from_text("drop")));
    CHECK_FALSE(rig.line.remove(rig.now, 9));
}

TEST_CASE("ids are never used again") {
    LineRig rig;
    const FaultId first = rig.add("drop");
    CHECK(rig.line.remove(rig.now, first));
    CHECK(rig.add("drop") != first);
    rig.line.clear(rig.now);
    CHECK(rig.add("drop") == first + 2);
}

TEST_CASE("more than 32 faults are refused with a sentence") {
    LineRig rig;
    for (std::size_t i = 0; i < FaultLine::most_faults; ++i) {
        rig.add("drop:probability=0");
    }
    CHECK_THROWS_WITH_AS(
        rig.add("drop"),
        "found 32 faults on this line already; expected fewer: remove one before adding another",
        FaultSpecError);
    CHECK(rig.push("on\n") == "on\n");
    CHECK(rig.line.change(rig.now, 3, fault_from_text("drop")));
}

TEST_CASE("times that go back or never end do no harm") {
    LineRig rig;
    rig.add("delay:time=1s");
    rig.line.push(ms(5000), "one\n");
    rig.line.push(ms(1000), "two\n");
    CHECK(rig.line.advance(ms(2000)) == ms(6000));
    rig.line.advance(never);
    CHECK(rig.line.output() == "one\ntwo\n");
    rig.line.push(never, "three\n");
    rig.line.clear(never);
    CHECK(rig.line.output() == "one\ntwo\nthree\n");
}

TEST_CASE("the status as JSON") {
    LineRig rig;
    rig.add("drop:every=2,count=1");
    rig.push("a\nb\nc\n");
    CHECK(status_to_json(rig.status()) == Json::parse(R"({"id":1,"fault":{"kind":"drop","every":2,
        "count":1},"seen":2,"acted":1,"over":true})"));
}
