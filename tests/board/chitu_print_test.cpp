// A print on a ChiTu board, as the programs see it that watch one: M4000, M27, M4006 and M114 at each step.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "tests/support/board_driver.h"
#include "tests/support/chitu.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

struct Print {
    explicit Print(const char* profile = "elegoo-mars-pro") : driver(profile, make()) {
        put_seed_stick(stick);
        driver.run_until(2);
    }
    BoardDriver::Setup make() {
        BoardDriver::Setup setup;
        setup.services.sd = &stick;
        return setup;
    }
    std::string ask(const std::string& line) {
        const std::size_t before = driver.bytes().size();
        driver.feed(line + "\r\n");
        driver.run_for(0.05);
        return driver.bytes().substr(before);
    }
    struct Status {
        unsigned long place = 0, bytes = 0, halted = 0;
    };
    /// As mariner reads it.
    Status status() {
        const std::string reply = ask("M4000");
        const std::size_t at = reply.find(" D:");
        REQUIRE(at != std::string::npos);
        Status out;
        REQUIRE(std::sscanf(reply.c_str() + at, " D:%lu/%lu/%lu ", &out.place, &out.bytes, &out.halted) == 3);
        return out;
    }
    void start() { REQUIRE(ask(std::string("M6030 '") + seed_file + "'") == "ok N:0\r\n"); }
    /// Of this moment, and not of the last thing that happened.
    double number(const char* path) {
        driver.board().refresh(machine::from_seconds(driver.now()));
        return driver.number(path);
    }
    /// Runs on until so many layers have been exposed.
    void to_layer(int layers) {
        while (driver.number("job.layer") < layers) {
            REQUIRE(driver.number("job.active") == 1);
            driver.run_for(0.1);
        }
    }
    void to_phase(const std::string& phase) {
        for (int i = 0; driver.text("resin.phase") != phase; ++i) {
            REQUIRE(i < 20000);
            driver.run_for(0.05);
        }
    }

    MemoryDisk stick;
    BoardDriver driver;
};

const std::string size_text = std::to_string(seed_file_bytes);

}  // namespace

TEST_CASE("chitu print: before the first layer the place is 0, and the file is named") {
    Print print;
    CHECK(print.ask("M4006") == "ok 'none'\r\n");
    print.start();
    const auto status = print.status();
    CHECK(status.place == 0);
    CHECK(status.bytes == seed_file_bytes);
    CHECK(status.halted == 0);
    CHECK(print.ask("M27") == "SD printing byte 0/" + size_text + "\r\nok N:0\r\n");
    CHECK(print.ask("M4006") == std::string("ok '") + seed_file + "'\r\n");
    CHECK(print.driver.text("resin.phase") == "homing");
    CHECK(print.number("resin.led") == 0);
}

TEST_CASE("chitu print: all through a print the place is a layer's end, M27 and M4000 agree, and it ends") {
    Print print;
    print.start();
    std::set<unsigned long> allowed{0};
    const auto& ends = seed_content().layer_ends;
    allowed.insert(ends.begin(), ends.end());
    std::set<unsigned long> seen;
    unsigned long last = 0;
    while (print.number("job.active") == 1) {
        const auto status = print.status();
        if (status.bytes == 0) {
            break;  // over between the two
        }
        const std::string byte = print.ask("M27");
        CHECK(allowed.count(status.place) == 1);
        CHECK(status.place >= last);
        CHECK(status.bytes == seed_file_bytes);
        if (print.number("job.byte") == static_cast<double>(status.place)) {
            CHECK(byte ==
                  "SD printing byte " + std::to_string(status.place) + "/" + size_text + "\r\nok N:0\r\n");
        }
        last = status.place;
        seen.insert(status.place);
        print.driver.run_for(0.4);
        REQUIRE(print.driver.now() < 3600);
    }
    CHECK(seen == allowed);
    CHECK(print.ask("M4000").find(" D:0/0/1 \r\n") != std::string::npos);
    CHECK(print.ask("M27") == "Error:It's not printing now!\r\nok N:0\r\n");
    CHECK(print.ask("M4006") == std::string("ok '") + seed_file + "'\r\n");
    CHECK(print.ask("M114") == "ok C: X:0.000000 Y:0.000000 Z:155.000000 E:0.000000\r\n");
    CHECK(print.number("resin.motor") == 0);
}

TEST_CASE("chitu print: a host that has seen the last layer begins its next print at once") {
    Print print;
    print.start();
    const double layers = seed_wishes().layers;
    while (print.number("job.layer") < layers) {
        print.driver.run_for(0.1);
        REQUIRE(print.driver.now() < 3600);
        if (print.number("job.layer") < layers) {
            CHECK(print.ask("M23 " + std::string(seed_file)).starts_with("Error:It's printing now!"));
        }
    }
    CHECK(print.ask("M23 " + std::string(seed_file)).find("File selected") != std::string::npos);
    CHECK(print.ask("M24").starts_with("ok N:"));
    print.driver.run_for(1);
    CHECK(print.number("job.status") == 1);
    CHECK(print.number("job.layer") == 0);
}

TEST_CASE("chitu print: on its way to the first homing the platform is not told below 0") {
    Print print;
    print.ask("G28");
    for (int i = 0; i < 200; ++i) {
        print.driver.run_for(0.5);
        CHECK(print.ask("M114").find("Z:-") == std::string::npos);
    }
    CHECK(print.number("resin.homed") == 1);
}

TEST_CASE(
    "chitu print: each layer is exposed at its height as long as its record says, and dark before as long") {
    Print print;
    print.start();
    const ResinFile wishes = seed_wishes();
    double dark_since = -1;
    for (std::uint32_t n = 0; n < wishes.layers; ++n) {
        CAPTURE(n);
        while (print.number("resin.led") == 0) {
            print.driver.run_for(0.001);
        }
        const double lit = print.driver.now();
        const double z = print.number("resin.layer_z");
        CHECK(z == doctest::Approx(wishes.layer_height_mm * static_cast<float>(n + 1)).epsilon(0.001));
        CHECK(print.number("resin.z") == doctest::Approx(z).epsilon(1e-6));
        CHECK(print.number("resin.light") == 255);
        CHECK(print.number("resin.led_fan") == 256);
        if (dark_since >= 0) {
            CHECK(lit - dark_since >= wishes.light_off_s - 0.002);
        }
        while (print.number("resin.led") == 1) {
            print.driver.run_for(0.001);
        }
        dark_since = print.driver.now();
        const float exposure = n < wishes.bottom_layers ? wishes.bottom_exposure_s : wishes.exposure_s;
        CHECK(dark_since - lit == doctest::Approx(exposure).epsilon(0.001));
        CHECK(print.number("job.layer") == n + 1);
        // Version 3 says each layer's lift.
        const double top = z + wishes.lift_mm + static_cast<double>(n);
        double highest = 0;
        while (n + 1 < wishes.layers && print.driver.text("resin.phase") != "approaching") {
            print.driver.run_for(0.001);
            highest = std::max(highest, print.number("resin.z"));
        }
        if (n + 1 < wishes.layers) {
            CHECK(highest == doctest::Approx(top).epsilon(0.001));
        }
    }
}

TEST_CASE(
    "chitu print: a pause is answered at once, shows after 3 to 5 s, lifts, and the rest is exposed later") {
    Print print;
    print.start();
    print.to_layer(1);
    print.to_phase("exposing");
    const double lit = print.driver.now();
    CHECK(print.ask("M25 I0") == "ok N:0\r\n");
    CHECK(print.status().halted == 0);
    const double asked = lit;
    while (print.status().halted == 0) {
        print.driver.run_for(0.01);
        REQUIRE(print.driver.now() < asked + 6);
    }
    const double shown = print.driver.now() - asked;
    CHECK(shown >= 2.9);
    CHECK(shown <= 5.2);
    const auto status = print.status();
    CHECK(status.place == seed_content().layer_ends[0]);
    CHECK(status.bytes == seed_file_bytes);
    CHECK(print.number("resin.led") == 0);
    const double left = print.number("resin.exposure_left");
    CHECK(left > 10);
    CHECK(left < 20);
    print.driver.run_for(30);
    CHECK(print.number("resin.z") == doctest::Approx(0.1 + 30).epsilon(0.01));
    CHECK(print.ask("M27").starts_with("SD printing byte "));
    CHECK(print.number("job.status") == 2);

    CHECK(print.ask("M24") == "ok N:0\r\n");
    CHECK(print.status().halted == 0);
    print.to_phase("exposing");
    const double again = print.driver.now();
    CHECK(print.number("resin.z") == doctest::Approx(0.1).epsilon(0.01));
    print.to_layer(2);
    CHECK(print.driver.now() - again == doctest::Approx(left).epsilon(0.03));
    CHECK(print.status().place == seed_content().layer_ends[1]);
}

TEST_CASE("chitu print: a stopped print is over at once, dark, and can be begun anew") {
    Print print;
    print.start();
    print.to_layer(1);
    print.to_phase("exposing");
    CHECK(print.ask("M33") == "ok N:0\r\n");
    CHECK(print.number("resin.led") == 0);
    CHECK(print.ask("M4000").find(" D:0/0/1 \r\n") != std::string::npos);
    CHECK(print.ask("M33") == "Error:It's not printing now!\r\nok N:0\r\n");
    print.driver.run_for(120);
    CHECK(print.number("resin.z") == doctest::Approx(155));
    print.start();
    print.to_layer(2);
    CHECK(print.status().place == seed_content().layer_ends[1]);
}

TEST_CASE("chitu print: a paused print can be stopped") {
    Print print;
    print.start();
    print.to_layer(1);
    print.ask("M25");
    print.driver.run_for(10);
    CHECK(print.status().halted == 1);
    CHECK(print.ask("M33") == "ok N:0\r\n");
    CHECK(print.status().bytes == 0);
}

TEST_CASE("chitu print: what M8489 says is done at the end") {
    struct Row {
        int action;
        double z;
        double motor;
    };
    for (const Row& row : {Row{0, -1, 0}, Row{1, -1, 1}, Row{2, 0, 0}, Row{3, 155, 0}}) {
        CAPTURE(row.action);
        Print print;
        print.ask("M8489 P" + std::to_string(row.action));
        print.ask("M8510");
        print.start();
        while (print.number("job.active") == 1) {
            print.driver.run_for(1);
        }
        CHECK(print.number("resin.motor") == row.motor);
        const double z = print.number("resin.z");
        if (row.z >= 0) {
            CHECK(z == doctest::Approx(row.z));
        } else {
            CHECK(z == doctest::Approx(0.3 + 6 + 5).epsilon(0.01));
        }
    }
}

TEST_CASE("chitu print: M23 and M24 start one as M6030 does, also by the last part of the name") {
    Print print;
    CHECK(print.ask(std::string("M23 /") + seed_file).find("File selected") != std::string::npos);
    CHECK(print.ask("M24") == "ok N:0\r\n");
    CHECK(print.status().bytes == seed_file_bytes);
}

TEST_CASE("chitu print: a stick pulled out pauses the print at its next layer; back again, it goes on") {
    Print print;
    print.start();
    print.to_layer(2);
    const std::size_t before = print.driver.bytes().size();
    print.driver.world("card out");
    print.driver.run_for(60);
    CHECK(print.driver.bytes().substr(before) == "//Disk init fail!\r\n");
    CHECK(print.status().halted == 1);
    CHECK(print.status().place == seed_content().layer_ends[1]);
    print.ask("M24");  // still no stick
    print.driver.run_for(1);
    CHECK(print.status().halted == 1);
    print.driver.world("card in");
    print.driver.run_for(5);
    print.ask("M24");
    CHECK(print.status().halted == 0);
    print.to_layer(4);
    CHECK(print.status().place == seed_content().layer_ends[3]);
}

TEST_CASE("chitu print: any steps of time give the same talk") {
    const auto talk = [](double step) {
        Print print;
        print.start();
        for (int i = 0; i * step < 200; ++i) {
            print.driver.run_for(step);
        }
        print.driver.run_until(250);
        return print.ask("M4000") + print.ask("M27") + print.ask("M114");
    };
    const std::string whole = talk(200);
    CHECK(talk(0.37) == whole);
    CHECK(talk(7) == whole);
}

TEST_CASE("chitu print: moves by hand wait for a pause") {
    Print print;
    print.start();
    print.to_phase("exposing");
    const double z = print.number("resin.z");
    print.ask("G0 Z10 F600 I0");
    print.driver.run_for(1);
    CHECK(print.number("resin.z") == doctest::Approx(z));
    CHECK(!print.driver.notices().empty());
}

TEST_CASE("chitu print: the photon's M4000 counts seconds while it prints, and only then") {
    Print print("anycubic-photon");
    print.start();
    print.driver.run_for(10);
    CHECK(print.ask("M4000").ends_with(" T:10\r\n"));
    print.ask("M33");
    CHECK(print.ask("M4000").ends_with(" D:0/0/1 T:0\r\n"));
}
