// The screen that shows the board to a person: its page, a picture of it, touches.

#include <fmt/format.h>

#include <array>
#include <chrono>

#include "emulator/control/base64.h"
#include "emulator/control/display.h"
#include "emulator/control/hub.h"
#include "emulator/control/op_rows.h"

namespace fauxboard::control::rows {
namespace {

using enum ParamType;

constexpr SimTime usual_touch{120'000};
constexpr SimTime shortest_touch{1'000};
constexpr SimTime longest_touch = std::chrono::minutes(10);
constexpr double most_pixels = 100'000;

Display& display(const Call& call) {
    Display* found = call.target.display();
    if (found == nullptr) {
        throw ControlError(ErrorCode::not_here,
                           "This board has no screen of its own, and no virtual one is in this process.");
    }
    call.board.refresh(call.now);
    return *found;
}

Answer page(const Call& call) {
    return display(call).page(call.now);
}

Answer screenshot(const Call& call) {
    return Json{{"png", to_base64(display(call).png(call.now))}};
}

int pixel(const Call& call, std::string_view name) {
    const Json* number = call.find(name);
    if (number == nullptr || !number->is_number_integer() || std::abs(number->get<double>()) > most_pixels) {
        throw ControlError(ErrorCode::bad_arguments,
                           fmt::format("\"{}\": expected a whole number of pixels.", name));
    }
    return number->get<int>();
}

Answer touch(const Call& call) {
    Display& here = display(call);
    const SimTime how_long =
        call.find("for") == nullptr ? usual_touch : call.time("for", shortest_touch, longest_touch);
    const Json* control = call.find("control");
    if ((control != nullptr) == (call.find("x") != nullptr || call.find("y") != nullptr)) {
        throw ControlError(ErrorCode::bad_arguments,
                           "Expected \"control\", the name of one, or \"x\" and \"y\", a pixel.");
    }
    const Display::Touched touched =
        control != nullptr ? here.touch(call.now, control->get_ref<const std::string&>(), how_long)
                           : here.touch(call.now, pixel(call, "x"), pixel(call, "y"), how_long);
    if (!touched.why.empty()) {
        throw ControlError(ErrorCode::refused, touched.why);
    }
    if (touched.done <= call.now) {
        return Json::object();
    }
    if (call.hub.held()) {
        call.target.skip(touched.done - call.now);
    }
    call.session.answer_at(touched.done);
    return std::nullopt;
}

constexpr std::array touch_params{
    Param{"control", text, false, "the name of a control of the page that is open, or of the box over it"},
    Param{"x", number, false, "a pixel of the screen, from the left"},
    Param{"y", number, false, "and from the top"},
    Param{"for", time, false, "how long the finger stays (120ms)"}};

constexpr std::array display_table{
    Op{"page",
       "what the board's screen shows: page, title, texts, message box, controls with their places",
       {},
       page},
    Op{"touch", "puts a finger on that screen; answers when it is off again and what comes of it is done",
       touch_params, touch, true},
    Op{"screenshot", "that screen as a picture: \"png\" is a PNG file in base64", {}, screenshot},
};

}  // namespace

std::span<const Op> display_ops() {
    return display_table;
}

}  // namespace fauxboard::control::rows
