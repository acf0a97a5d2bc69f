#include "emulator/host/time_text.h"

#include <doctest/doctest.h>

#include <chrono>
#include <string>

namespace fauxboard::host {
namespace {

using namespace std::chrono_literals;

TEST_CASE("durations with their units") {
    CHECK(parse_duration("500ms") == 500ms);
    CHECK(parse_duration("10s") == 10s);
    CHECK(parse_duration("5min") == 5min);
    CHECK(parse_duration("24h") == 24h);
    CHECK(parse_duration("30d") == 720h);
    CHECK(parse_duration("1.5h") == 90min);
    CHECK(parse_duration("7") == 7s);
    CHECK(parse_duration("250us") == 250us);
    CHECK(parse_duration("0") == 0s);
}

TEST_CASE("what is no duration") {
    for (const char* text :
         {"", "s", "-1s", "1 s", "1sec", "1m", "nan", "inf", "1e9s", "0x10", "99999999999h", "1s "}) {
        CAPTURE(std::string(text));
        CHECK_FALSE(parse_duration(text));
    }
}

TEST_CASE("speeds") {
    CHECK(parse_speed("max")->max);
    CHECK(parse_speed("0.01")->factor == 0.01);
    CHECK(parse_speed("1000000")->factor == 1e6);
    for (const char* text : {"", "0", "0.001", "-1", "1000001", "fast", "nan", "inf", "2x", "MAX"}) {
        CAPTURE(std::string(text));
        CHECK_FALSE(parse_speed(text));
    }
}

}  // namespace
}  // namespace fauxboard::host
