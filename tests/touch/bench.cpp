#include "tests/touch/bench.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/board_driver.h"

namespace fauxboard::testing {
namespace {

SimTime us(double seconds) {
    return SimTime{std::llround(seconds * 1e6)};
}

board::Options with(board::Front& front) {
    board::Options out;
    out.front = &front;
    return out;
}

}  // namespace

const std::string_view made_up_screen = R"({
  "name": "made-up",
  "display": {
    "width": 200, "height": 100, "background": "FFFFFF",
    "languages": ["English", "Russian"], "language": "tongue", "rotated": "turned",
    "title": { "at": [60, 0, 140, 20], "color": "000000" },
    "box": { "fill": "EEEEEE", "size": 10 }, "caption": { "fill": "006BA7" },
    "touch_x": "touch.x", "touch_y": "touch.y",
    "power_on": [{ "when": {"touch.x": {"min": 180}}, "leads_to": "Secret" }],
    "press": { "assume": {"beeps": "beeps+1"} }
  },
  "looks": { "button": {"fill": "C0C0C0"} },
  "values": {
    "beeps": {}, "held": {}, "tongue": {}, "turned": {}, "delay": {}, "touch.x": {}, "touch.y": {},
    "text": {"kind": "text"}, "number": {}, "off": {},
    "sound": { "field": "addons.sound", "names": {"0": "Off", "1": "On"} }
  },
  "pages": {
    "Main": {
      "title": "MAIN",
      "draw": [{ "text": "{speed.percent:d}%", "at": [0, 80, 100, 20] }],
      "buttons": {
        "Sound": { "at": [0, 20, 50, 20], "label": "Sound {sound:name}", "do": {"set": {"addons.sound": "1-addons.sound"}} },
        "Nothing": { "at": [50, 20, 50, 20], "label": "Nothing" },
        "Dead": { "at": [100, 20, 50, 20], "label": "Dead", "enabled": {"off": 1}, "do": {"set": {"addons.sound": 0}} },
        "Hold": { "at": [150, 20, 50, 20], "label": "Hold", "hold": {"after_ms": 2500, "then": {"assume": {"held": "held+1"}}} },
        "Ask": { "at": [0, 40, 50, 20], "label": "Ask", "leads_to": "Sure?" },
        "Speed": { "at": [50, 40, 50, 20], "label": "Speed", "leads_to": "Number" },
        "Russian": { "at": [100, 40, 50, 20], "label": "Russian", "assume": {"tongue": "1-tongue"} },
        "Turn": { "at": [150, 40, 50, 20], "label": "Turn", "assume": {"turned": "1-turned"} },
        "Saver": { "at": [0, 60, 50, 20], "label": "Saver", "assume": {"delay": 5000} }
      }
    },
    "Number": {
      "title": "SPEED",
      "entry": { "text": "text", "number": "number", "start": "speed.percent", "decimals": 3, "most": 6 },
      "draw": [{ "text": "{text}", "at": [0, 0, 60, 20] }],
      "buttons": {
        "1": { "at": [0, 20, 20, 20], "key": "1" }, "2": { "at": [20, 20, 20, 20], "key": "2" },
        "5": { "at": [40, 20, 20, 20], "key": "5" }, "0": { "at": [60, 20, 20, 20], "key": "0" },
        ".": { "at": [80, 20, 20, 20], "key": "." }, "Erase": { "at": [100, 20, 20, 20], "key": "erase" },
        "AC": { "at": [120, 20, 20, 20], "key": "clear" }, "-/+": { "at": [140, 20, 20, 20], "key": "sign" },
        "OK": { "at": [0, 60, 50, 20], "do": {"set": {"speed.percent": "number"}}, "leads_to": "<back>" },
        "Back": { "at": [50, 60, 50, 20], "leads_to": "<back>" }
      }
    },
    "Secret": { "title": "SECRET" },
    "Saver": { "title": "", "cover": true, "bare": true, "background": "000000", "on_close": { "assume": {"held": 7} } }
  },
  "boxes": {
    "Sure?": { "kind": "yes_no", "caption": "Question", "text": "Really?\nThink.", "yes": {"assume": {"off": 1}, "leads_to": "Done"} },
    "Done": { "kind": "ok", "caption": "Completed", "text": "It is done." },
    "Card": { "kind": "ok", "caption": "Card", "text": "The card is out." }
  },
  "events": {
    "card.removed": { "leads_to": "Card" },
    "card.inserted": { "uncovers": true, "leads_to": "<close>" }
  },
  "idle": { "after_ms": "delay", "then": {"leads_to": "Saver"} },
  "translations": { "Russian": {
    "MAIN": "ГЛАВНАЯ", "Sound {sound:name}": "Звук {sound:name}", "On": "Вкл", "Yes": "Да", "Question": "Вопрос"
  } }
})";

std::shared_ptr<const screen::ScreenProfile> own_screen_from(std::string_view json) {
    return screen::load_screen({"own.json", std::string(json)},
                               [](std::string_view, std::string_view) { return std::nullopt; });
}

std::string wrong_with(std::string_view json) {
    try {
        own_screen_from(json);
    } catch (const behaviour::ProfileError& error) {
        return error.what();
    }
    return {};
}

TouchBench::TouchBench(std::string_view json)
    : TouchBench(shipped_profile("geeetech-a30t"), own_screen_from(json), {}) {}

TouchBench::TouchBench(std::shared_ptr<const behaviour::Profile> profile,
                       std::shared_ptr<const screen::ScreenProfile> own, const machine::Services& services)
    : screen(std::move(own)), board(std::move(profile), services, with(screen)) {
    board.power_on(now);
}

void TouchBench::run_for(double seconds) {
    const SimTime end = now + us(seconds);
    for (SimTime due = board.advance(end); due <= end || !board.output().empty(); due = board.advance(end)) {
        board.clear_output();
    }
    now = end;
}

void TouchBench::tap(int x, int y, double seconds) {
    const auto touched = screen.touch(now, x, y, us(seconds));
    REQUIRE(touched.why.empty());
    run_for(machine::to_seconds(touched.done - now));
}

std::string TouchBench::tap(std::string_view control, double seconds) {
    board.refresh(now);
    const auto touched = screen.touch(now, board.machine(), control, us(seconds));
    if (touched.why.empty()) {
        run_for(machine::to_seconds(touched.done - now));
    }
    return touched.why;
}

void TouchBench::world(std::string_view phrase) {
    REQUIRE(board.world(now, phrase));
    run_for(0.001);
}

double TouchBench::field(std::string_view path) const {
    const behaviour::Field* found = behaviour::find_field(path);
    REQUIRE(found != nullptr);
    return found->get(board.machine()).number;
}

std::string TouchBench::text_field(std::string_view path) const {
    const behaviour::Field* found = behaviour::find_field(path);
    REQUIRE(found != nullptr);
    return std::string(found->get(board.machine()).text);
}

bool TouchBench::run_until_field(std::string_view path, double value, double within_s) {
    constexpr SimTime step{1000};
    const SimTime end = now + us(within_s);
    board.refresh(now);
    while (field(path) != value) {
        if (now >= end) return false;
        // Nothing changes by itself but at the board's own times, and what moves.
        const SimTime due = board.advance(now);
        const SimTime next =
            field("platform.moving") != 0 ? now + step : std::min(std::max(due, now + step), end);
        run_for(machine::to_seconds(next - now));
        board.refresh(now);
    }
    return true;
}

void TouchBench::set(std::string_view path, double value) {
    const behaviour::Field* found = behaviour::find_field(path);
    REQUIRE(found != nullptr);
    board.tinker(now, [&](machine::Machine& machine) {
        static_cast<void>(behaviour::set_field(machine, *found, behaviour::Value::of(value)));
    });
}

screen::Scene TouchBench::scene() {
    board.refresh(now);
    return screen.scene(board.machine());
}

std::string TouchBench::box() {
    const screen::Scene here = scene();
    return here.box ? here.box->caption : "";
}

std::string TouchBench::texts() {
    return join(scene().texts);
}

bool TouchBench::has_text(std::string_view text) {
    const auto all = scene().texts;
    return std::find(all.begin(), all.end(), text) != all.end();
}

}  // namespace fauxboard::testing
