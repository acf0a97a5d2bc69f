// What a file on a Marlin board's card says of itself: loops, texts.

#include <doctest/doctest.h>

#include "tests/support/marlin.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

std::string repeated(const std::string& line, int times) {
    std::string out;
    for (int i = 0; i < times; ++i)
        out += line;
    return out;
}

/// What the board says while it prints the text.
std::string printed(const std::string& text, double seconds = 10) {
    MarlinBench bench;
    bench.put("A.G", text);
    bench.say("M23 a.g");
    bench.forget();
    bench.say("M24", board::Channel::main, seconds);
    return bench.said();
}

int count(const std::string& text, const std::string& part) {
    int out = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++out;
    return out;
}

}  // namespace

TEST_CASE("Marlin file: loops end, are given up, and are told of when there are none or too many") {
    std::string said = printed("M808\nM118 P0 on\n");
    CHECK(has(said, "echo:!No marker set.\n"));
    CHECK(has(said, "on\r\n"));
    said = printed(repeated("M808 L1\n", 11) + "M118 P0 turn\n" + repeated("M808\n", 10));
    CHECK(count(said, "Too many markers") == 1);
    CHECK(count(said, "turn\r\n") == 1);
    CHECK(count(said, "No marker set") == 0);
    said = printed("M808 L9\nM118 P0 once\nM808 K\nM808\nM118 P0 end\n");
    CHECK(count(said, "once\r\n") == 1);
    CHECK(has(said, "echo:!No marker set.\n"));
    CHECK(has(said, "end\r\n"));
    CHECK(count(printed("M808 L0\nM118 P0 ever\nM808\n", 60), "ever\r\n") > 3);
}

TEST_CASE("Marlin file: M118 takes at most three flags, and what only looks like one is text") {
    CHECK(has(printed("M118 P0 X1 text\n"), "X1 text\r\n"));
    CHECK(has(printed("M118 P0 A/ text\n"), "A/ text\r\n"));
    CHECK(has(printed("M118 P0 A: text\n"), "A: text\r\n"));
    CHECK(has(printed("M118 A1 P0 E0 E1 text\n"), "//E1 text\r\n"));
    CHECK(has(printed("M118 E1 P0\n"), "echo:\r\n"));
}
