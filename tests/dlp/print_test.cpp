// Prints in virtual time: the process, its pauses, its end, and what it must never do.

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/dlp_bench.h"

namespace fauxboard::dlp::test {
namespace {

using testing::DlpBench;
using testing::make_panel_pws;
using testing::MemoryStick;
using testing::PanelPws;

MemoryStick stick_with(const PanelPws& wishes) {
    MemoryStick stick;
    stick.files = {{"s1.pws", make_panel_pws(wishes)}};
    return stick;
}

PanelPws few(std::uint32_t layers) {
    PanelPws wishes;
    wishes.layers = layers;
    return wishes;
}

void start(DlpBench& bench) {
    REQUIRE(bench.run_to(Event::board_ready, 3));
    REQUIRE(bench.board.print_file("s1.pws", bench.now));
}

double height(const DlpBench& bench) {
    return bench.board.platform.position(bench.now) -
           static_cast<double>(bench.board.settings.general.zero_pos_mm);
}

/// The lamp is never on while the platform moves, and the platform never lower than what it has printed.
void watch(DlpBench& bench) {
    bench.each_step = [&bench, printed = -1.0]() mutable {
        const auto& board = bench.board;
        CHECK_FALSE((board.lamp.on() && board.platform.busy()));
        if (board.lamp.on()) {
            printed = height(bench);
        }
        CHECK((!board.print.active() || height(bench) > printed - 1e-6));
    };
}

TEST_CASE("DLP print: an hour that is counted in the middle of an exposure makes it no shorter") {
    PanelPws wishes = few(1);
    wishes.bottom_exposure_s = 7'000;
    BoardConfig config;
    config.firmware = Firmware::v008;
    DlpBench bench(config, stick_with(wishes));
    start(bench);
    REQUIRE(bench.run_to(Event::print_exposing));
    REQUIRE(bench.run_to(Event::print_exposed));
    REQUIRE(bench.now > from_seconds(3'600));
    CHECK(bench.board.lamp.last() == from_seconds(7'000));
    CHECK(bench.board.watch.exposure_error_ms < 1);
}

TEST_CASE("DLP print: two layers, from homing to the end") {
    DlpBench bench({}, stick_with(few(2)));
    watch(bench);
    start(bench);
    CHECK(bench.board.print.state() == PrintState::homing_fast);
    CHECK(bench.board.print.layer() == 1);
    CHECK(bench.board.print.elapsed(bench.now) == SimTime{0});
    REQUIRE(bench.run_to(Event::print_layer_begun));
    CHECK(bench.board.print.state() == PrintState::move_to_layer);
    CHECK(bench.board.print.homed());
    CHECK(bench.board.panel.awake());
    CHECK(bench.board.lamp.fan());
    REQUIRE(bench.run_to(Event::print_exposing));
    const SimTime lit_at = bench.now;
    CHECK(height(bench) == doctest::Approx(0.05));
    CHECK(bench.board.panel.showing());
    CHECK(bench.board.panel.fpga().command() == 0xC0);
    REQUIRE(bench.run_to(Event::print_exposed));
    CHECK(bench.now - lit_at == ms(40'000));
    CHECK(bench.board.print.layer() == 2);
    CHECK(bench.board.print.state() == PrintState::lift);
    REQUIRE(bench.run_to(Event::print_finishing));
    CHECK_FALSE(bench.board.lamp.on());
    CHECK_FALSE(bench.board.panel.awake());
    CHECK(bench.board.panel.fpga().command() == 0x20);
    CHECK(bench.board.print.state() == PrintState::last_lift);
    const SimTime over = bench.now;
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(bench.board.platform.position(bench.now) == doctest::Approx(175));
    CHECK(bench.board.sound().last == ms(800));
    CHECK_FALSE(bench.board.print.active());
    bench.run_until(std::max(bench.now, over + ms(10'000)));
    CHECK_FALSE(bench.board.lamp.fan());
    CHECK(bench.board.counters.led_s == 80);
    CHECK(bench.board.counters.display_s == 80);
    CHECK(bench.board.counters.print_s > 80);
    CHECK(bench.count(Event::print_displayed) == 2);
    CHECK(bench.notes.empty());
}

TEST_CASE("DLP print: the panel shows what the file has, line by line") {
    DlpBench bench({}, stick_with(few(3)));
    std::uint32_t shown = 0;
    bench.each_event = [&](Event event) {
        if (event != Event::print_displayed) {
            return;
        }
        for (unsigned y = 0; y < panel_lines; y += 7) {
            const auto line = bench.board.panel.fpga().line(0, y);
            for (std::uint32_t x = 0; x < panel_columns; x += 5) {
                REQUIRE(lit(line, x) == testing::panel_pws_lit(shown, 0, x, y));
            }
        }
        ++shown;
    };
    start(bench);
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(shown == 3);
}

TEST_CASE("DLP print: with antialiasing each picture gets its part of the light") {
    PanelPws wishes = few(2);
    wishes.antialiasing = 4;
    DlpBench bench({}, stick_with(wishes));
    watch(bench);
    start(bench);
    std::vector<SimTime> lights;
    bench.each_event = [&](Event event) {
        if (event == Event::print_exposed) lights.push_back(bench.board.lamp.last());
    };
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(lights == std::vector<SimTime>(8, ms(10'000)));
    CHECK(bench.count(Event::print_displayed) == 8);
}

TEST_CASE("DLP print: estimates as the board reckons") {
    DlpBench bench({}, stick_with({}));
    REQUIRE(bench.run_to(Event::board_ready, 3));
    REQUIRE(bench.board.view("s1.pws"));
    const PrintFile& file = *bench.board.viewed().file;
    CHECK(file.estimate_s(bench.board.settings.motor, Firmware::v001) == 2205);
    PanelPws soft;
    soft.antialiasing = 4;
    DlpBench again({}, stick_with(soft));
    REQUIRE(again.run_to(Event::board_ready, 3));
    REQUIRE(again.board.view("s1.pws"));
    CHECK(again.board.viewed().file->estimate_s(again.board.settings.motor, Firmware::v001) == 2409);
    // 0.08 counts the pictures behind the first, and loads each in 0.362 s.
    CHECK(again.board.viewed().file->estimate_s(again.board.settings.motor, Firmware::v008) == 2205 + 108);
}

TEST_CASE("DLP print: a pause while a layer is exposed waits for its end, then goes up and stands") {
    DlpBench bench({}, stick_with(few(3)));
    watch(bench);
    start(bench);
    REQUIRE(bench.run_to(Event::print_exposing));
    const SimTime lit_at = bench.now;
    bench.run(5);
    REQUIRE(bench.board.print.set_paused(true, bench.now));
    CHECK(bench.board.lamp.on());
    REQUIRE(bench.run_to(Event::print_exposed));
    CHECK(bench.now - lit_at == ms(40'000));
    const SimTime elapsed = bench.board.print.elapsed(bench.now);
    REQUIRE(bench.run_to(Event::print_pause_reached));
    CHECK(height(bench) == doctest::Approx(45.10));
    CHECK(bench.board.print.standing());
    bench.run(100);
    CHECK(bench.board.print.elapsed(bench.now) == elapsed);
    CHECK(bench.board.motor.state() == MotorState::run);
    REQUIRE(bench.board.print.set_paused(false, bench.now));
    CHECK(bench.board.print.state() == PrintState::drop);
    CHECK(bench.board.platform.speed() == doctest::Approx(-20.0 / 3));
    REQUIRE(bench.run_to(Event::print_exposing));
    CHECK(height(bench) == doctest::Approx(0.10));
    CHECK(bench.board.print.layer() == 2);
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(bench.count(Event::print_exposed) == 3);
}

TEST_CASE("DLP print: paused and resumed in every state, it is whole all the same") {
    for (const PrintState when :
         {PrintState::homing_fast, PrintState::homing_slow, PrintState::move_to_layer,
          PrintState::light_pause, PrintState::light, PrintState::lift, PrintState::drop}) {
        CAPTURE(to_string(when));
        DlpBench bench({}, stick_with(few(3)));
        watch(bench);
        start(bench);
        while (bench.board.print.state() != when) {
            bench.run(0.05);
        }
        REQUIRE(bench.board.print.set_paused(true, bench.now));
        CHECK_FALSE(bench.board.print.set_paused(true, bench.now));
        REQUIRE(bench.run_to(Event::print_pause_reached));
        CHECK_FALSE(bench.board.lamp.on());
        bench.run(30);
        REQUIRE(bench.board.print.set_paused(false, bench.now));
        REQUIRE(bench.run_to(Event::print_finished));
        CHECK(bench.count(Event::print_exposed) == 3);
        CHECK(bench.count(Event::print_finished) == 1);
    }
}

TEST_CASE("DLP print: resumed while it still rises, it rises first") {
    DlpBench bench({}, stick_with(few(2)));
    start(bench);
    REQUIRE(bench.run_to(Event::print_exposed));
    bench.run(0.5);
    REQUIRE(bench.board.print.set_paused(true, bench.now));
    CHECK(bench.board.print.state() == PrintState::pause_lift);
    bench.run(4);
    REQUIRE(bench.board.print.set_paused(false, bench.now));
    CHECK(bench.board.print.state() == PrintState::pause_lift);
    double highest = 0;
    bench.each_step = [&] { highest = std::max(highest, height(bench)); };
    REQUIRE(bench.run_to(Event::print_exposing));
    CHECK(highest == doctest::Approx(45.10));
}

TEST_CASE("DLP print: stopped in every state, it is dark at once and goes up") {
    for (const PrintState when : {PrintState::homing_fast, PrintState::move_to_layer, PrintState::light_pause,
                                  PrintState::light, PrintState::lift, PrintState::drop}) {
        CAPTURE(to_string(when));
        DlpBench bench({}, stick_with(few(2)));
        watch(bench);
        start(bench);
        while (bench.board.print.state() != when) {
            bench.run(0.05);
        }
        const bool homed = bench.board.print.homed();
        const double from = bench.board.platform.position(bench.now);
        REQUIRE(bench.board.print.stop(bench.now));
        CHECK_FALSE(bench.board.lamp.on());
        CHECK_FALSE(bench.board.panel.awake());
        CHECK(bench.board.panel.fpga().command() == 0x20);
        CHECK_FALSE(bench.board.print.stop(bench.now));
        if (bench.count(Event::print_cancelled) == 0) {
            REQUIRE(bench.run_to(Event::print_cancelled));
        }
        CHECK(bench.board.platform.position(bench.now) == doctest::Approx(homed ? 175.0 : from));
        // A homing by hand afterwards prints nothing.
        REQUIRE(bench.board.print.home(bench.now));
        REQUIRE(bench.run_to(Event::platform_homed));
        CHECK_FALSE(bench.board.print.active());
    }
}

TEST_CASE("DLP print: a switch that never closes ends homing after the whole way") {
    BoardConfig config;
    config.platform.start_mm = 200;
    config.platform.travel_mm = 250;
    DlpBench bench(config, stick_with(few(1)));
    PlatformTrouble trouble;
    trouble.lower = SwitchState::never_closes;
    bench.board.platform.set_trouble(trouble, bench.now);
    start(bench);
    const SimTime began = bench.now;
    REQUIRE(bench.run_to(Event::print_homing_failed));
    CHECK(bench.board.platform.position(bench.now) == doctest::Approx(-182));
    CHECK(to_seconds(bench.now - began) == doctest::Approx(182.0 / 6 + 6.0 / 20).epsilon(0.001));
    CHECK_FALSE(bench.board.print.homed());
    CHECK_FALSE(bench.board.print.active());
    CHECK(bench.count(Event::print_exposing) == 0);
    CHECK(bench.board.sound().last == ms(800));
    trouble.lower = SwitchState::never_opens;
    bench.board.platform.set_trouble(trouble, bench.now);
    REQUIRE(bench.board.print.home(bench.now));
    REQUIRE(bench.run_to(Event::platform_homing_failed));
    bench.board.platform.set_trouble({}, bench.now);
    REQUIRE(bench.board.print.home(bench.now));
    REQUIRE(bench.run_to(Event::platform_homed));
    CHECK(bench.board.platform.true_position(bench.now) == doctest::Approx(0).epsilon(0.001));
}

TEST_CASE("DLP print: the stick is pulled: the print pauses in the dark, and goes on when it is back") {
    DlpBench bench({}, stick_with(few(3)));
    watch(bench);
    start(bench);
    REQUIRE(bench.run_to(Event::print_exposing));
    bench.stick.in = false;
    bench.board.stick_changed();
    REQUIRE(bench.run_to(Event::print_read_error));
    CHECK(bench.board.print.paused());
    REQUIRE(bench.run_to(Event::print_pause_reached));
    CHECK_FALSE(bench.board.panel.showing());
    REQUIRE(bench.board.print.set_paused(false, bench.now));
    CHECK(bench.board.print.paused());  // not without the stick
    bench.stick.in = true;
    bench.board.stick_changed();
    REQUIRE(bench.board.print.set_paused(false, bench.now));
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(bench.count(Event::print_exposed) == 3);
}

TEST_CASE("DLP print: read errors, too; and by its quirk the board goes on in the dark") {
    DlpBench bench({}, stick_with(few(2)));
    start(bench);
    REQUIRE(bench.run_to(Event::print_exposed));
    bench.stick.read_errors = true;
    REQUIRE(bench.run_to(Event::print_read_error));
    bench.stick.read_errors = false;
    REQUIRE(bench.run_to(Event::print_pause_reached));
    REQUIRE(bench.board.print.set_paused(false, bench.now));
    REQUIRE(bench.run_to(Event::print_finished));

    BoardConfig config;
    config.quirks.ignore_read_errors = true;
    DlpBench slip(config, stick_with(few(2)));
    start(slip);
    REQUIRE(slip.run_to(Event::print_exposing));
    slip.stick.read_errors = true;
    bool dark = true;
    slip.each_event = [&](Event event) {
        dark = event == Event::print_exposing ? !slip.board.panel.showing() && dark : dark;
    };
    REQUIRE(slip.run_to(Event::print_finished));
    CHECK(dark);
}

TEST_CASE("DLP print: bad packets are sent again, five times at most") {
    DlpBench bench({}, stick_with(few(2)));
    start(bench);
    bench.board.panel.fpga().trouble.bad_share = 0.01;
    REQUIRE(bench.run_to(Event::print_displayed));
    CHECK(bench.board.panel.counters().resends > 10);
    CHECK(bench.board.panel.counters().resends ==
          bench.board.panel.counters().data_retries + bench.board.panel.counters().fill_retries);
    CHECK(bench.board.panel.counters().failed_lines == 0);
    CHECK(bench.board.panel.fpga().lit_pixels(0) == 1000U * 1700U);
    bench.board.panel.fpga().trouble = {};
    bench.board.panel.fpga().trouble.bad_line = 2559;
    REQUIRE(bench.run_to(Event::print_displayed));
    CHECK(bench.board.panel.counters().failed_lines == 1);
    CHECK(bench.board.print.bad_layers() == 1);
    CHECK(bench.notes.size() == 1);
}

TEST_CASE("DLP print: no exposure, no light; the model higher than the axis is cropped") {
    PanelPws wishes = few(3);
    wishes.exposure_s = wishes.bottom_exposure_s = 0;
    DlpBench bench({}, stick_with(wishes));
    bench.each_step = [&] { CHECK_FALSE(bench.board.lamp.on()); };
    start(bench);
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(bench.count(Event::print_exposing) == 0);

    PanelPws tall = few(40);
    tall.layer_mm = 5;
    DlpBench high({}, stick_with(tall));
    start(high);
    CHECK(high.board.print.file()->too_high(high.board.settings.motor));
    REQUIRE(high.run_to(Event::print_finished));
    CHECK(high.count(Event::print_exposed) == 35);
}

TEST_CASE("DLP 0.08: working times are kept every hour, and counted once; the fan rests in a pause") {
    BoardConfig config;
    config.firmware = Firmware::v008;
    PanelPws wishes = few(3);
    wishes.exposure_s = wishes.bottom_exposure_s = 1500;
    DlpBench bench(config, stick_with(wishes));
    start(bench);
    REQUIRE(bench.run_to(Event::print_exposing));
    CHECK(bench.board.lamp.fan());
    REQUIRE(bench.board.print.set_paused(true, bench.now));
    REQUIRE(bench.run_to(Event::print_pause_reached));
    bench.run(1);
    CHECK_FALSE(bench.board.lamp.fan());
    REQUIRE(bench.board.print.set_paused(false, bench.now));
    CHECK(bench.board.lamp.fan());
    bench.run_until(ms(3'601'000));
    CHECK(bench.board.counters.on_s == 3600);
    CHECK(bench.board.counters.led_s > 1500);
    CHECK(bench.board.counters.led_s < 3600);
    CHECK(bench.board.counters.print_s > 3590);
    REQUIRE(bench.run_to(Event::print_finishing));
    CHECK(bench.board.counters.led_s >= 4499);  // each part is cut to whole seconds
    CHECK(bench.board.counters.led_s <= 4500);
    CHECK(bench.board.counters.print_s <= 4600);
    bench.run_until(ms(7'201'000));
    CHECK(bench.board.counters.on_s == 7200);
    // 0.01 keeps them at the end of a print alone.
    DlpBench before({}, stick_with(few(1)));
    before.run_until(ms(7'201'000));
    CHECK(before.board.counters.on_s == 0);
}

TEST_CASE("DLP print: a whole print without anybody looking is over in a moment, its times are the file's") {
    DlpBench bench({}, stick_with({}));
    watch(bench);
    start(bench);
    std::size_t layer = 0;
    bench.each_event = [&](Event event) {
        if (event == Event::print_exposed) {
            CHECK(bench.board.lamp.last() == (layer++ < 5 ? ms(40'000) : ms(7'000)));
        }
    };
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(layer == 100);
    // 100 times 5.37 s up (2 mm/s is not reached), 5.35 s down, light and dark.
    CHECK(to_seconds(bench.board.print.elapsed(bench.now)) == doctest::Approx(1978).epsilon(0.02));
}

TEST_CASE("DLP print: layers of no exposure stay dark; with the firmware's mistake the lamp stays lit") {
    PanelPws wishes = few(3);
    wishes.exposure_s = wishes.bottom_exposure_s = 0;
    for (const bool mistaken : {false, true}) {
        BoardConfig config;
        config.quirks.light_zero_stays_on = mistaken;
        DlpBench bench(config, stick_with(wishes));
        bool lit_in_lift = false;
        bench.each_step = [&] {
            const auto& board = bench.board;
            lit_in_lift = lit_in_lift || (board.lamp.on() && board.print.state() == PrintState::lift);
        };
        start(bench);
        REQUIRE(bench.run_to(Event::print_finished));
        CHECK(lit_in_lift == mistaken);
        CHECK(bench.count(Event::print_exposing) == 0);
        CHECK(bench.count(Event::print_exposed) == 0);
        CHECK_FALSE(bench.board.lamp.on());
    }
}

}  // namespace
}  // namespace fauxboard::dlp::test
