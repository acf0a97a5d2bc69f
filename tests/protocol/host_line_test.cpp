#include "protocol/host_line.h"

#include <doctest/doctest.h>

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
        {"G1 X1 ; to the right", "G1 X1", false, 0, false, false},
        {"M105*10", "M105", false, 0, true, false},
        {"M117 5*3=15", "M117 5*3=15", false, 0, false, false},
        {"N5 G1 X1*", "G1 X1", true, 5, true, false},
        {"N5 G1 X1*x", "G1 X1", true, 5, true, false},
        {"N5 G1 X1*9999999999", "G1 X1", true, 5, true, false},
        {"N-1 M110*12", "M110", true, -1, true, false},
        {"N", "N", false, 0, false, false},
        {"Nothing", "Nothing", false, 0, false, false},
        {"N99999999999999999999 G1", "G1", true, 2147483647, false, false},
        {"n7 g1 x1", "g1 x1", true, 7, false, false},
        {"", "", false, 0, false, false},
        {"*", "*", false, 0, false, false},
        {"; only a remark", "", false, 0, false, false},
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

TEST_CASE("host line: the order of Marlin's complaints") {
    CHECK(judge_host_line(unframe_host_line(numbered(5, "G1")), 4) == HostLineFault::none);
    CHECK(judge_host_line(unframe_host_line(numbered(5, "G1")), 5) == HostLineFault::wrong_number);
    CHECK(judge_host_line(unframe_host_line("N5 G1*1"), 5) == HostLineFault::wrong_number);
    CHECK(judge_host_line(unframe_host_line("N5 G1*1"), 4) == HostLineFault::wrong_checksum);
    CHECK(judge_host_line(unframe_host_line("N5 G1"), 4) == HostLineFault::no_checksum);
    CHECK(judge_host_line(unframe_host_line("G1*5"), 4) == HostLineFault::no_number);
    CHECK(judge_host_line(unframe_host_line("G1"), 4) == HostLineFault::none);
    CHECK(judge_host_line(unframe_host_line(numbered(70, "M110")), 4) == HostLineFault::none);
    CHECK(judge_host_line(unframe_host_line("N70 M110*3"), 4) == HostLineFault::wrong_checksum);
}

TEST_CASE("host line: M110 may carry the number behind it") {
    CHECK(number_set(unframe_host_line("M110 N7")) == 7);
    CHECK_FALSE(number_set(unframe_host_line("M110")));
    CHECK_FALSE(number_set(unframe_host_line("M1101 N7")));
    CHECK_FALSE(number_set(unframe_host_line("G1 N7")));
}

TEST_CASE("host line: any single byte changed on the way is noticed") {
    const std::string good = numbered(1234, "G1 X10.5 Y-3.25 E0.0123");
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            std::string bad = good;
            bad[i] = static_cast<char>(static_cast<unsigned char>(bad[i]) ^ (1U << bit));
            CAPTURE(bad);
            const HostLine line = unframe_host_line(bad);
            const bool noticed = judge_host_line(line, 1233) != HostLineFault::none;
            // A damaged N leaves a line without number, whose command begins with no letter of a code.
            CHECK((noticed || (!line.numbered && line.body[0] != 'G' && line.body[0] != 'M')));
        }
    }
}
