// Marlin boards with the real program: the vectors over a pseudo-terminal, and boards with one line only.

#include <filesystem>
#include <fstream>

#include "emulator/link/line_speed.h"
#include "tests/e2e/program.h"
#include "tests/e2e/raw_peer.h"
#include "tests/support/marlin.h"

namespace fauxboard::e2e {
namespace {

using testing::MarlinVector;

/// Says nothing about the vector, and comes back behind all of its answer.
constexpr const char* mark = "//end of it\r\nok\n";

/// What a host sends ahead of an answer may be thrown away with a bad line; then only the last may be bad.
bool can_be_sent_at_once(const MarlinVector& vector) {
    const std::size_t resend = vector.reply.find("Resend: ");
    return vector.send.size() == 1 || resend == std::string::npos;
}

TEST_CASE("Marlin: the vectors over a pseudo-terminal, byte for byte") {
    const TemporaryFolder folder;
    std::ofstream(folder.file("TEST.GCO")) << std::string(1233, ';') << '\n';
    int sent = 0;
    for (const MarlinVector& vector : testing::marlin_vectors()) {
        if (!vector.world.empty() || !can_be_sent_at_once(vector)) {
            continue;
        }
        CAPTURE(vector.name);
        Program program(
            {"run", "-q", "--profile", testing::marlin_profile(), "--pty", "--sd", folder.file(".")});
        RawPeer peer(program.ready()["path"]);
        peer.until("echo:SD card ok\n");
        for (const std::string& line : vector.send) {
            peer.say(line + "\n");
        }
        CHECK(peer.until(vector.reply).empty());
        peer.say("M118 A1 end of it\n");
        CHECK(peer.until(mark).empty());
        ++sent;
    }
    CHECK(sent > 30);
}

TEST_CASE("Marlin: without a screen's line the USB side is all there is, and with one both are") {
    Program alone({"run", "-q", "--profile", "marlin", "--host-pty"});
    const auto ready = alone.ready();
    CHECK(ready["link"] == "none");
    CHECK(ready["host"]["link"] == "pty");
    RawPeer host(ready["host"]["path"]);
    host.say("M92\n");
    CHECK(contains(host.until("ok\n"), "  M92 X80.00 Y80.00 Z400.00 E500.00\n"));
    CHECK(alone.stop() == 0);

    Program both({"run", "-q", "--profile", "marlin", "--pty", "--host-pty"});
    const auto two = both.ready();
    CHECK(two["link"] == "pty");
    RawPeer screen(two["path"]);
    RawPeer usb(two["host"]["path"]);
    screen.until("echo:SD card ok\n");
    usb.say("M118 P1 for the screen\n");
    CHECK(screen.until("\r\n") == "for the screen");
    CHECK(both.stop() == 0);

    Program usual({"run", "-q", "--host-pty"});
    CHECK(usual.ready()["link"] == "pty");
    CHECK(usual.stop() == 0);
}

TEST_CASE(
    "Marlin: a host at a wrong speed reads what a real line would bring it, and the right one finds all "
    "well") {
    Program program({"run", "-q", "--profile", "marlin", "--host-pty", "--exact-baud", "--speed", "10"});
    RawPeer host(program.ready()["host"]["path"]);
    host.say("M155 S1\n");
    const std::string report = " T:22.00 /0.00 B:22.00 /0.00 @:0 B@:0\n";
    CHECK_FALSE(contains(host.until(report), "silence"));
    host.set_speed(B57600);
    CHECK_FALSE(contains(host.until(link::as_heard(report, 115200, 57600)), "silence"));
    host.set_speed(B115200);
    host.say("M92\n");
    CHECK_FALSE(contains(host.until("  M92 X80.00 Y80.00 Z400.00 E500.00\nok\n"), "silence"));
    CHECK(program.stop() == 0);
}

TEST_CASE("a host that comes later hears nothing of the start, only what it asks for") {
    struct Row {
        Args board;
        std::string ask;
        std::string answer;
    };
    for (const Row& row :
         {Row{{"--profile", "chitu-base", "--pty"}, "M4002\n", "ok V4.3.3_LCDC"},
          Row{{"--profile", "chitu-base", "--tcp", "127.0.0.1:0"}, "M4002\n", "ok V4.3.3_LCDC"},
          Row{{"--profile", "marlin", "--host-pty"}, "M118 me\n", "me"},
          Row{{"--profile", "geeetech-a30t", "--host-pty"}, "M18\n", "ok"}}) {
        CAPTURE(row.board.at(1));
        const TemporaryFolder folder;
        const std::string control = folder.file("control");
        Args all{"run", "-q", "--control", control};
        all.insert(all.end(), row.board.begin(), row.board.end());
        Program program(all);
        const auto ready = program.ready();
        // It has said what it says at its start.
        REQUIRE(run({"ctl", control, "advance", "5"}).code == 0);
        Peer host(std::string((ready.contains("host") ? ready["host"] : ready)["path"]));
        host.say(row.ask);
        CHECK(host.lines().next() == row.answer);
        CHECK(program.stop() == 0);
    }
}

}  // namespace
}  // namespace fauxboard::e2e
