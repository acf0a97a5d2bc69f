// Reading and setting: get, set, describe.

#include <array>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/reference.h"
#include "emulator/control/hub.h"
#include "emulator/control/names.h"
#include "emulator/control/op_rows.h"

namespace fauxboard::control::rows {
namespace {

using enum ParamType;

Answer get(const Call& call) {
    std::vector<Place> places;
    if (call.find("fields") == nullptr) {
        places = all_places(call.board);
    }
    for (const std::string& name : call.names("fields", {})) {
        find_places(call.board, name, places);
    }
    call.board.refresh(call.now);
    return Json{{"t", machine::to_seconds(call.now)}, {"fields", values_of(call.board, places)}};
}

Answer set(const Call& call) {
    std::vector<Place> places;
    std::vector<behaviour::ActionCall> todo;
    for (const auto& [name, value] : call.at("fields").items()) {
        places.push_back(find_place(call.board, name));
        todo.push_back(assignment(call.board, places.back(), value));
    }
    Hub::Listening listening(call.hub);
    for (const behaviour::ActionCall& each : todo) {
        if (const std::string refusal = call.board.act(call.now, each); !refusal.empty()) {
            throw ControlError(ErrorCode::refused, refusal + ".");
        }
    }
    Json out{{"fields", values_of(call.board, places)}};
    if (!listening.notices.empty()) {
        out["notices"] = listening.notices;
    }
    return out;
}

Json frames(const board::Board& board) {
    Json list = Json::array();
    for (const behaviour::Frame& frame : board.profile().frames) {
        list.push_back(frame.name);
    }
    return list;
}

Json variables(const board::Board& board) {
    Json list = Json::array();
    for (const behaviour::VariableInfo& info : board.profile().variables) {
        list.push_back({{"path", "var." + info.name},
                        {"type", "number"},
                        {"min", info.min},
                        {"max", info.max},
                        {"help", info.help}});
    }
    return list;
}

struct Chapter {
    std::string_view name;
    Json (*make)(const board::Board&);
};
constexpr std::array chapters{
    Chapter{"control", [](const board::Board&) { return describe_control(); }},
    Chapter{"fields", [](const board::Board&) { return behaviour::describe_fields(); }},
    Chapter{"variables", variables},
    Chapter{"actions", [](const board::Board&) { return behaviour::describe_actions(); }},
    Chapter{"frames", frames},
    Chapter{"faults", [](const board::Board&) { return fault::describe_kinds(); }},
};

Answer describe(const Call& call) {
    Json out = Json::object();
    std::vector<std::string_view> names;
    for (const Chapter& chapter : chapters) {
        names.push_back(chapter.name);
    }
    for (const std::string& what : call.names("what", {"control"})) {
        const auto hit = std::find(names.begin(), names.end(), what);
        if (hit == names.end()) {
            throw ControlError(ErrorCode::bad_request,
                               "There is nothing to describe of that name; expected control, fields, "
                               "variables, actions, frames or faults.",
                               behaviour::nearest(what, names));
        }
        out[what] = chapters[static_cast<std::size_t>(hit - names.begin())].make(call.board);
    }
    return out;
}

constexpr std::array get_params{Param{
    "fields", names, false,
    "fields, groups of them (\"heaters.nozzle\", \"heaters\") and variables (\"var.NAME\"); all if left "
    "out"}};
constexpr std::array set_params{
    Param{"fields", object, true, "values by field or variable: {\"heaters.bed.target\": 60}"}};
constexpr std::array describe_params{
    Param{"what", names, false, "of control (the default), fields, variables, actions, frames, faults"}};

constexpr std::array values_table{
    Op{"get", "the values of fields, of this moment: {\"t\": ..., \"fields\": {...}}", get_params, get},
    Op{"set", "puts values into fields, all or none of them; answers with the values as they are then",
       set_params, set},
    Op{"describe", "what there is, from the tables in the code: names, types, units, bounds", describe_params,
       describe},
};

}  // namespace

std::span<const Op> value_ops() {
    return values_table;
}

}  // namespace fauxboard::control::rows
