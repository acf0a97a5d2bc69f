// What people look at beside the fields: a touch screen, the talk, curves, a scenario, what the machine
// draws; and a request as the other end of the line would say it.

#include <fmt/format.h>

#include <array>

#include "emulator/behaviour/wire_text.h"
#include "emulator/control/hub.h"
#include "emulator/control/op_rows.h"
#include "protocol/framing.h"

namespace fauxboard::control {

Json View::press(board::Board& /*board*/, SimTime /*now*/, const Press& /*press*/) {
    throw ControlError(ErrorCode::not_here, "This run knows no touch screen for its board.");
}

}  // namespace fauxboard::control

namespace fauxboard::control::rows {
namespace {

using enum ParamType;

constexpr double most_rows = 10'000;

Answer screen(const Call& call) {
    return Json{{"screen", call.target.view().screen(call.now)}};
}

Answer press(const Call& call) {
    Press touch;
    touch.button = call.at("button").get<std::string>();
    if (const Json* row = call.find("row")) {
        if (!row->is_number_unsigned() || row->get<double>() < 1 || row->get<double>() > most_rows) {
            throw ControlError(ErrorCode::out_of_range,
                               fmt::format("\"row\": {}; expected 1 to {}.", row->dump(), most_rows));
        }
        touch.row = row->get<std::size_t>();
    }
    if (const Json* input = call.find("input")) {
        touch.input = input->get<double>();
    }
    return call.target.view().press(call.board, call.now, touch);
}

/// The bytes of one line, without its end.
std::string line_of(const Json& text) {
    auto bytes = behaviour::to_wire(text.get_ref<const std::string&>());
    if (!bytes || protocol::plain_run(*bytes) != bytes->size() || bytes->size() > protocol::max_line_bytes) {
        throw ControlError(
            ErrorCode::bad_arguments,
            fmt::format("A request is one line of at most {} bytes: no line end, no NUL, characters up "
                        "to U+00FF only.",
                        protocol::max_line_bytes));
    }
    return *std::move(bytes);
}

Answer request(const Call& call) {
    const std::string body = line_of(call.at("line"));
    const bool framed = call.board.profile().line.framing == behaviour::Framing::frames;
    std::string line = framed ? protocol::frame(body) : body;
    while (line.ends_with('\n') || line.ends_with('\r')) {
        line.pop_back();
    }
    call.board.hear(call.now, line);
    return Json::object();
}

Answer talk(const Call& call) {
    return Json{{"lines", call.target.view().talk()}};
}

Answer curves(const Call& call) {
    return call.target.view().curves();
}

Answer scenario(const Call& call) {
    return Json{{"scenario", call.target.view().scenario()}};
}

Answer drawing(const Call& call) {
    call.board.refresh(call.now);
    return Json{{"drawing", call.target.view().drawing(call.board, call.now)}};
}

constexpr std::array press_params{
    Param{"button", text, true, "the end of its path: \"Hotend on\", \"Control/Move/X+ (30mm)\""},
    Param{"row", number, false, "which, where it stands once for each row of a list; 1 is the first"},
    Param{"input", number, false, "what is typed in, where it asks for a number"}};
constexpr std::array request_params{
    Param{"line", text, true, "what it says, without frame and line end: \"M105\""}};

constexpr std::array views_table{
    Op{"screen",
       "what a touch screen on the main line shows now: its page, values and buttons; null without one",
       {},
       screen},
    Op{"press", "touches a button of that screen; answers with what it sent and what it shows then",
       press_params, press, true},
    Op{"request", "the board hears a line on its main line, as if the other end had said it", request_params,
       request, true},
    Op{"talk", "the lines that passed last, oldest first, as the topic traffic tells them", {}, talk},
    Op{"curves", "temperatures, heights and progress over the whole run; the older, the coarser", {}, curves},
    Op{"scenario",
       "the steps of the scenario that is played, and how it stands; null without one",
       {},
       scenario},
    Op{"drawing",
       "what the machine draws: the way of its head in the plane, the picture of its layer; null for none",
       {},
       drawing},
};

}  // namespace

std::span<const Op> view_ops() {
    return views_table;
}

}  // namespace fauxboard::control::rows
