#include "protocol/host_line.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include "protocol/framing.h"

using namespace fauxboard::protocol;

namespace {

std::string numbered(int number, const std::string& body) {
    const std::string line = "N" + std::to_string(number) + " " + body;
    return line + "*" + std::to_string(xor_checksum(line));
}

}  // namespace

TEST_CASE("host line: number, command and checksum come apart, whatever is missing") {
    struct Row {
        const char* line;
        const char* body;
        bool is_numbered;
        std::int64_t number;
        bool has_checksum;
        bool right;
    };
    // "N0 M110 N0*125" is what OctoPrint sends first.
    const Row rows[] = {
        {"N0 M110 N0*125", "M110 N0", true, 0, true, true},
        {"N3 G1 X1*99", "G1 X1", true, 3, true, false},
        {"N12 M105", "M105", true, 12, false, false},
        {"G1 X1", "G1 X1", false, 0, false, false},
        {"  G28  ", "G28", false, 0, false, false},
        {"M105*10", "M105", false, 0, true, false},
        {"M117 5*3=15", "M117 5*3=15", false, 0, false, false},
        {"N5 G1 X1*", "G1 X1", true, 5, true, false},
        {"N5 G1 X1*x", "G1 X1", true, 5, true, false},
        {"N5 G1 X1*9999999999", "G1 X1", true, 5, true, false},
        {"N-1 M110*12", "M110", true, -1, true, false},
        {"N", "N", true, 0, false, false},
        {"Nothing", "Nothing", true, 0, false, false},
        {"N99999999999999999999 G1", "G1", true, 2147483647, false, false},
        {"n7 g1 x1", "n7 g1 x1", false, 0, false, false},
        {"", "", false, 0, false, false},
        {"*", "*", false, 0, false, false},
        {"N1 M105*38", "M105", true, 1, true, true},
        {"N2 M105 *5", "M105", true, 2, true, true},
        {" N5 M105*34", "M105", true, 5, true, true},
        {"N5 M105*034", "M105", true, 5, true, true},
        {"N+5 M105*9", "M105", true, 5, true, true},
        {"N 5 M105*2", "N 5 M105", true, 5, true, true},
        {"N0 M110N70*106", "M110N70", true, 70, true, true},
        {"N70 M110*20", "M110", true, 70, true, true},
        {"M110 N3N4 M211*37", "M110 N3N4 M211", false, 0, true, false},
        {"\tM105", "\tM105", false, 0, false, false},
    };
    for (const Row& row : rows) {
        CAPTURE(row.line);
        const HostLine line = unframe_host_line(row.line);
        CHECK(line.body == row.body);
        CHECK(line.numbered == row.is_numbered);
        CHECK(line.number == row.number);
        CHECK(line.has_checksum == row.has_checksum);
        CHECK(line.checksum_right == row.right);
    }
}

TEST_CASE("host line: what the line reader keeps") {
    struct Row {
        const char* bytes;
        const char* kept;
    };
    const Row rows[] = {
        {"  G28", "G28"},
        {"G1 X1 ; to the right", "G1 X1 "},
        {"; only a remark", ""},
        {"M117 a\\;b;c", "M117 a;b"},
        {"M117 a\\\\b", "M117 a\\b"},
        {"M105\b4", "M104"},
        {"\b\bM105", "M105"},
        {"M117 x\\", "M117 x"},
        {"", ""},
    };
    std::array<char, 512> room;
    for (const Row& row : rows) {
        CAPTURE(row.bytes);
        CHECK(read_host_line(row.bytes, room, 95) == row.kept);
    }
    CHECK(read_host_line(std::string(600, 'B'), room, 95).size() == 95);
    CHECK(read_host_line("\\" + std::string(600, 'B'), room, 95).size() == 95);
}

TEST_CASE("host line: the order of Marlin's complaints") {
    const HostLineRules old{.judges_unnumbered = true};
    const HostLineRules young{.drops_repeated = true};
    const auto judge = [&](const std::string& line, std::int64_t last, const HostLineRules& rules) {
        return judge_host_line(unframe_host_line(line, rules), last, rules);
    };
    for (const HostLineRules& rules : {old, young}) {
        CHECK(judge(numbered(5, "G1"), 4, rules) == HostLineFault::none);
        CHECK(judge(numbered(5, "G1"), 7, rules) == HostLineFault::wrong_number);
        CHECK(judge("N5 G1*1", 7, rules) == HostLineFault::wrong_number);
        CHECK(judge("N5 G1*1", 4, rules) == HostLineFault::wrong_checksum);
        CHECK(judge("N5 G1", 4, rules) == HostLineFault::no_checksum);
        CHECK(judge("G1", 4, rules) == HostLineFault::none);
        CHECK(judge(numbered(70, "M110"), 4, rules) == HostLineFault::none);
        CHECK(judge("N70 M110*3", 4, rules) == HostLineFault::wrong_checksum);
    }
    CHECK(judge("G1*5", 4, old) == HostLineFault::no_number);
    CHECK(judge("G1*5", 4, young) == HostLineFault::none);
    for (const std::int64_t last : {5, 6}) {
        CHECK(judge(numbered(5, "G1"), last, old) == HostLineFault::wrong_number);
        CHECK(judge(numbered(5, "G1"), last, young) == HostLineFault::repeated);
    }
}

TEST_CASE("host line: a command ends at its checksum, or at its first star") {
    CHECK(unframe_host_line("M117 a*b").body == "M117 a*b");
    CHECK(unframe_host_line("M117 a*b", {.first_star_ends = true}).body == "M117 a");
    CHECK(unframe_host_line(numbered(1, "M117 a*b")).body == "M117 a*b");
    CHECK(unframe_host_line(numbered(1, "M117 a *b"), {.first_star_ends = true}).body == "M117 a");
}

TEST_CASE("host line: any single byte changed on the way is noticed") {
    const std::string good = numbered(1234, "G1 X10.5 Y-3.25 E0.0123");
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            std::string bad = good;
            bad[i] = static_cast<char>(static_cast<unsigned char>(bad[i]) ^ (1U << bit));
            CAPTURE(bad);
            const HostLine line = unframe_host_line(bad);
            const bool noticed = judge_host_line(line, 1233, {}) != HostLineFault::none;
            // A damaged N leaves a line without number, whose command begins with no letter of a code.
            CHECK((noticed || (!line.numbered && line.body[0] != 'G' && line.body[0] != 'M')));
        }
    }
}
