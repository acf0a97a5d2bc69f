// What a ChiTu board must not lose or mix up: files that are in use, names that differ by case, requests
// without an end, settings over a restart.

#include <doctest/doctest.h>

#include "protocol/chitu_chunk.h"
#include "tests/support/chitu.h"
#include "tests/support/memory_eeprom.h"
#include "tests/support/resin_bench.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

using Texts = std::vector<std::string>;

const std::string printing = "Error:It's printing now!\r\n";

/// A stick with a file that can be printed, in memory and whole.
struct Stick {
    explicit Stick(ResinBench& bench) { bench.disk.put("Box.ctb", content); }
    std::string content = seed_content().bytes;
};

}  // namespace

TEST_CASE("chitu keep: an upload over the file that is printed is refused, however it is spelled") {
    ResinBench bench;
    const Stick stick(bench);
    bench.ask("M6030 'Box.ctb'");
    REQUIRE(bench.number("job.active") == 1);
    CHECK(bench.send("M28 Box.ctb") == Texts{printing, "ok N:0\r\n"});
    CHECK(bench.send("M28 box.CTB") == Texts{printing, "ok N:0\r\n"});
    CHECK(bench.text("transfer.mode") == "none");
    CHECK(bench.send("M28 other.ctb") == Texts{"ok N:0\r\n"});
    CHECK(bench.send(chunk(0, "abc")) == Texts{"ok\r\n"});
    CHECK(bench.send("M29").back() == "ok N:0\r\n");
    CHECK(*bench.disk.content("Box.ctb") == stick.content);
    bench.ask("M33");
    CHECK(bench.send("M28 box.CTB") == Texts{"ok N:0\r\n"});
}

TEST_CASE("chitu keep: an upload whose file is printed meanwhile does not replace it") {
    ResinBench bench;
    const Stick stick(bench);
    CHECK(bench.send("M28 box.ctb") == Texts{"ok N:0\r\n"});
    CHECK(bench.send(chunk(0, "abc")) == Texts{"ok\r\n"});
    bench.ask("M6030 'Box.ctb'");
    REQUIRE(bench.number("job.active") == 1);
    CHECK(bench.send("M29") == Texts{printing, "ok N:0\r\n"});
    CHECK(*bench.disk.content("Box.ctb") == stick.content);
    CHECK(bench.disk.content("box.ctb") == nullptr);
    CHECK(bench.disk.content("box.ctb.temp") == nullptr);
    CHECK(bench.reaches("job.layer", 2));
}

TEST_CASE("chitu keep: a name that differs by case is the same file, and is replaced") {
    ResinBench bench;
    bench.disk.put("Old.ctb", "old");
    bench.send("M28 OLD.CTB");
    bench.send(chunk(0, "new"));
    CHECK(*bench.disk.content("Old.ctb") == "old");  // not before it is whole
    CHECK(bench.send("M29").front() == "Done saving file!\r\n");
    CHECK(bench.send("M20") ==
          Texts{"Begin file list\r\n", "OLD.CTB 3\r\n", "End file list\r\n", "ok N:0\r\n"});
    CHECK(bench.disk.content("Old.ctb") == nullptr);
    CHECK(*bench.disk.content("OLD.CTB") == "new");
}

TEST_CASE("chitu keep: a file whose name ends like a checksum is not taken for another one") {
    ResinBench bench;
    bench.disk.put("a", "old");
    // Past the line, which takes such an end off.
    machine::Transfer& transfer = bench.board.machine().transfer;
    const machine::SimTime now = machine::from_seconds(bench.now());
    REQUIRE(transfer.upload(now, 5, "a*7"));
    CHECK_FALSE(transfer.existed());
    REQUIRE(transfer.piece(now, 5, true, 0, "new"));
    REQUIRE(transfer.finish(now, 5));
    CHECK(*bench.disk.content("a") == "old");
    REQUIRE(bench.disk.content("a*7") != nullptr);
    CHECK(*bench.disk.content("a*7") == "new");
}

TEST_CASE("chitu keep: a request without a line end is taken after a silence, also by M6040") {
    ResinBench bench;
    CHECK(bench.say("M4004", 0.45) == "");
    CHECK(bench.say("", 0.1) == "ok C:0\r\n");
    CHECK(bench.say("M40", 0.4) == "");  // a slow typist
    CHECK(bench.say("04\r\n", 0.1) == "ok C:0\r\n");
    CHECK(bench.say("", 2) == "");
    bench.ask("M106 S256");
    CHECK(bench.say("M6040 I200", 0.65) == "");
    CHECK(bench.number("resin.led_fan") == 256);
    CHECK(bench.say("", 0.2).starts_with("UART1 init OK\r\n"));
    CHECK(bench.number("resin.led_fan") == 0);
    CHECK(bench.ask("M4004") == "ok C:0\r\n");  // nothing of it is left
}

TEST_CASE("chitu keep: network, its name and the saved settings outlive the power; others do not") {
    MemoryEeprom eeprom;
    {
        ResinBench bench("elegoo-mars-pro", 1000, &eeprom);
        bench.ask("M9003 \"attic net\",\"a secret\"");
        bench.ask("U100 'attic'");
        bench.ask("M8026 I140");
        bench.ask("M8500");
        bench.ask("M8006 I20");
        CHECK(bench.number("config.start_speed") == 20);
    }
    ResinBench again("elegoo-mars-pro", 1000, &eeprom);
    CHECK(again.text("wifi.ssid") == "attic net");
    CHECK(again.number("wifi.enabled") == 1);
    CHECK(again.number("wifi.access_point") == 0);
    CHECK(again.text("resin.network_name") == "attic");
    CHECK(again.ask("M99999").ends_with(" NAME:attic\r\n"));
    CHECK(again.number("config.max_height") == 140);
    CHECK(again.number("config.start_speed") == 30);
    again.ask("M9005 \"mine\",\"word\"");
    again.ask("M8513");  // the settings, not the module's
    ResinBench third("elegoo-mars-pro", 1000, &eeprom);
    CHECK(third.text("wifi.ssid") == "mine");
    CHECK(third.text("resin.wifi_password") == "word");
    CHECK(third.number("wifi.access_point") == 1);
}

TEST_CASE("chitu keep: of a board without a resin part nothing of this is in the EEPROM") {
    MemoryEeprom eeprom;
    ResinBench bench("geeetech-a30t", 1000, &eeprom);
    bench.ask("N-0 M500*77");
    bench.run_for(1);
    CHECK(bench.number("resin.wifi_kind") == 0);
    CHECK((!eeprom.image || eeprom.image->find("resin.") == std::string::npos));
}
