// The page as cells, and a person's keys and clicks. No terminal.

#include <doctest/doctest.h>

#include "emulator/screen/console.h"
#include "tests/screen/harness.h"
#include "tests/screen/keys.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using screen::Console;
using screen::Key;
using screen::Layout;
using screen::Look;
using screen::PageView;

namespace {

constexpr std::string_view small_screen = R"({
  "name": "small", "title": "Small", "extends": "smartto-screen",
  "pages": { "Setting": { "buttons": {
    "Time": { "input": { "normally": 16, "min": 10, "max": 99 }, "send": "M1 S{input:d}", "expect": ["L9"] },
    "Toast": { "send": "M2" }, "Bread": { "send": "M3" }
  } } }
})";

PageView view_of(screen::Screen& of) {
    return screen::view_page(of.standpoint());
}

Key click(int x, int y) {
    Key out = key(Key::Kind::click);
    out.x = x;
    out.y = y;
    return out;
}

std::size_t index_of(const PageView& view, std::string_view label) {
    for (std::size_t i = 0; i < view.buttons.size(); ++i) {
        if (view.buttons[i].label == label) return i;
    }
    REQUIRE_MESSAGE(false, std::string(label));
    return 0;
}

/// A console in front of a screen: what a key touches is pressed, as the program does it.
struct Desk {
    explicit Desk(Bench& screen_bench) : bench(screen_bench) { console.show(view_of(*bench)); }

    bool press(const Key& pressed) {
        const screen::Reaction reaction = console.press(pressed);
        if (reaction.touch) {
            const auto& touch = *reaction.touch;
            bench->touch(touch.button, touch.row, touch.input, bench.now());
            bench.pass(0);
            console.show(view_of(*bench));
        }
        return reaction.quit;
    }
    std::string label() const {
        for (const screen::Run& run : console.layout().runs) {
            if (run.ink == screen::Ink::focus && run.text.find("─") == std::string::npos &&
                run.text.find("│") == std::string::npos) {
                return run.text;
            }
        }
        return "(none)";
    }

    Bench& bench;
    Console console{"small"};
};

}  // namespace

TEST_CASE("the main page of the A30T's screen on 80 x 24 cells") {
    Bench bench;
    bench.say("L2 B:22.0 /0.0 /0 T0:21.5 /200.0 /1 SD:0 F0:0 F2:0 R:100 FR:50");
    Look look;
    look.screen = "geeetech-a30t";
    const std::vector<screen::TalkLine> talk{{screen::Ink::came, "<- one"}, {screen::Ink::sent, "-> two"}};
    const Layout layout = screen::lay_out(view_of(*bench), look, talk, 80, 24);
    CHECK(layout.text() ==
          " Main menu   Main                                                 geeetech-a30t\n"
          " Nozzle 21.5 / 200.0 °C   Bed 22.0 / 0.0 °C\n"
          " X 0.000   Y 0.000   Z 0.000 mm   0 mm/s\n"
          " Fan 0 %   Speed 100 %   Motors off\n"
          " SD card in   Filament out   Print idle\n"
          " Mix E0 0 %   E1 0 %   E2 0 %\n"
          "\n"
          " ┌─────────┐ ┌──────────┐ ┌─────────┐\n"
          " │ Control │ │ Printing │ │ Setting │\n"
          " └─────────┘ └──────────┘ └─────────┘\n"
          " ┌──────────────────┐\n"
          " │ Bar chart button │\n"
          " └──────────────────┘\n"
          "── the line ────────────────────────────────────────────────────────────────────\n"
          "<- one\n"
          "-> two\n"
          "\n\n\n\n\n\n\n"
          " Virtual screen, no real one.  Tab, arrows, Enter, letters or mouse.  q quits\n");
    CHECK(layout.spots.size() == 4);
    CHECK(layout.spots[0].hot == 'c');
    CHECK(layout.spots[1].hot == 'p');
    CHECK(layout.spots[2].hot == 's');
    CHECK(layout.spots[3].hot == 'b');
    CHECK(layout.hit(1, 7) == 0);
    CHECK(layout.hit(11, 9) == 0);
    CHECK_FALSE(layout.hit(12, 8).has_value());
    CHECK(layout.hit(13, 8) == 1);
    CHECK(layout.hit(20, 11) == 3);
    CHECK_FALSE(layout.hit(0, 0).has_value());
}

TEST_CASE("every page of every shipped screen fits, keeps its boxes apart, and every button can be hit") {
    for (const char* name : {"geeetech-a30t", "geeetech-a30"}) {
        const auto profile = shipped_screen(name);
        screen::Screen screen(profile);
        for (std::size_t page = 0; page < profile->pages.size(); ++page) {
            for (const auto& size : {std::pair{80, 24}, std::pair{200, 60}}) {
                screen::Standpoint at = screen.standpoint();
                at.page = page;
                const PageView view = screen::view_page(at);
                for (std::size_t focus = 0; focus < view.buttons.size(); ++focus) {
                    CAPTURE(view.path);
                    CAPTURE(focus);
                    Look look;
                    look.focus = focus;
                    const Layout layout = screen::lay_out(view, look, {}, size.first, size.second);
                    const screen::Box& box = layout.spots.at(focus).box;
                    CHECK(layout.spots[focus].visible);
                    CHECK(box.x >= 0);
                    CHECK(box.x + box.width <= size.first);
                    CHECK(box.y >= 1);
                    CHECK(box.y + box.height <= size.second - 1 - layout.talk_rows);
                    CHECK(layout.talk_rows >= 4);
                    CHECK(layout.hit(box.x, box.y) == focus);
                    CHECK(layout.hit(box.x + box.width - 1, box.y + box.height - 1) == focus);
                }
            }
        }
    }
}

TEST_CASE("a terminal that is too small says so, and only q works on it") {
    Bench bench;
    Console console("small");
    console.show(view_of(*bench));
    console.resize(79, 24);
    CHECK(console.layout().too_small);
    CHECK(console.layout().text().find("79x24 cells are too few, 80x24 needed") != std::string::npos);
    CHECK_FALSE(console.press(key(Key::Kind::enter)).touch.has_value());
    CHECK_FALSE(console.press(click(2, 8)).touch.has_value());
    CHECK(console.press(letter('q')).quit);
    console.resize(5, 1);
    CHECK(console.layout().text() == "5x1 ~\n");
    console.resize(0, 0);
    CHECK(console.layout().text().empty());
    console.resize(80, 24);
    CHECK_FALSE(console.layout().too_small);
}

TEST_CASE("keys: Tab round, arrows by place, Enter, letters, q") {
    Bench bench(screen_from(small_screen));
    Desk desk(bench);
    CHECK(desk.label() == "Control");
    desk.press(key(Key::Kind::tab));
    CHECK(desk.label() == "Printing");
    desk.press(key(Key::Kind::right));
    CHECK(desk.label() == "Setting");
    desk.press(key(Key::Kind::right));
    CHECK(desk.label() == "Setting");
    desk.press(key(Key::Kind::down));
    CHECK(desk.label() == "Bar chart button");
    desk.press(key(Key::Kind::tab));
    CHECK(desk.label() == "Control");
    desk.press(key(Key::Kind::back_tab));
    CHECK(desk.label() == "Bar chart button");
    desk.press(key(Key::Kind::up));
    CHECK(desk.label() == "Control");
    desk.press(key(Key::Kind::left));
    CHECK(desk.label() == "Control");
    desk.press(key(Key::Kind::right));
    desk.press(key(Key::Kind::right));
    desk.press(key(Key::Kind::enter));
    CHECK(bench->page().path == "Setting");
    bench.take();
    desk.press(letter('O'));  // Time has T, so Toast has O
    CHECK(bench.take() == "M2\r\n");
    desk.press(letter('?'));
    CHECK(bench.take().empty());
    CHECK(desk.press(letter('q')));
}

TEST_CASE("clicks press what is under them; a click beside does nothing") {
    Bench bench(screen_from(small_screen));
    Desk desk(bench);
    const auto spots = desk.console.layout().spots;
    const screen::Box box = spots.at(index_of(view_of(*bench), "Setting")).box;
    desk.press(click(0, 0));
    CHECK(bench->page().path == "Main");
    desk.press(click(box.x + 1, box.y + 2));
    CHECK(bench->page().path == "Setting");
    const auto bread = desk.console.layout().spots.at(index_of(view_of(*bench), "Bread")).box;
    bench.take();
    desk.press(click(bread.x, bread.y));
    CHECK(bench.take() == "M3\r\n");
    CHECK(desk.label() == "Bread");
}

TEST_CASE("a number is typed, corrected, refused, left, and sent") {
    Bench bench(screen_from(small_screen));
    Desk desk(bench);
    desk.press(letter('s'));
    desk.press(letter('t'));
    bench.take();
    CHECK(desk.console.layout().text().find("Time, 10 to 99: _") != std::string::npos);
    for (const char c : std::string("5x"))
        desk.press(letter(c));
    CHECK(desk.console.layout().text().find("Time, 10 to 99: 5_   digits, please") != std::string::npos);
    desk.press(key(Key::Kind::enter));
    CHECK(desk.console.layout().text().find("from 10 to 99, please") != std::string::npos);
    CHECK_FALSE(desk.press(letter('q')));  // no quitting in the middle of a number
    desk.press(key(Key::Kind::escape));
    desk.press(letter('t'));
    for (const char c : std::string("999999999999999999999999"))
        desk.press(letter(c));
    for (int i = 0; i < 30; ++i)
        desk.press(key(Key::Kind::backspace));
    desk.press(key(Key::Kind::enter));
    CHECK(desk.console.layout().text().find("that is no number") != std::string::npos);
    desk.press(letter('2'));
    desk.press(letter('0'));
    CHECK(bench.take().empty());
    desk.press(key(Key::Kind::enter));
    CHECK(bench.take() == "M1 S20\r\n");
    CHECK(desk.console.layout().text().find("Time, 10") == std::string::npos);
}

TEST_CASE("a long list is scrolled to the focus, and the talk by pages") {
    Bench bench;
    bench.say("L7 begin file list:0");
    for (int i = 0; i < 60; ++i)
        bench.say("L7 P" + std::to_string(i) + " a-file-with-quite-a-long-name-" + std::to_string(i) +
                  ".gcode");
    bench.say("L7 end file list:0");
    screen::Standpoint at = bench->standpoint();
    at.page = bench->profile().find_page("Printing").value();
    const PageView view = screen::view_page(at);
    REQUIRE(view.buttons.size() > 60);
    Look look;
    const Layout top = screen::lay_out(view, look, {}, 80, 24);
    CHECK(top.spots[0].visible);
    CHECK_FALSE(top.spots[59].visible);
    CHECK(top.text().find("v more") != std::string::npos);
    look.focus = 59;
    const Layout end = screen::lay_out(view, look, {}, 80, 24);
    CHECK_FALSE(end.spots[0].visible);
    CHECK(end.spots[59].visible);
    CHECK(end.text().find("^ more") != std::string::npos);

    Console console("small");
    console.show(view_of(*bench));
    for (int i = 0; i < 1000; ++i)
        console.add_talk({screen::Ink::came, "line " + std::to_string(i)});
    CHECK(console.layout().text().find("line 999\n") != std::string::npos);
    for (int i = 0; i < 1000; ++i)
        console.press(key(Key::Kind::page_up));
    CHECK(console.layout().text().find("line 500\n") != std::string::npos);
    CHECK(console.layout().text().find("line 499\n") == std::string::npos);
    for (int i = 0; i < 1000; ++i)
        console.press(key(Key::Kind::page_down));
    CHECK(console.layout().text().find("line 999\n") != std::string::npos);
}

TEST_CASE("names from the line are cells, never control codes") {
    Bench bench;
    bench.say("L7 begin file list:0");
    bench.say("L7 P0 \x1b[2J\xe4.gcode");
    bench.say("L7 end file list:0");
    screen::Standpoint at = bench->standpoint();
    at.page = bench->profile().find_page("Printing").value();
    const std::string text = screen::lay_out(screen::view_page(at), {}, {}, 80, 24).text();
    CHECK(text.find("\\x1B[2Jä.gcode") != std::string::npos);
    CHECK(text.find('\x1b') == std::string::npos);
}
