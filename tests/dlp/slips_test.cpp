// Each slip of the real programs, beside the board without it; and the parts that they show up in.

#include <doctest/doctest.h>

#include <cmath>

#include "emulator/dlp/ramp.h"
#include "tests/support/dlp_bench.h"
#include "tests/support/marked_file.h"

namespace fauxboard::dlp::test {
namespace {

using testing::DlpBench;
using testing::make_panel_pws;
using testing::MemoryStick;
using testing::PanelPws;

PanelPws few(std::uint32_t layers) {
    PanelPws wishes;
    wishes.layers = layers;
    return wishes;
}

BoardConfig with(bool Quirks::*slip, bool on) {
    BoardConfig config;
    config.quirks.*slip = on;
    return config;
}

/// A board with one file, ready.
struct Ready : DlpBench {
    explicit Ready(const BoardConfig& config, const PanelPws& wishes = few(2), const char* name = "s1.pws")
        : DlpBench(config, stick_of(name, make_panel_pws(wishes))) {
        REQUIRE(run_to(Event::board_ready, 3));
    }
    static MemoryStick stick_of(const char* name, std::string bytes) {
        MemoryStick out;
        out.files = {{name, std::move(bytes)}};
        return out;
    }
    void start() { REQUIRE(board.print_file(stick.files[0].first, now)); }
    double height() const { return board.platform.position(now); }
};

TEST_CASE("slips: the end goes down into a model that is higher than the lift") {
    for (const bool slip : {false, true}) {
        PanelPws wishes = few(4);
        wishes.layer_mm = 3;
        Ready bench(with(&Quirks::end_goes_down, slip), wishes);
        bench.start();
        REQUIRE(bench.run_to(Event::print_finishing));
        CHECK(bench.height() == doctest::Approx(12));
        double lowest = 1000;
        bench.each_step = [&] { lowest = std::min(lowest, bench.height()); };
        REQUIRE(bench.run_to(Event::print_finished));
        CHECK(lowest == doctest::Approx(slip ? 5 : 12).epsilon(0.01));
        CHECK((bench.board.watch.into_model > 0) == slip);
        CHECK((bench.board.watch.broken() > 0) == slip);
    }
}

/// Dark pictures as a .photon, each layer with values of its own.
testing::ResinFile dark_photon(std::uint32_t layers) {
    testing::ResinFile wishes;
    wishes.kind = testing::ResinFile::Kind::cbddlp;
    wishes.version = 2;
    wishes.width = panel_columns;
    wishes.height = panel_lines;
    wishes.layers = layers;
    wishes.bottom_layers = 1;
    wishes.previews = false;
    wishes.lift_mm_min = 60;
    wishes.retract_mm_min = 90;
    wishes.picture = [](std::uint32_t, std::uint32_t, std::uint32_t) { return std::uint8_t{0}; };
    return wishes;
}

TEST_CASE("slips: lifts of a .photon go 60 times as fast, those of a .pws do not") {
    const auto drop_mm_s = [](const char* name, const std::string& bytes, bool slip) {
        DlpBench bench(with(&Quirks::speed_times_60, slip), Ready::stick_of(name, bytes));
        REQUIRE(bench.run_to(Event::board_ready, 3));
        REQUIRE(bench.board.print_file(name, bench.now));
        REQUIRE(bench.run_to(Event::print_exposing));
        return bench.board.print.plan().drop_mm_s;
    };
    testing::ResinFile wishes = dark_photon(2);
    const std::string photon = testing::make_resin_file(wishes).bytes;
    CHECK(drop_mm_s("a.photon", photon, false) == doctest::Approx(1.5));
    CHECK(drop_mm_s("a.photon", photon, true) == doctest::Approx(90));
    CHECK(drop_mm_s("a.pws", make_panel_pws(few(2)), true) == doctest::Approx(4));
    // What does not say how fast it comes down comes down as it went up; the bottom's lift is half as fast.
    wishes.retract_mm_min = 0;
    CHECK(drop_mm_s("a.photon", testing::make_resin_file(wishes).bytes, false) == doctest::Approx(0.5));
}

TEST_CASE("slips: a print that was stopped while it homed begins with the next homing by hand") {
    for (const bool slip : {false, true}) {
        Ready bench(with(&Quirks::stop_homing_keeps_print, slip));
        bench.start();
        bench.run(0.5);
        REQUIRE(bench.board.print.stop(bench.now));
        CHECK(bench.count(Event::print_cancelled) == 1);
        REQUIRE(bench.board.print.home(bench.now));
        CHECK(bench.board.print.active() == slip);
        REQUIRE(bench.run_to(slip ? Event::print_exposing : Event::platform_homed));
        CHECK(bench.count(Event::print_started) == (slip ? 2 : 1));
    }
}

TEST_CASE("slips: homing looks no further than max_pos, and fails from above it") {
    for (const bool slip : {false, true}) {
        BoardConfig config = with(&Quirks::short_homing_search, slip);
        config.platform.start_mm = 181;
        config.platform.travel_mm = 190;
        Ready bench(config);
        REQUIRE(bench.board.print.home(bench.now));
        REQUIRE(bench.run_to(slip ? Event::platform_homing_failed : Event::platform_homed));
        CHECK(bench.board.print.homed() != slip);
    }
}

TEST_CASE("slips: the slow run of homing goes to -1, wherever home_pos is") {
    for (const bool slip : {false, true}) {
        Ready bench(with(&Quirks::slow_homing_to_one, slip));
        bench.board.settings.motor.home_pos_mm = -10;
        REQUIRE(bench.board.print.home(bench.now));
        // From -7 to -1 is up, where no switch closes.
        REQUIRE(bench.run_to(slip ? Event::platform_homing_failed : Event::platform_homed));
        if (!slip) CHECK(bench.height() == doctest::Approx(-10));
    }
}

TEST_CASE("slips: a last line that never arrived is not noticed") {
    for (const bool slip : {false, true}) {
        testing::ResinFile wishes = dark_photon(1);
        wishes.picture = [](std::uint32_t, std::uint32_t, std::uint32_t) { return std::uint8_t{255}; };
        DlpBench bench(with(&Quirks::last_line_unchecked, slip),
                       Ready::stick_of("a.photon", testing::make_resin_file(wishes).bytes));
        REQUIRE(bench.run_to(Event::board_ready, 3));
        bench.board.panel.fpga().trouble.bad_line = panel_lines - 1;
        REQUIRE(bench.board.print_file("a.photon", bench.now));
        REQUIRE(bench.run_to(Event::print_displayed));
        CHECK(bench.board.print.bad_layers() == (slip ? 0 : 1));
        CHECK(bench.notes.size() == (slip ? 0U : 1U));
        CHECK(bench.board.watch.wrong_pictures == 1);
        CHECK(bench.board.watch.broken() == 1);
    }
}

TEST_CASE("slips: lines that the panel never took pause the print") {
    for (const bool slip : {false, true}) {
        Ready bench(with(&Quirks::pause_on_bad_lines, slip));
        bench.board.panel.fpga().trouble.bad_line = 100;
        bench.start();
        REQUIRE(bench.run_to(Event::print_displayed));
        CHECK(bench.board.print.paused() == slip);
        CHECK(bench.count(Event::print_paused) == (slip ? 1 : 0));
    }
}

TEST_CASE("slips: the working time of the panel is never counted") {
    for (const bool slip : {false, true}) {
        Ready bench(with(&Quirks::display_not_counted, slip), few(1));
        bench.start();
        REQUIRE(bench.run_to(Event::print_finished));
        CHECK(bench.board.counters.led_s == 40);
        CHECK(bench.board.counters.display_s == (slip ? 0 : 40));
    }
}

TEST_CASE(
    "0.08 goes down from the bottom's exposure in steps; without bottom layers there is nothing to go down "
    "from") {
    BoardConfig config;
    config.firmware = Firmware::v008;
    for (const std::uint32_t bottom : {0U, 1U}) {
        PanelPws wishes = few(5);
        wishes.bottom_layers = bottom;
        Ready bench(config, wishes);
        bench.board.settings.general.decrease_steps = 2;
        bench.start();
        std::vector<double> lights;
        bench.each_event = [&](Event event) {
            if (event == Event::print_exposed) lights.push_back(to_seconds(bench.board.lamp.last()));
        };
        REQUIRE(bench.run_to(Event::print_finished));
        CHECK(lights ==
              (bottom == 0 ? std::vector<double>{7, 7, 7, 7, 7} : std::vector<double>{40, 29, 18, 7, 7}));
    }
}

TEST_CASE(
    "what a print is told to change is done only when its layers' own values are given up for the file's") {
    for (const bool given_up : {false, true}) {
        testing::ResinFile wishes = dark_photon(3);
        wishes.exposure_s = 8;
        wishes.bottom_exposure_s = 20;
        DlpBench bench({}, Ready::stick_of("a.photon", testing::make_resin_file(wishes).bytes));
        REQUIRE(bench.run_to(Event::board_ready, 3));
        REQUIRE(bench.board.print_file("a.photon", bench.now));
        if (given_up) bench.board.print.changes.individual = false;
        bench.board.print.changes.light_s = 3;
        std::vector<double> lights;
        bench.each_event = [&](Event event) {
            if (event == Event::print_exposed) lights.push_back(to_seconds(bench.board.lamp.last()));
        };
        REQUIRE(bench.run_to(Event::print_finished));
        CHECK(lights == (given_up ? std::vector<double>{20, 3, 3} : std::vector<double>{20, 8, 8}));
    }
}

TEST_CASE("the watch counts what must never happen") {
    Watch watch;
    watch.look(false, true, true, 10);
    watch.look(true, false, true, 10);
    watch.look(false, true, true, 15);
    CHECK(watch.broken() == 0);
    watch.look(false, true, true, 9.9);
    CHECK(watch.into_model == 1);
    watch.look(true, true, true, 10);
    CHECK(watch.lit_moving == 1);
    watch.look(false, false, false, 0);  // no print: there is nothing to go into
    watch.look(false, true, true, 0);
    CHECK(watch.broken() == 2);
    watch.exposed(from_seconds(7), 7.0005);
    CHECK(watch.broken() == 2);
    watch.exposed(from_seconds(7), 7.5);
    CHECK(watch.exposure_error_ms == doctest::Approx(500));
    CHECK(watch.broken() == 3);
}

TEST_CASE("a ramp is where it should be at any time, and its end is its end") {
    const Ramp ramp(10, 2, 1);  // 2 mm up to speed in 2 s, 6 mm in 3 s, 2 mm in 2 s
    CHECK(ramp.total_s() == doctest::Approx(7));
    for (const auto& [s, mm] : {std::pair{-1.0, 0.0},
                                {0.0, 0.0},
                                {1.0, 0.5},
                                {2.0, 2.0},
                                {3.5, 5.0},
                                {6.0, 9.5},
                                {7.0, 10.0},
                                {9.0, 10.0}}) {
        CHECK(ramp.at(s) == doctest::Approx(mm));
        if (s >= 0 && s <= 7) CHECK(ramp.when(mm) == doctest::Approx(s));
    }
    CHECK(ramp.when(-3) == 0);
    CHECK(ramp.when(11) == doctest::Approx(7));
    const Ramp none(-1, 2, 1);
    CHECK(none.total_s() == 0);
    CHECK(none.at(5) == 0);
    CHECK(none.when(5) == 0);
    CHECK(std::isfinite(Ramp(1, 0, 0).total_s()));
}

TEST_CASE("the motor's current: full in use, less, then none; never when its times are 0") {
    MotorSettings settings;
    Motor motor;
    motor.power_on();
    CHECK(motor.current_ma(settings) == 0);
    motor.follow(true, settings, ms(0));
    CHECK(motor.current_ma(settings) == 800);
    motor.follow(false, settings, ms(1'000));
    CHECK_FALSE(motor.advance(ms(10'999)));
    CHECK(motor.current_ma(settings) == 800);
    CHECK_FALSE(motor.advance(ms(11'000)));
    CHECK(motor.current_ma(settings) == 300);
    CHECK(motor.advance(ms(61'000)));
    CHECK(motor.current_ma(settings) == 0);
    settings.hold_time_ms = settings.off_time_ms = 0;
    motor.follow(true, settings, ms(70'000));
    motor.follow(false, settings, ms(80'000));
    CHECK(motor.next_event() == never);
    CHECK(motor.current_ma(settings) == 800);
}

TEST_CASE("the platform: no more moves than fit, none to nowhere, and its switches at either end") {
    Platform platform({});
    platform.power_on();
    CHECK_FALSE(platform.move({std::nan(""), 1, 1}, false, ms(0)));
    CHECK_FALSE(platform.busy());
    unsigned taken = 0;
    while (platform.move({static_cast<double>(taken + 1), 10, 10}, false, ms(0))) {
        REQUIRE(++taken < 100);
    }
    CHECK(taken > 1);
    CHECK(platform.target() == taken);
    platform.stop(ms(0));
    // A print with the switch that homing uses at the top.
    BoardConfig config;
    config.platform.start_mm = 170;
    config.platform.travel_mm = 180;
    for (const bool stuck : {false, true}) {
        Ready bench(config);
        bench.board.settings.motor.home_direction = 1;
        bench.board.settings.motor.home_pos_mm = 180;
        if (stuck) {
            PlatformTrouble trouble;
            trouble.upper = SwitchState::never_opens;
            bench.board.platform.set_trouble(trouble, bench.now);
        }
        REQUIRE(bench.board.print.home(bench.now));
        REQUIRE(bench.run_to(stuck ? Event::platform_homing_failed : Event::platform_homed));
        if (stuck) continue;
        CHECK(bench.height() == doctest::Approx(180));
        CHECK(bench.board.platform.true_position(bench.now) == doctest::Approx(180));
    }
}

}  // namespace
}  // namespace fauxboard::dlp::test
