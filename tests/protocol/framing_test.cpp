#include "protocol/framing.h"

#include <doctest/doctest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

using namespace fauxboard::protocol;
using namespace std::string_literals;

namespace {

FrameFault fault_of(std::string_view line, ChecksumPolicy policy) {
    return unframe(line, policy).fault;
}

}  // namespace

TEST_CASE("the checksum is the XOR of all bytes") {
    CHECK(xor_checksum("") == 0);
    CHECK(xor_checksum("N-0 G28") == 62);
    CHECK(xor_checksum("N-0 M27") == 59);
    CHECK(xor_checksum("\xFF\xFF") == 0);
    CHECK(xor_checksum("\xFF") == 255);
    CHECK(xor_checksum(std::string(1001, 'A')) == 'A');
}

TEST_CASE("the four styles of a frame") {
    CHECK(frame("G28") == "N-0 G28*62\r\n");
    CHECK(frame("SD printing byte 0/0", FrameStyle::bare) == "SD printing byte 0/0\r\n");
    CHECK(frame("L14 Pausing... please try again later.", FrameStyle::star_only) ==
          "N-0 L14 Pausing... please try again later.*\r\n");
    CHECK(frame("L14 file select succeed!:a.gco", FrameStyle::unfinished) ==
          "N-0 L14 file select succeed!:a.gco\r\n");
    CHECK(frame("", FrameStyle::bare) == "\r\n");
    CHECK(frame("L18 P26 S1") == "N-0 L18 P26 S1*0\r\n");  // one digit
}

TEST_CASE("a frame that does not fit is not written") {
    std::array<char, 12> exact{};
    CHECK(write_frame(exact, "G28", FrameStyle::framed) == 12);
    CHECK(std::string_view(exact.data(), 12) == "N-0 G28*62\r\n");
    std::array<char, 11> small{};
    CHECK(write_frame(small, "G28", FrameStyle::framed) == 0);
    CHECK(small[0] == '\0');
    CHECK(write_frame({}, "", FrameStyle::bare) == 0);
}

TEST_CASE("a frame is taken off") {
    const Unframed line = unframe("N-0 L24 P5 A0.15*7", ChecksumPolicy::required);
    CHECK(line.body == "L24 P5 A0.15");
    CHECK(line.prefixed);
    CHECK(line.line_number == 0);
    CHECK(line.has_checksum);
    CHECK(line.fault == FrameFault::none);
}

TEST_CASE("a doubled prefix is one command and its XOR covers both") {
    const Unframed line = unframe("N-0 N-0 M2134 FW:V1.02.xx*39", ChecksumPolicy::required);
    CHECK(line.body == "M2134 FW:V1.02.xx");
    CHECK(line.fault == FrameFault::none);
    CHECK(fault_of("N-0 M2134 FW:V1.02.xx*39", ChecksumPolicy::required) == FrameFault::checksum_wrong);
}

TEST_CASE("line numbers other than -0") {
    const auto number = [](std::string_view line) {
        return unframe(line, ChecksumPolicy::ignored).line_number;
    };
    CHECK(number("N12 G28") == 12);
    CHECK(number("N-1 G28") == -1);
    CHECK(number("N+7 G28") == 7);
    CHECK(number("N1 N2 G28") == 2);
    CHECK(number("N99999999999999 G28") == 2147483647);
    CHECK(number("N-99999999999999 G28") == -2147483647 - 1);
    CHECK(unframe("N12G28", ChecksumPolicy::ignored).body == "G28");
    CHECK(unframe("N-0", ChecksumPolicy::ignored).body.empty());
    CHECK(unframe("N-0*83", ChecksumPolicy::required).body.empty());
    for (const std::string_view line : {"Name", "N", "N-", "N1abc", "n-0 G28"}) {
        const Unframed whole = unframe(line, ChecksumPolicy::ignored);
        CHECK_FALSE(whole.prefixed);
        CHECK(whole.body == line);
    }
}

TEST_CASE("the three policies judge bad checksums") {
    using enum ChecksumPolicy;
    using enum FrameFault;
    struct Row {
        std::string_view line;
        FrameFault required, if_present;
        std::string_view required_body, lenient_body;
    };
    const Row rows[] = {
        {"N-0 G28*62", none, none, "G28", "G28"},
        {"N-0 G28*63", checksum_wrong, checksum_wrong, "G28", "G28"},
        {"N-0 G28*062", none, none, "G28", "G28"},
        {"N-0 G28*62 ", none, none, "G28", "G28"},
        {"N-0 G28", checksum_missing, none, "G28", "G28"},
        {"G28", checksum_missing, none, "G28", "G28"},
        {"N-0 G28*", checksum_malformed, none, "G28", "G28"},
        {"N-0 G28*256", checksum_malformed, checksum_malformed, "G28", "G28"},
        {"N-0 G28*0062", checksum_malformed, checksum_malformed, "G28", "G28"},
        {"N-0 G28*99999999999999999999", checksum_malformed, checksum_malformed, "G28", "G28"},
        {"N-0 G28*6x", checksum_malformed, none, "G28", "G28*6x"},
        {"N-0 G28*-2", checksum_malformed, none, "G28", "G28*-2"},
        {"", checksum_missing, none, "", ""},
        {"*0", none, none, "", ""},
    };
    for (const Row& row : rows) {
        CAPTURE(row.line);
        CHECK(fault_of(row.line, required) == row.required);
        CHECK(fault_of(row.line, if_present) == row.if_present);
        CHECK(fault_of(row.line, ignored) == none);
        CHECK(unframe(row.line, required).body == row.required_body);
        CHECK(unframe(row.line, if_present).body == row.lenient_body);
        CHECK(unframe(row.line, ignored).body == row.lenient_body);
    }
}

TEST_CASE("a bare line may carry a checksum over itself") {
    const std::string good = "M105*" + std::to_string(xor_checksum("M105"));
    CHECK(fault_of(good, ChecksumPolicy::required) == FrameFault::none);
    CHECK(fault_of(good, ChecksumPolicy::if_present) == FrameFault::none);
    CHECK(fault_of("M105*1", ChecksumPolicy::if_present) == FrameFault::checksum_wrong);
}

TEST_CASE("the last star starts the checksum") {
    const std::string body = "M23 a*b*7.gco";
    const std::string line = frame(body);
    const Unframed back =
        unframe(std::string_view(line).substr(0, line.size() - 2), ChecksumPolicy::required);
    CHECK(back.body == body);
    CHECK(back.fault == FrameFault::none);
}

TEST_CASE("an A30 screen's M23 keeps the checksum of our L7 line") {
    const Unframed line = unframe("M23 testpattern.gcode*82", ChecksumPolicy::if_present);
    CHECK(line.body == "M23 testpattern.gcode");
    CHECK(line.fault == FrameFault::none);
    // A framed one has its own; and only M23 is excused.
    CHECK(fault_of("N-0 M23 testpattern.gcode*82", ChecksumPolicy::if_present) == FrameFault::checksum_wrong);
    CHECK(fault_of("M230 x*82", ChecksumPolicy::if_present) == FrameFault::checksum_wrong);
}

TEST_CASE("log lines are never framed") {
    for (const auto policy :
         {ChecksumPolicy::required, ChecksumPolicy::if_present, ChecksumPolicy::ignored}) {
        const Unframed line = unframe("log Geeetech LCD OK", policy);
        CHECK(line.body == "log Geeetech LCD OK");
        CHECK(line.fault == FrameFault::none);
        CHECK(unframe("log stars *12", policy).body == "log stars *12");
    }
    CHECK(fault_of("logger", ChecksumPolicy::required) == FrameFault::checksum_missing);
    CHECK(fault_of("N-0 log x", ChecksumPolicy::required) == FrameFault::checksum_missing);
}

TEST_CASE("NULs at the ends and blanks in front go, blanks of the body stay") {
    CHECK(unframe("\0\0N-0 G28*62\0"s, ChecksumPolicy::required).body == "G28");
    CHECK(unframe("\0\0N-0 G28*62\0"s, ChecksumPolicy::required).fault == FrameFault::none);
    CHECK(unframe("\0\0"s, ChecksumPolicy::ignored).body.empty());
    CHECK(unframe("  N-0 G28*62", ChecksumPolicy::required).fault == FrameFault::none);
    CHECK(unframe("M106 P0 S252 ", ChecksumPolicy::if_present).body == "M106 P0 S252 ");
}

TEST_CASE("property: what is framed comes off again, and one flipped bit is found") {
    std::mt19937 random(20240817);
    std::uniform_int_distribution<int> any_byte(1, 255);
    std::uniform_int_distribution<std::size_t> any_length(0, 400);
    for (int round = 0; round < 3000; ++round) {
        std::string body = "L14";  // so that a body cannot look like a prefix
        for (std::size_t i = any_length(random); i > 0; --i) {
            const char byte = static_cast<char>(any_byte(random));
            body += byte == '\r' || byte == '\n' ? '*' : byte;
        }
        std::string line = frame(body);
        line.resize(line.size() - 2);
        const Unframed back = unframe(line, ChecksumPolicy::required);
        REQUIRE(back.body == body);
        REQUIRE(back.fault == FrameFault::none);
        REQUIRE(back.has_checksum);

        const std::size_t at = std::uniform_int_distribution<std::size_t>(4, body.size() + 3)(random);
        line[at] = static_cast<char>(line[at] ^ 1);
        REQUIRE(unframe(line, ChecksumPolicy::required).fault == FrameFault::checksum_wrong);
    }
}

TEST_CASE("property: random bytes are taken without harm, and the body lies inside the line") {
    std::mt19937 random(7);
    const std::string_view alphabet("N-0 *19GM.\0\xFF\t", 13);
    std::uniform_int_distribution<std::size_t> pick(0, alphabet.size() - 1);
    std::size_t judged = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string line(std::uniform_int_distribution<std::size_t>(0, 24)(random), ' ');
        for (char& byte : line) {
            byte = alphabet[pick(random)];
        }
        for (const auto policy :
             {ChecksumPolicy::required, ChecksumPolicy::if_present, ChecksumPolicy::ignored}) {
            const Unframed got = unframe(line, policy);
            REQUIRE(got.body.data() >= line.data());
            REQUIRE(got.body.data() + got.body.size() <= line.data() + line.size());
            if (policy == ChecksumPolicy::ignored) REQUIRE(got.fault == FrameFault::none);
            if (got.fault != FrameFault::none) ++judged;
        }
    }
    CHECK(judged > 10000);
}
