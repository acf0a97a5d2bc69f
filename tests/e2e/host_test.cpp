// The board's USB side with the real program: a host program on one pseudo-terminal, the screen on the other.

#include <filesystem>

#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

TEST_CASE("a host prints through the board while the screen shows it, and both are recorded") {
    const TemporaryFolder folder;
    const std::string recording = folder.file("talk.jsonl");
    Program program({"run", "--no-pacing", "-q", "--speed", "50", "--host-pty=" + folder.file("usb"),
                     "--record", recording});
    const auto ready = program.ready();
    CHECK(ready["host"]["link"] == "pty");
    CHECK(ready["host"]["name"] == folder.file("usb"));
    CHECK(std::filesystem::read_symlink(folder.file("usb")) == ready["host"]["path"].get<std::string>());
    Peer screen(ready["path"]);
    Peer host(ready["host"]["path"]);
    host.say("N0 M110 N0*125\n");
    CHECK(host.lines().find("ok") == "ok");
    host.say("M105\n");
    CHECK(host.lines().find("ok T:").starts_with("ok T:22.3 /0.0 B:22.0 /0.0 T0:22.3 /0.0 @:0 B@:0"));
    host.say("M117 Hello there\n");
    CHECK(contains(screen.lines().find("L14"), "L14  Hello there"));
    host.say("G28\n");
    CHECK(host.lines().find("echo:busy") == "echo:busy: processing");
    CHECK(host.lines().find("ok") == "ok");
    host.say("G1 X50 Y60 F6000\nM400\n");
    CHECK(contains(screen.lines().find("X50.000 Y60.000"), "L1 X50.000 Y60.000"));
    host.say("N9 M105*1\n");
    CHECK(host.lines().find("Resend") == "Resend: 1");
    CHECK(program.stop() == 0);
    CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(folder.file("usb"))));
    const Result said = run({"decode", recording});
    CHECK(said.code == 0);
    CHECK(contains(said.out, "board → host"));
    CHECK(contains(said.out, "host → board"));
}

TEST_CASE("a host over TCP, and mistakes of the options") {
    Program program({"run", "-q", "--no-pacing", "--host-tcp", "127.0.0.1:0"});
    const auto ready = program.ready();
    REQUIRE(ready["host"]["link"] == "tcp");
    Peer host(ready["host"]["path"]);
    host.say("M115\n");
    CHECK(contains(host.lines().find("FIRMWARE_NAME"), "no real printer"));
    CHECK(program.stop() == 0);
    check_mistakes({
        {{"run", "--host-pty", "--host-tcp", "127.0.0.1:0"}, usage, "excludes"},
        {{"run", "--host-port", "/dev/does-not-exist"}, no_port, "/dev/does-not-exist"},
        {{"run", "--host-baud", "9600"}, usage, "--host-port"},
    });
}

}  // namespace
}  // namespace fauxboard::e2e
