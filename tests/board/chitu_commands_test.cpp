// A .gcode file of a resin board's stick: it is carried out, line by line, and not printed.

#include <doctest/doctest.h>

#include <string>

#include "tests/support/resin_bench.h"

using namespace fauxboard;
using namespace fauxboard::testing;

TEST_CASE("chitu: a file of settings is carried out by M6030, and by M23 and M24") {
    for (const bool selected : {false, true}) {
        CAPTURE(selected);
        ResinBench bench("anycubic-photon");
        bench.disk.put("mode.GCODE", "; settings\r\n\r\n  M8026 I1200 ; travel\nN5 M8006 I20*1\nM8500");
        bench.run_for(1);
        if (selected) {
            CHECK(bench.ask("M23 mode.GCODE").find("File selected") != std::string::npos);
            CHECK(bench.ask("M24") == "ok N:0\r\n");
        } else {
            CHECK(bench.ask("M6030 \"mode.GCODE\"") == "ok N:0\r\n");
        }
        bench.run_for(1);
        CHECK(bench.number("config.max_height") == 1200);
        CHECK(bench.number("config.start_speed") == 20);
        // It is no print, and nobody was told more.
        CHECK(bench.number("job.active") == 0);
        CHECK(bench.ask("M27") == "Error:It's not printing now!\r\n");
        CHECK(bench.ask("M6030 \"mode.GCODE\"") == "ok N:0\r\n");
        // What M8500 kept outlives a reset.
        bench.run_for(1);
        bench.world("board reset");
        bench.run_for(5);
        CHECK(bench.number("config.max_height") == 1200);
    }
}

TEST_CASE("chitu: the backup that M8512 writes is a file that brings everything back") {
    ResinBench bench;
    bench.ask("M8026 I140");
    bench.ask("M8006 I21");
    bench.ask("M8512 backup.gcode");
    bench.ask("M8513");
    REQUIRE(bench.number("config.max_height") != 140);
    CHECK(bench.ask("M6030 'backup.gcode'") == "ok N:0\r\n");
    bench.run_for(2);
    CHECK(bench.number("config.max_height") == 140);
    CHECK(bench.number("config.start_speed") == 21);
}

TEST_CASE("chitu: moves of such a file wait for each other; it is stopped by M112 and by pulling the stick") {
    const auto run = [](const char* how) {
        ResinBench bench;
        bench.disk.put("dance.gcode", "G28\nG0 Z20 F600\nM8026 I1200\nG0 Z1 F600\n");
        bench.run_for(1);
        CHECK(bench.ask("M6030 'dance.gcode'") == "ok N:0\r\n");
        bench.run_for(0.5);
        CHECK(bench.number("config.max_height") != 1200);  // not before the platform is up there
        // Meanwhile no other file is begun, and requests are answered.
        CHECK(bench.ask("M6030 'dance.gcode'").starts_with("Error:It's printing now!"));
        CHECK(bench.ask("M114").starts_with("ok C: X:"));
        if (how == std::string_view("M112")) {
            bench.ask(how);
        } else if (*how != '\0') {
            bench.world(how);
        }
        bench.run_for(600);
        return bench.number("config.max_height");
    };
    CHECK(run("") == 1200);
    CHECK(run("M112") != 1200);
    CHECK(run("card out") != 1200);
}

TEST_CASE("chitu: a file that starts itself, one without end, and one of any bytes come to no harm") {
    ResinBench bench;
    bench.disk.put("self.gcode", "M6030 'self.gcode'\nM6032 'self.gcode'\nM8026 I1200\n");
    bench.disk.put("vast.gcode", 50'000'000'000ULL,
                   [](std::uint64_t, std::span<char> out) { std::fill(out.begin(), out.end(), '\n'); });
    bench.disk.put("junk.gcode", std::string(2000, '\xFF') + "\n" + std::string("\0\0M8026\0I7\n", 11));
    bench.run_for(1);
    bench.ask("M6030 'self.gcode'");
    bench.run_for(10);
    CHECK(bench.number("config.max_height") == 1200);
    bench.ask("M6030 'junk.gcode'");
    bench.run_for(10);
    bench.disk.bytes_read = 0;
    CHECK(bench.ask("M6030 'vast.gcode'") == "ok N:0\r\n");
    bench.run_for(1);
    CHECK(bench.disk.bytes_read <= 2000 * 512);
    CHECK(bench.ask("M114").starts_with("ok C: X:"));
    // An empty file is none, as ever.
    bench.disk.put("empty.gcode", "");
    CHECK(bench.ask("M6030 'empty.gcode'").starts_with("Error:"));
}
