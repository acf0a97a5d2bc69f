#include "emulator/behaviour/nearest.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

using fauxboard::behaviour::nearest;

TEST_CASE("nearest: the name with the fewest edits, if it is near enough") {
    constexpr std::array<std::string_view, 5> names{"heaters.nozzle.target", "heaters.bed.target",
                                                    "position.x", "fans.part", "job.status"};
    CHECK(nearest("heaters.nozle.target", names) == "heaters.nozzle.target");
    CHECK(nearest("heaters.bed.tgt", names) == "heaters.bed.target");
    CHECK(nearest("position.y", names) == "position.x");
    CHECK(nearest("fan.part", names) == "fans.part");
    CHECK(nearest("job.status", names) == "job.status");
    CHECK(nearest("completely different words", names).empty());
    CHECK(nearest("zz", names).empty());
    CHECK(nearest("", names).empty());
    CHECK(nearest("abc", {}).empty());
}

TEST_CASE("nearest: of two that are equally near, the first") {
    constexpr std::array<std::string_view, 2> names{"ab1", "ab2"};
    CHECK(nearest("ab3", names) == "ab1");
}

TEST_CASE("nearest: short words may be wrong in two letters, long ones in half of them") {
    constexpr std::array<std::string_view, 1> word{"abc"};
    CHECK(nearest("axc", word) == "abc");
    CHECK(nearest("axy", word) == "abc");
    CHECK(nearest("wxyz", word).empty());
    constexpr std::array<std::string_view, 1> longer{"abcdefgh"};
    CHECK(nearest("abcdxxxx", longer) == "abcdefgh");
    CHECK(nearest("abcxxxxx", longer).empty());
}

TEST_CASE("nearest: words of any length are safe") {
    const std::string endless(100000, 'x');
    const std::string name(200, 'x');
    const std::array<std::string_view, 1> names{name};
    CHECK(nearest(endless, names) == name);
    CHECK(nearest(name, std::array<std::string_view, 1>{std::string_view(endless)}) == endless);
}
