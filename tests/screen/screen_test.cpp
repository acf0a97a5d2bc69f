#include <doctest/doctest.h>

#include "protocol/framing.h"
#include "tests/screen/harness.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using machine::from_seconds;

TEST_CASE("power-on: deaf, then its hello; off before") {
    screen::Screen screen(shipped_screen("geeetech-a30t"));
    screen.receive(SimTime{0}, "N-0 L21 P0 S0*63\r\n");
    CHECK(screen.advance(from_seconds(10)) == machine::never);
    screen.power_on(from_seconds(10));
    screen.receive(from_seconds(10.5), "N-0 L21 P0 S0*63\r\n");
    CHECK(screen.advance(from_seconds(11.1)) == from_seconds(11.2));
    screen.advance(from_seconds(20));
    CHECK(screen.time() == from_seconds(11.2));
    CHECK(screen.output() == "log Geeetech LCD OK\r\n");
    CHECK(screen.counters().bytes_unheard == 36);
    CHECK(screen.counters().lines_received == 0);
}

TEST_CASE("L21 is answered 12 to 20 ms after it came, whenever it comes") {
    for (const char* name : {"geeetech-a30t", "geeetech-a30"}) {
        for (int ms = 0; ms < 40; ++ms) {
            Bench bench(name);
            const SimTime at = bench.now() + SimTime{ms * 1000 + 2137};
            bench->receive(at - 18 * bench->profile().line.byte_time, "N-0 L21 P0 S0*63\r\n");
            while (bench->output().empty())
                bench->advance(at + from_seconds(1));
            CHECK(bench->time() - at >= SimTime{12'000});
            CHECK(bench->time() - at <= SimTime{20'100});  // a byte's time of silence, then the tick
            CHECK(bench->output() == (std::string_view(name) == "geeetech-a30t"
                                          ? "N-0 M2134 FW:V1.02.xx*84\r\n"
                                          : "M2134 FW:Vx.37.xx\r\n"));
        }
    }
}

TEST_CASE("15 s without a touch: back to the main page, or to the print status while printing") {
    Bench bench("geeetech-a30");
    bench.press("Control/Speed");
    bench.pass(14.9);
    CHECK(bench->page().path == "Control/Speed");
    bench.press("Speed up");
    bench.pass(14.9);
    CHECK(bench->page().path == "Control/Speed");
    bench.pass(0.2);
    CHECK(bench->page().path == "Main");
    bench.press("Control");
    bench.pass(100);
    CHECK(bench->page().path == "Control");
    bench.take();
    bench.press("Control/Speed");
    bench.say_raw("L3 PS:2 VL:0 MT:1 FT:0 AL:1 ST:1 WF:0 FN:a PG:5 TM:60 LA:1 LC:20");
    CHECK(bench->page().path == "Control/Speed");
    bench.pass(15);
    CHECK(bench->page().path == "Bar chart button");
    CHECK(bench.take() == "M105\r\nM27\r\n");
}

TEST_CASE("what the screen assumes lasts until the board says otherwise") {
    Bench bench;
    bench.press("Fan on");
    CHECK(bench->number("fan.part") == 100);
    CHECK(bench.press("Fan down") == "M106 P0 S252");
    bench.say(
        "L2 B:22.0 /0.0 /0 T0:22.0 /0.0 /0 T1:88.6 /0.0 /0 T2:106.0 /0.0 /0 SD:0 F0:40 F2:50 R:100 FR:0");
    CHECK(bench->number("fan.part") == 40);
    CHECK(bench->get("no.such") == std::nullopt);
    CHECK(bench->profile().sources(*bench->profile().values.find("fan.part")) == "L2");
    CHECK(bench->profile().sources(*bench->profile().values.find("mixing.ratio")) == "L3, L22");
}

TEST_CASE("any split of the bytes gives the same screen") {
    const std::string bytes = protocol::frame("L1 X1.5 Y2 Z3 F4") + "SD printing byte 0/0\r\n\n\r" +
                              protocol::frame("L24 P5 A0.15") + protocol::frame("L21 P0 S0");
    std::string first;
    for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
        Bench bench;
        for (std::size_t at = 0; at < bytes.size(); at += piece) {
            bench->receive(bench.now(), std::string_view(bytes).substr(at, piece));
        }
        bench.pass(0.1);
        std::string all = bench.take() + bench->show("Main") + bench->get("babystep").value_or("");
        for (const auto& judgement : bench->judgements())
            all += judgement.sentence() + '\n';
        if (piece == 1) first = all;
        CHECK(all == first);
    }
}

TEST_CASE("a flood of questions does not grow the screen") {
    Bench bench("geeetech-a30");
    for (int i = 0; i < 20000; ++i) {
        bench->receive(bench.now(), "L21 P0 S0\n");
    }
    for (int i = 0; i < 9000; ++i) {
        bench->press("Bar chart button", bench.now() + from_seconds(i));
    }
    CHECK(bench->output().size() <= 64 * 1024);
    CHECK(bench->counters().output_lost > 0);
    CHECK(bench->judgements().size() <= 512);
}

TEST_CASE("show: pages that are not open, and pages that are not") {
    Bench bench;
    CHECK(bench->show("Control/Sped") ==
          "there is no page \"Control/Sped\"; did you mean \"Control/Speed\"?\n");
    CHECK(bench->show("Control/Speed") ==
          "Speed  (Control/Speed)\n"
          "----------------------\n"
          "Speed 0 %   Fan 0 %\n"
          "[Speed up]  [Speed down]  [Fan on]  [Fan down]  [Fan up]  [Fan off]\n"
          "[Bar chart button]  [Main menu button]  [Return button]\n");
    bench.say("L14  \x1b[2Jboo");
    CHECK(bench->show("Bar chart button").find("\\x1B[2Jboo") != std::string::npos);
}
