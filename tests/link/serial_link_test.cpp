#include <doctest/doctest.h>

#include "fake_serial.h"
#include "helpers.h"

using namespace fauxboard::link;
using namespace fauxboard::link::test;

namespace {

constexpr const char* device_name = "/dev/ttyFAKE0";

/// Opens, speaks both ways (again and again, until both sides have heard), closes. The sentence of the
/// LinkError, if that is how it ended.
std::string talk(FakeSerial& fake, Recorder& heard) {
    EventLoop loop;
    const auto link = make_serial_link(loop, device_name, 115200, FakeSerial::api());
    const std::string error = link_error([&] { link->open(heard); });
    if (!error.empty()) {
        CHECK(link->state() == LinkState::opening);
        return error;
    }
    std::string said;
    int turn = 0;
    CHECK(run_until(loop, [&] {
        if (turn++ % 20 == 0) {
            say(fake.device->master.get(), "M105\n");
            link->write("ok\n");
        }
        said += take(fake.device->master.get());
        return contains(heard.bytes, "M105\n") && contains(said, "ok\n") && link->state() == LinkState::up;
    }));
    run_ready(loop);
    link->close();
    return {};
}

}  // namespace

TEST_CASE("serial: both ways") {
    FakeSerial fake;
    Recorder heard;
    CHECK(talk(fake, heard).empty());
    CHECK(heard.state_letters() == "u");
    CHECK(contains(heard.last_why(), "/dev/ttyFAKE0 is open at 115200 baud"));
    CHECK(fake.opens == 1);
    CHECK(fake.ports == 0);
    CHECK_FALSE(fake.slave_open());
}

TEST_CASE(
    "serial: whichever call fails, it is a sentence or a port that is opened again, and nothing leaks") {
    int nth = 1;
    int errors = 0;
    int retries = 0;
    for (;; ++nth) {
        CAPTURE(nth);
        FakeSerial fake;
        fake.fail_at = nth;
        Recorder heard;
        const std::string error = talk(fake, heard);
        CHECK(fake.ports == 0);
        CHECK_FALSE(fake.slave_open());
        if (!fake.failed()) break;
        if (!error.empty()) {
            ++errors;
            CHECK(contains(error, device_name));
        }
        if (heard.state_letters() == "uwu") {
            ++retries;
            CHECK(fake.opens == 2);
            CHECK(contains(heard.states[1].second, "/dev/ttyFAKE0 vanished (Input/output error)"));
        }
    }
    // The nine calls of opening; then reading and writing (closing too, but that is nobody's loss).
    CHECK(errors == 9);
    CHECK(retries >= 2);
    CHECK(nth > 11);
}

TEST_CASE("serial: what refuses to open says what to do") {
    FakeSerial fake;
    Recorder heard;
    fake.fail_at = 2;
    std::string expected;
    SUBCASE("permission") {
        fake.fail_with = EACCES;
        expected = "dialout";
    }
    SUBCASE("busy") {
        fake.fail_with = EBUSY;
        expected = "in use by another program";
    }
    SUBCASE("gone") {
        fake.fail_with = ENOENT;
        expected = "There is no serial port /dev/ttyFAKE0.";
    }
    SUBCASE("anything else") {
        fake.fail_with = ENXIO;
        expected = "/dev/ttyFAKE0 cannot be opened: No such device or address.";
    }
    const std::string error = talk(fake, heard);
    CAPTURE(error);
    CHECK(contains(error, expected));
}

TEST_CASE("serial: a port that does not exist, by the real library") {
    EventLoop loop;
    Recorder heard;
    const auto link = make_port_link(loop, "/dev/ttyNOSUCH99", 115200);
    CHECK(link->kind() == "serial");
    CHECK(link->path() == "/dev/ttyNOSUCH99");
    CHECK(contains(link_error([&] { link->open(heard); }), "There is no serial port /dev/ttyNOSUCH99."));
    const auto speedless = make_port_link(loop, "/dev/ttyNOSUCH99", 0);
    CHECK(contains(link_error([&] { speedless->open(heard); }), "0 baud is not a speed"));
}

TEST_CASE("serial: an adapter that is pulled out is waited for and used again when it is back") {
    FakeSerial fake;
    EventLoop loop;
    Recorder heard;
    const auto link = make_serial_link(loop, device_name, 115200, FakeSerial::api());
    link->open(heard);
    say(fake.device->master.get(), "last");
    REQUIRE(run_until(loop, [&] { return heard.bytes == "last"; }));
    fake.pull_out();
    REQUIRE(run_until(loop, [&] { return heard.state_letters() == "uw"; }));
    CHECK(contains(heard.last_why(), "vanished"));
    CHECK(fake.ports == 0);
    CHECK_FALSE(fake.slave_open());
    link->write("lost");
    CHECK(link->stats().writes_lost == 1);
    const int calls_before = fake.calls;
    REQUIRE(run_until(loop, [&] { return fake.calls >= calls_before + 2; }));  // tried in vain
    CHECK(heard.state_letters() == "uw");
    fake.plug_in();
    REQUIRE(run_until(loop, [&] { return heard.state_letters() == "uwu"; }));
    CHECK(contains(heard.last_why(), "/dev/ttyFAKE0 is back"));
    link->write("hello");
    std::string said;
    CHECK(run_until(loop, [&] { return (said += take(fake.device->master.get())) == "hello"; }));
}

TEST_CASE("serial: reading nothing is not the end of the port") {
    FakeSerial fake;
    EventLoop loop;
    Recorder heard;
    SerialApi api = FakeSerial::api();
    static int empty_reads;
    empty_reads = 3;
    static SerialApi inner;
    inner = api;
    api.nonblocking_read = [](sp_port* port, void* data, std::size_t size) {
        return empty_reads-- > 0 ? SP_OK : inner.nonblocking_read(port, data, size);
    };
    const auto link = make_serial_link(loop, device_name, 115200, api);
    link->open(heard);
    say(fake.device->master.get(), "late");
    CHECK(run_until(loop, [&] { return heard.bytes == "late"; }));
    CHECK(heard.state_letters() == "u");
}
