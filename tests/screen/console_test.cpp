// What a person's keys do at the terminal where there is little or nothing to press, and what programs are
// told.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "emulator/screen/console.h"
#include "emulator/screen/scene.h"
#include "emulator/screen/screen_json.h"
#include "tests/screen/harness.h"
#include "tests/screen/keys.h"

namespace fauxboard::testing {
namespace {

using screen::ButtonView;
using screen::Console;
using screen::Key;
using screen::PageView;

constexpr std::string_view told_screen = R"({
  "name": "told",
  "values": { "n": { "unit": "mm", "names": { "1": "one", "-1": "less" } }, "t": { "kind": "text" },
              "l": { "kind": "list", "most": 3 }, "own": {} },
  "frames": {
    "L1": { "read": [ { "key": "N", "as": "real", "into": "n" },
                      { "key": "T:", "as": "text", "until": ";", "max_bytes": 4, "too_long": "cut", "into": "t" } ] },
    "L2": { "read": [ { "key": "+", "as": "list_append", "until": ";", "max_bytes": 4, "into": "l" } ] },
    "L3": { "read": [ { "key": "P", "as": "list_entry", "max_bytes": 4, "into": "l" } ] },
    "L4": { "read": [ { "key": "U", "as": "u8", "min": 1, "max": 9, "outside": "drop_rest", "into": "n" },
                      { "key": "V", "as": "mark", "column": 100 } ] },
    "L5": { "read": [ { "key": "Z", "as": "real", "bounds_of": "read", "max": 5, "outside": "zero", "then": [
                        { "key": "T:", "as": "text", "until": ";", "no_end": "cut", "into": "t" } ] } ] }
  },
  "pages": {
    "Main": { "shows": [ "{n} {t} {l} {own}" ], "buttons": {
      "Far": { "leads_to": "Far" },
      "Row": { "rows": "l", "label": "{row.text}", "send": "M1 {row}" },
      "Type": { "input": { "normally": 0.5, "min": -2, "max": 2.5 }, "send": "M2 {input}" } } },
    "Far": { "open_when": { "n": 1 }, "buttons": { "Back": { "leads_to": "<back>" }, "Same": {} } },
    "Far/Same": { "buttons": { "Same": {}, "Up": { "leads_to": "Other/Same" } } },
    "Other": { "buttons": { "Down": { "leads_to": "Far/Same" } } },
    "Other/Same": { "buttons": { "Out": { "leads_to": "Other" }, "Now": { "leads_to": "Far/Same" } } }
  },
  "everywhere": { "Deep": { "when": { "own": 0 }, "leads_to": "Far/Same" } }
})";

ButtonView button(std::size_t id, std::size_t row, std::string label) {
    ButtonView out;
    out.button = id;
    out.row = row;
    out.label = std::move(label);
    return out;
}

PageView page_of(std::vector<ButtonView> buttons) {
    PageView out;
    out.title = out.path = "Page";
    out.buttons = std::move(buttons);
    return out;
}

std::string last_line(const Console& console) {
    const std::string text = console.layout().text();
    const std::size_t end = text.size() - 1;
    return text.substr(text.rfind('\n', end - 1) + 1, end - text.rfind('\n', end - 1) - 1);
}

}  // namespace

TEST_CASE("a page without buttons: no key presses anything, q and Q still quit") {
    Console console("none");
    console.show(page_of({}));
    for (const Key::Kind kind :
         {Key::Kind::tab, Key::Kind::back_tab, Key::Kind::up, Key::Kind::down, Key::Kind::left,
          Key::Kind::right, Key::Kind::enter, Key::Kind::escape, Key::Kind::backspace, Key::Kind::click,
          Key::Kind::page_up, Key::Kind::page_down}) {
        const screen::Reaction reaction = console.press(key(kind));
        CHECK_FALSE(reaction.touch.has_value());
        CHECK_FALSE(reaction.quit);
    }
    CHECK_FALSE(console.press(letter(' ')).touch.has_value());
    CHECK(console.press(letter('Q')).quit);
    console.resize(80, 23);
    CHECK(console.layout().too_small);
    CHECK(console.press(letter('Q')).quit);
    CHECK_FALSE(console.press(letter('x')).quit);
}

TEST_CASE(
    "the blank presses what has the focus; the focus stays with its button and row while the page does") {
    Console console("rows");
    console.show(page_of({button(4, 1, "one"), button(4, 2, "two"), button(7, 0, "9")}));
    console.press(key(Key::Kind::tab));
    REQUIRE(console.press(letter(' ')).touch.has_value());
    CHECK(console.press(letter(' ')).touch->row == 2);
    console.show(page_of({button(4, 2, "two"), button(7, 0, "9")}));
    CHECK(console.press(letter(' ')).touch->row == 2);
    console.show(page_of({button(4, 1, "one"), button(7, 0, "9")}));  // its row is gone: the first
    CHECK(console.press(letter(' ')).touch->row == 1);
    CHECK(console.press(letter('1')).touch->button == 7);  // without letters: by a digit
    CHECK_FALSE(console.press(letter('~')).touch.has_value());
}

TEST_CASE(
    "numbers with sign and point are typed; two points are no number; a button that goes takes its entry "
    "along") {
    Console console("numbers");
    ButtonView typed = button(3, 0, "Height");
    typed.input.emplace();
    typed.input->min = -2;
    typed.input->max = 2.5;
    const auto type = [&](std::string_view text) {
        console.press(key(Key::Kind::enter));
        for (const char c : text)
            console.press(letter(c));
    };
    console.show(page_of({typed}));
    type("-1.25");
    CHECK(console.press(key(Key::Kind::enter)).touch->input == -1.25);
    type("1.2.5");
    CHECK_FALSE(console.press(key(Key::Kind::enter)).touch.has_value());
    CHECK(last_line(console).ends_with("that is no number"));
    console.press(key(Key::Kind::escape));
    type("2.6");
    CHECK_FALSE(console.press(key(Key::Kind::enter)).touch.has_value());
    CHECK(last_line(console).ends_with("from -2 to 2.5, please"));
    console.press(key(Key::Kind::up));  // no character, and no sign in the middle
    console.press(letter('-'));
    CHECK(last_line(console).find("2.6_   digits, please") != std::string::npos);
    console.press(letter('/'));
    CHECK(last_line(console).find("2.6_   digits, please") != std::string::npos);
    console.show(page_of({typed}));
    CHECK(last_line(console).find("2.6_") != std::string::npos);
    console.show(page_of({button(5, 0, "Other")}));
    CHECK(last_line(console).find("2.6_") == std::string::npos);
    CHECK(console.press(key(Key::Kind::enter)).touch->button == 5);
}

TEST_CASE("what is being read of the talk stays where it is while more comes; little talk is not scrolled") {
    Console console("talk");
    console.show(page_of({}));
    const auto add = [&](int from, int to) {
        for (int i = from; i < to; ++i)
            console.add_talk({screen::Ink::came, "line " + std::to_string(i) + "."});
    };
    add(0, 3);
    console.press(key(Key::Kind::page_up));
    CHECK(console.layout().text().find("line 2.\n") != std::string::npos);
    add(3, 100);
    console.press(key(Key::Kind::page_up));
    const std::string read = console.layout().text();
    CHECK(read.find("line 99.") == std::string::npos);
    add(100, 110);
    CHECK(console.layout().text() == read);
}

TEST_CASE("more lines than fit leave the talk its room") {
    PageView view = page_of({button(1, 0, "Go")});
    for (int i = 0; i < 50; ++i)
        view.lines.push_back("value " + std::to_string(i) + ".");
    const screen::Layout layout = screen::lay_out(view, {}, {}, 80, 24);
    CHECK(layout.text().find("value 0.") != std::string::npos);
    CHECK(layout.text().find("value 49.") == std::string::npos);
    CHECK(layout.talk_rows >= 4);
    CHECK(layout.spots.at(0).visible);
}

TEST_CASE("keys of frames: bounds, texts and lists that are too long, what stands behind the end") {
    struct Row {
        const char* line;
        screen::Verdict verdict;
        const char* why;
        const char* value;
        const char* is;
    };
    using V = screen::Verdict;
    for (const Row& row : std::vector<Row>{
             {"L1 N1.5 T:abc;", V::ok, "", "t", "abc"},
             {"L1 N1.5 T:abcde;", V::cut, "a text of 5 characters behind \"T:\", there is room for 4", "t",
              "abcd"},
             {"L1 N1.5 T:abc", V::rest_dropped, "no \";\" behind \"T:\"", "t", ""},
             {"L2 +abcdefg;", V::cut, "a name of 7 characters, there is room for 4", "l", "abcd\n"},
             {"L2 +abc", V::ok, "", "l", "abc\n"},
             {"L3 P1 abcde", V::cut, "a name of 5 characters, there is room for 4", "l", "\nabcd\n"},
             {"L3 P3 a", V::rest_dropped, "entry 3: the list holds 3", "l", ""},
             {"L4 U10", V::rest_dropped, "\"U\" 10 is out of bounds", "n", "0"},
             {"L4 U0", V::rest_dropped, "\"U\" 0 is out of bounds", "n", "0"},
             {"L4 U9", V::ok, "", "n", "9"},
             {"L5 Z6 T:x;", V::misread, "\"Z\" 6 is out of bounds and taken as 0", "t", "x"},
             {"L5 Z5 T:x", V::cut, "no \";\" behind \"T:\"", "t", "x"}}) {
        CAPTURE(row.line);
        Bench bench(screen_from(told_screen));
        const screen::Judgement& judgement = bench.say_raw(row.line);
        CHECK(screen::verdict_words(judgement.verdict) == screen::verdict_words(row.verdict));
        CHECK(judgement.why == row.why);
        CHECK(bench->get(row.value) == row.is);
    }
    Bench bench(screen_from(told_screen));
    for (const char* entry : {"a", "b", "c"})
        CHECK(bench.say_raw("L2 +" + std::string(entry)).verdict == V::ok);
    CHECK(bench.say_raw("L2 +d").why == "entry 4: the list holds 3");
    CHECK(bench->get("l") == "a\nb\nc\n");
}

TEST_CASE("programs are told units, words, what stays shut, bounds, and what was wrong") {
    Bench bench(screen_from(told_screen));
    const auto page = [&] {
        return behaviour::Json::parse(screen::page_json(bench->standpoint(), {}, bench->findings()));
    };
    behaviour::Json told = page();
    CHECK(told["values"]["n"]["unit"] == "mm");
    CHECK(told["values"]["n"]["value"] == 0);
    CHECK_FALSE(told["values"]["n"].contains("name"));
    CHECK(told["values"]["n"]["from"] == "L1, L4");
    CHECK_FALSE(told["values"]["own"].contains("from"));
    CHECK(told["buttons"][0]["path"] == "Far");
    CHECK(told["buttons"][0]["shut"] == "Far stays shut now; it opens when n is 1, and it is 0");
    CHECK(told["buttons"][1]["input"] == behaviour::Json{{"min", -2}, {"max", 2.5}});
    CHECK(told["findings"].empty());
    CHECK(screen::face_json(bench->standpoint())["buttons"][1]["input"]["normally"] == 0.5);
    bench.say_raw("L1 N1 T:abcdefgh;");
    bench.say_raw("L2 +row");
    told = page();
    CHECK(told["values"]["n"]["name"] == "one");
    CHECK_FALSE(told["buttons"][0].contains("shut"));
    CHECK(told["buttons"][1]["row"] == 1);
    CHECK(told["findings"][0]["verdict"] == "cut");
    // No number in JSON, and none that a word stands for.
    for (const char* odd : {"nan", "-inf", "1e20"}) {
        CAPTURE(odd);
        bench.say_raw("L1 N" + std::string(odd) + " T:;");
        told = page();
        CHECK(told["values"]["n"]["value"].is_null() == (std::string_view(odd) != "1e20"));
        CHECK_FALSE(told["values"]["n"].contains("name"));
    }
    CHECK_FALSE(bench->number("t").has_value());
    CHECK_FALSE(bench->number("nothing").has_value());
    CHECK(bench->number("own") == 0);
}

TEST_CASE("rows and numbers to type stand among the controls that programs are told of") {
    Bench bench(screen_from(told_screen));
    bench.say_raw("L2 +row");
    const behaviour::Json told = screen::page_json(screen::scene_of(bench->standpoint()));
    CHECK(told["controls"][1]["name"] == "Row 1");
    CHECK(told["controls"][1]["label"] == "row");
    CHECK(told["controls"][2]["input"] == behaviour::Json{{"min", -2}, {"max", 2.5}});
    CHECK_FALSE(told["controls"][0].contains("input"));
}

TEST_CASE("paths that may be several, rows that are none, and rows and numbers given apart") {
    const auto profile = screen_from(told_screen);
    Bench bench(profile);
    CHECK(screen::resolve_page(*profile, "Same").sentence ==
          "\"Same\" may be \"Far/Same\", \"Other/Same\"; write more of its path");
    CHECK_FALSE(screen::resolve_page(*profile, "Same").page.has_value());
    CHECK(screen::resolve_page(*profile, "other/same").page == profile->find_page("Other/Same"));
    CHECK(screen::resolve_page(*profile, "qqqqqqqqqqqqqqqqqqqqqqqq").sentence ==
          "there is no page \"qqqqqqqqqqqqqqqqqqqqqqqq\"");
    CHECK(bench->show("qqqqqqqqqqqqqqqqqqqqqqqq") == "there is no page \"qqqqqqqqqqqqqqqqqqqqqqqq\"\n");
    bench.say_raw("L2 +x");
    bench.say_raw("L2 +y");
    for (const char* path : {"Row 0", "Row 2x", "Row x", "Go 1"}) {
        CAPTURE(path);
        CHECK(bench.press(path).starts_with("there is no button"));
    }
    CHECK(bench.press("Row 2") == "M1 2");
    CHECK(bench.press("Row 3").find("no such entry in the list shown") != std::string::npos);
    CHECK(bench.press("y") == "M1 2");
    CHECK(bench->press("Row", 2, std::nullopt, bench.now()).sent == std::vector<std::string>{"M1 2"});
    CHECK(bench->press("Type", 0, 1.5, bench.now()).sent == std::vector<std::string>{"M2 1.5"});
    CHECK(bench->press("Type=2", 0, std::nullopt, bench.now()).sent == std::vector<std::string>{"M2 2"});
    CHECK(bench.press("Type=-2.5") == "\"Type\" takes a number from -2 to 2.5; found -2.5");
    CHECK(bench.press("Type=x") == "\"Type\" takes a number from -2 to 2.5; found \"x\"");
    CHECK(bench.press("Far=x").starts_with("there is no button \"Far=x\""));
    CHECK(bench.press("Other/Same/Now") == "");
    CHECK(bench->page().path == "Far/Same");
}

}  // namespace fauxboard::testing
