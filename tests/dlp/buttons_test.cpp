// What the board's own buttons ask for, and when they are told: not now.

#include <doctest/doctest.h>

#include "emulator/dlp/previews.h"
#include "tests/support/dlp_bench.h"
#include "tests/support/marked_file.h"

namespace fauxboard::dlp::test {
namespace {

using testing::DlpBench;
using testing::make_panel_pws;
using testing::MemoryStick;
using testing::PanelPws;

std::string two_layers() {
    PanelPws wishes;
    wishes.layers = 2;
    return make_panel_pws(wishes);
}

/// A stick with a print, a settings file, a picture, a folder in a folder, and what the board does not list.
MemoryStick full_stick() {
    MemoryStick stick;
    stick.files = {{"a.pws", two_layers()}, {"set.acfg", "language: 1\n"},
                   {"logo.cimg", "x"},      {"x.ctb", "x"},
                   {"read.me", "x"},        {"sub/", ""},
                   {"sub/deep/", ""},       {"sub/deep/b.pws", two_layers()}};
    return stick;
}

struct Ready : DlpBench {
    explicit Ready(const BoardConfig& config = {}) : DlpBench(config, full_stick()) {
        REQUIRE(run_to(Event::board_ready, 3));
    }
    std::string listed() const {
        std::string out;
        for (const ListedFile& file : board.files.files())
            out += file.entry.name + ' ';
        return out;
    }
};

TEST_CASE("files: what is listed, into folders and out again, and to the top when the folder is gone") {
    Ready bench;
    FileList& files = bench.board.files;
    CHECK(bench.listed() == "a.pws set.acfg logo.cimg sub ");
    CHECK_FALSE(files.up());
    CHECK_FALSE(files.enter("a.pws"));
    CHECK_FALSE(files.enter("nothing"));
    REQUIRE(files.enter("sub"));
    REQUIRE(files.enter("deep"));
    CHECK(bench.listed() == "b.pws ");
    REQUIRE(files.up());
    CHECK(bench.listed() == "deep ");
    REQUIRE(files.enter("deep"));
    std::erase_if(bench.stick.files, [](const auto& file) { return file.first.starts_with("sub/"); });
    files.refresh();
    CHECK(bench.listed() == "a.pws set.acfg logo.cimg ");
    bench.stick.in = false;
    files.refresh();
    CHECK(bench.listed().empty());
    bench.stick.in = true;
    bench.stick.files.clear();
    for (int i = 0; i < 5000; ++i)
        bench.stick.files.emplace_back(std::to_string(i) + ".pws", "");
    files.refresh();
    CHECK(files.files().size() == 4096U);
    CHECK(files.files().back().entry.name == "4095.pws");
    BoardConfig config;
    config.lists_ctb = true;
    CHECK(Ready(config).listed() == "a.pws set.acfg logo.cimg x.ctb sub ");
}

TEST_CASE("a file is looked at, printed, deleted; each not when there is none, and not while it is printed") {
    Ready bench;
    MksBoard& board = bench.board;
    CHECK_FALSE(board.print_viewed(bench.now));
    CHECK_FALSE(board.delete_viewed());
    CHECK(bench.count(Event::files_not_deleted) == 1);
    CHECK_FALSE(board.view("nothing.pws"));
    CHECK_FALSE(board.view("sub"));
    CHECK_FALSE(board.view("set.acfg"));
    REQUIRE(board.view("a.pws"));
    CHECK(board.viewed().file.has_value());
    CHECK(board.viewed().problem.empty());
    REQUIRE(board.print_viewed(bench.now));
    CHECK_FALSE(board.print_viewed(bench.now));
    CHECK(board.print.problem() == "The platform moves, or a print is under way.");
    CHECK_FALSE(board.delete_viewed());
    CHECK(bench.count(Event::files_not_deleted) == 2);
    CHECK_FALSE(board.choose_image(2, bench.now));
    board.doze(bench.now);
    CHECK_FALSE(board.dozing());
    REQUIRE(bench.run_to(Event::print_finishing));
    CHECK_FALSE(board.print.stop(bench.now));
    CHECK_FALSE(board.print.set_paused(true, bench.now));
    REQUIRE(bench.run_to(Event::print_finished));
    REQUIRE(board.delete_viewed());
    CHECK(bench.count(Event::files_deleted) == 1);
    CHECK(bench.listed() == "set.acfg logo.cimg sub ");
    CHECK(board.viewed().path.empty());
    // Gone between the list and the touch; and one that is no print.
    bench.stick.files.emplace_back("c.pws", "no print");
    board.files.refresh();
    REQUIRE(board.view("c.pws"));
    CHECK_FALSE(board.viewed().file.has_value());
    CHECK_FALSE(board.viewed().problem.empty());
    CHECK_FALSE(board.print_viewed(bench.now));
    CHECK(bench.count(Event::print_not_opened) == 1);
    bench.stick.files.pop_back();
    REQUIRE(board.view("c.pws"));
    CHECK(board.viewed().problem == "There is no such file, or it cannot be read.");
    CHECK_FALSE(board.delete_viewed());
}

TEST_CASE("the platform by hand: not while it homes or prints, on while it moves, and within the axis") {
    Ready bench;
    Print& print = bench.board.print;
    CHECK_FALSE(bench.board.set_zero(bench.now));
    CHECK_FALSE(print.raise_after_zero(bench.now));
    CHECK_FALSE(print.stop_moving(bench.now));
    REQUIRE(print.home(bench.now));
    CHECK_FALSE(print.home(bench.now));
    CHECK_FALSE(print.jog(1, bench.now));
    REQUIRE(bench.run_to(Event::platform_homed));
    REQUIRE(print.jog(40, bench.now));
    CHECK(bench.board.platform.speed() == doctest::Approx(20.0 / 3));
    CHECK_FALSE(bench.board.set_zero(bench.now));
    CHECK_FALSE(print.raise_after_zero(bench.now));
    REQUIRE(print.jog(1000, bench.now));
    bench.run(60);
    CHECK(bench.board.platform.position(bench.now) == doctest::Approx(180));
    CHECK(print.jog(5, bench.now));  // it is at the top: nothing to do
    CHECK_FALSE(bench.board.platform.busy());
    REQUIRE(print.raise_after_zero(bench.now));  // higher than that goes
    CHECK_FALSE(bench.board.platform.busy());
    REQUIRE(print.jog(-100, bench.now));
    CHECK(print.stop_moving(bench.now));
    CHECK(bench.count(Event::platform_stopped) == 1);
    REQUIRE(bench.board.print_file("a.pws", bench.now));
    CHECK_FALSE(print.stop_moving(bench.now));
    CHECK_FALSE(print.jog(1, bench.now));
}

TEST_CASE("settings are kept one after the other, and loaded when nothing else goes on") {
    Ready bench;
    MksBoard& board = bench.board;
    REQUIRE(board.print.home(bench.now));
    REQUIRE(bench.run_to(Event::platform_homed));
    REQUIRE(board.save_setup(bench.now));
    CHECK_FALSE(board.save_setup(bench.now));
    CHECK_FALSE(board.set_zero(bench.now));
    CHECK_FALSE(board.load_setup("set.acfg", bench.now));
    const std::array<GlassPoint, 3> targets{{{100, 100}, {300, 100}, {200, 200}}};
    CHECK_FALSE(board.calibrate_touch(targets, bench.now));
    CHECK(bench.count(Event::touch_not_calibrated) == 1);
    REQUIRE(bench.run_to(Event::setup_saved));
    REQUIRE(board.load_setup("set.acfg", bench.now));
    bench.run(10);
    CHECK(bench.count(Event::setup_loaded) + bench.count(Event::setup_failed) == 1);
    CHECK_FALSE(board.set_language(-1, bench.now));
    CHECK_FALSE(board.set_language(2, bench.now));
    REQUIRE(board.set_language(1, bench.now));
    CHECK(board.settings.general.language == 1);
    REQUIRE(board.print_file("a.pws", bench.now));
    CHECK_FALSE(board.load_setup("set.acfg", bench.now));
}

TEST_CASE("the UV test: its pictures, none while one is loaded, and over when a print begins") {
    for (const bool display : {false, true}) {
        Ready bench;
        MksBoard& board = bench.board;
        CHECK_FALSE(board.choose_image(0, bench.now));
        CHECK_FALSE(board.choose_image(UvTest::images + 1, bench.now));
        REQUIRE(board.choose_image(2, bench.now));
        CHECK_FALSE(board.choose_image(3, bench.now));
        bench.run(2);
        CHECK_FALSE(board.choose_image(2, bench.now));
        display ? board.uv_test.set_display(true, bench.now) : board.uv_test.set_light(true, bench.now);
        board.settle(bench.now);
        CHECK(board.uv_test.light() != display);
        REQUIRE(board.print_file("a.pws", bench.now));
        CHECK_FALSE(board.uv_test.light());
        CHECK_FALSE(board.uv_test.display());
        CHECK_FALSE(board.lamp.on());
        REQUIRE(bench.run_to(Event::print_finished));
        CHECK(board.watch.broken() == 0);
    }
}

TEST_CASE(
    "before it is ready the board prints nothing; a clock that is given is the clock; no time, no sound") {
    BoardConfig config;
    config.clock = Moment{2024, 2, 29, 12, 30, 15};
    DlpBench bench(config, full_stick());
    CHECK_FALSE(bench.board.print_file("a.pws", bench.now));
    CHECK(bench.board.calendar.at(bench.now) == *config.clock);
    CHECK(bench.board.external_clock.calendar.at(ms(60'000)) == Moment{2024, 2, 29, 12, 31, 15});
    REQUIRE(bench.run_to(Event::board_ready, 3));
    bench.board.settings.general.buzzer_touch_ms = 0;
    bench.board.touch_sound(bench.now);
    CHECK(bench.board.sound().until <= bench.now);
    bench.board.settings.general.buzzer_touch_ms = 50;
    bench.board.touch_sound(bench.now);
    CHECK(bench.board.sound().until == bench.now + ms(50));
    CHECK_FALSE(bench.board.board_fan());
    bench.board.settings.general.fan_mode = 2;
    CHECK(bench.board.board_fan());
    bench.board.cut_power(bench.now);
    CHECK_FALSE(bench.board.board_fan());
}

TEST_CASE("a stick that goes on from homing: the first layer's plan cannot be read") {
    Ready bench;
    REQUIRE(bench.board.print_file("a.pws", bench.now));
    bench.stick.in = false;
    REQUIRE(bench.run_to(Event::print_read_error));
    CHECK(bench.board.print.homed());
    CHECK(bench.board.print.paused());
    CHECK(bench.notes == std::vector<std::string>{"layer 1: The stick is gone, or the file on it."});
    bench.stick.in = true;
    REQUIRE(bench.board.print.set_paused(false, bench.now));
    REQUIRE(bench.run_to(Event::print_finished));
    CHECK(bench.count(Event::print_exposed) == 2);
}

TEST_CASE("a file for another panel, by its width or by its height, is told with its size") {
    for (const auto& [width, height] :
         {std::pair{panel_columns + 4, panel_lines}, {panel_columns, panel_lines + 1}}) {
        testing::ResinFile wishes;
        wishes.kind = testing::ResinFile::Kind::cbddlp;
        wishes.width = width;
        wishes.height = height;
        wishes.layers = 1;
        wishes.previews = false;
        wishes.picture = [](std::uint32_t, std::uint32_t, std::uint32_t) { return std::uint8_t{0}; };
        MemoryStick stick;
        stick.files.emplace_back("other.photon", testing::make_resin_file(wishes).bytes);
        DlpBench bench({}, std::move(stick));
        REQUIRE(bench.run_to(Event::board_ready, 3));
        REQUIRE(bench.board.view("other.photon"));
        CHECK(bench.board.viewed().problem == "Its pictures have " + std::to_string(width) + " x " +
                                                  std::to_string(height) +
                                                  " pixels; this panel has 1440 x 2560.");
        CHECK_FALSE(bench.board.print_file("other.photon", bench.now));
    }
}

TEST_CASE("the lamp lights for a time, and for no time not at all; asleep twice is asleep once") {
    Lamp lamp;
    lamp.power_on();
    lamp.light_for(ms(0), ms(5));
    CHECK_FALSE(lamp.on());
    CHECK_FALSE(lamp.counting());
    CHECK(lamp.next_event() == never);
    lamp.light_for(ms(10), ms(5));
    CHECK(lamp.on());
    lamp.light_for(ms(0), ms(7));
    CHECK_FALSE(lamp.on());
    CHECK(lamp.last() == ms(2));
    Ready bench;
    bench.board.doze(bench.now);
    bench.board.doze(bench.now);
    CHECK(bench.board.dozing());
    CHECK_FALSE(bench.board.panel.powered());
    bench.board.wake(bench.now);
    CHECK_FALSE(bench.board.dozing());
    CHECK(bench.count(Event::files_changed) == 1);
}

TEST_CASE("previews: the small one without a large one, none without any") {
    testing::ResinFile wishes;
    wishes.kind = testing::ResinFile::Kind::cbddlp;
    wishes.width = panel_columns;
    wishes.height = panel_lines;
    wishes.layers = 1;
    wishes.picture = [](std::uint32_t, std::uint32_t, std::uint32_t) { return std::uint8_t{0}; };
    MemoryStick stick;
    stick.files.emplace_back("both.photon", testing::make_resin_file(wishes).bytes);
    wishes.previews = false;
    stick.files.emplace_back("none.photon", testing::make_resin_file(wishes).bytes);
    stick.files.emplace_back("bad.photon", "no print");
    Previews previews;
    const Previews::Pixels* both = previews.pixels(stick, "both.photon");
    REQUIRE(both != nullptr);
    CHECK(both->rgb.size() == std::size_t{both->width} * both->height);
    CHECK(previews.pixels(stick, "both.photon") == both);
    CHECK(previews.pixels(stick, "none.photon") == nullptr);
    CHECK(previews.pixels(stick, "bad.photon") == nullptr);
    CHECK(previews.pixels(stick, "gone.photon") == nullptr);
}

}  // namespace
}  // namespace fauxboard::dlp::test
