// What is done to the board: do, world, send, advance.

#include <fmt/format.h>

#include <array>
#include <chrono>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/rule_compiler.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/control/hub.h"
#include "emulator/control/names.h"
#include "emulator/control/op_rows.h"
#include "protocol/framing.h"

namespace fauxboard::control::rows {
namespace {

using behaviour::ActionCall;
using enum ParamType;

constexpr std::size_t most_actions = 64;
constexpr std::size_t most_raw_bytes = 2048;
constexpr SimTime shortest_advance{1};
constexpr SimTime longest_advance = std::chrono::hours(24 * 30);
/// Of all together, so that times stay in range.
constexpr SimTime latest_time = std::chrono::hours(24 * 366 * 100);

// do, world
// -----------------------------------------------------------------------------------------------

[[noreturn]] void unknown_action(const std::string& name) {
    std::vector<std::string_view> names;
    for (const behaviour::ActionInfo& action : behaviour::actions()) {
        names.push_back(action.name);
        if (!action.phrase.empty()) {
            names.push_back(action.phrase);
        }
    }
    throw ControlError(ErrorCode::unknown_action,
                       fmt::format("There is no action \"{}\"; `fauxboard describe actions` lists them.",
                                   name.substr(0, 60)),
                       behaviour::nearest(name, names));
}

/// Names are looked at before the compiler does, for an error of their own.
void check_names(const Json& node) {
    if (node.is_string()) {
        const auto& name = node.get_ref<const std::string&>();
        if (behaviour::find_action(name) == nullptr) {
            unknown_action(name);
        }
    } else if (node.is_object()) {
        for (const auto& [name, arguments] : node.items()) {
            if (behaviour::find_action(name) == nullptr) {
                unknown_action(name);
            }
        }
    } else if (node.is_array()) {
        for (const Json& item : node) {
            if (!item.is_array()) {
                check_names(item);
            }
        }
    }
}

std::vector<ActionCall> compile(const Call& call) {
    const Json& todo = call.at("do");
    check_names(todo);
    const behaviour::Profile& profile = call.board.profile();
    behaviour::Findings findings{call.document, {}};
    behaviour::Names names;
    for (std::size_t i = 0; i < profile.variables.size(); ++i) {
        names.variables.emplace(profile.variables[i].name, i);
    }
    const std::map<std::string, std::size_t, std::less<>> no_frames;  // actions name none
    behaviour::RuleCompiler compiler(findings, names, no_frames, *profile.machine);
    std::vector<ActionCall> calls = compiler.actions(todo, "/do");
    if (!findings.problems.empty()) {
        const behaviour::Problem& problem = findings.problems.front();
        throw ControlError(ErrorCode::bad_arguments, problem.pointer + ": " + problem.message + ".",
                           problem.nearest);
    }
    if (calls.size() > most_actions) {
        throw ControlError(ErrorCode::bad_arguments, fmt::format("{} actions in one request; at most {} fit.",
                                                                 calls.size(), most_actions));
    }
    for (const ActionCall& each : calls) {
        check_bounds(call.board, each);
    }
    return calls;
}

Answer carry_out(const Call& call, const std::vector<ActionCall>& calls) {
    Hub::Listening listening(call.hub);
    for (const ActionCall& each : calls) {
        const std::string refusal = call.board.act(call.now, each);
        if (!refusal.empty()) {
            throw ControlError(ErrorCode::refused, fmt::format("{}: {}.", each.info->name, refusal));
        }
    }
    Json out = Json::object();
    if (!listening.notices.empty()) {
        out["notices"] = listening.notices;
    }
    return out;
}

Answer act_by_phrase(const Call& call, const std::string& phrase) {
    const behaviour::ActionInfo* info = behaviour::find_world_action(phrase);
    if (info == nullptr) {
        unknown_action(phrase);
    }
    for (const behaviour::ArgInfo& arg : info->args) {
        if (arg.required) {
            throw ControlError(ErrorCode::bad_arguments,
                               fmt::format("{} needs \"{}\" ({}): {{\"op\": \"do\", \"do\": {{\"{}\": "
                                           "{{\"{}\": ...}}}}}}.",
                                           info->name, arg.name, arg.help, info->name, arg.name));
        }
    }
    ActionCall each;
    each.info = info;
    each.args.resize(info->args.size());
    return carry_out(call, {each});
}

Answer do_actions(const Call& call) {
    const Json& todo = call.at("do");
    if (todo.is_string() && behaviour::find_world_action(todo.get_ref<const std::string&>()) != nullptr) {
        return act_by_phrase(call, todo.get<std::string>());
    }
    return carry_out(call, compile(call));
}

Answer world(const Call& call) {
    return act_by_phrase(call, call.at("do").get<std::string>());
}

// send
// -----------------------------------------------------------------------------------------------

std::size_t find_frame(const behaviour::Profile& profile, const std::string& name) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < profile.frames.size(); ++i) {
        if (profile.frames[i].name == name) {
            return i;
        }
        names.push_back(profile.frames[i].name);
    }
    throw ControlError(
        ErrorCode::unknown_frame,
        fmt::format("The profile has no frame \"{}\"; it has {}.", name.substr(0, 60), fmt::join(names, " ")),
        behaviour::nearest(name, names));
}

std::string wire_bytes(const Json& text, std::size_t most) {
    auto bytes = behaviour::to_wire(text.get_ref<const std::string&>());
    if (!bytes) {
        throw ControlError(ErrorCode::wrong_type,
                           "The line carries bytes; expected characters up to U+00FF only.");
    }
    if (bytes->size() > most) {
        throw ControlError(ErrorCode::out_of_range,
                           fmt::format("{} bytes are too many; at most {} fit.", bytes->size(), most));
    }
    return *std::move(bytes);
}

Answer send(const Call& call) {
    const Json* frame = call.find("frame");
    const Json* line = call.find("line");
    const Json* raw = call.find("raw");
    if ((frame != nullptr ? 1 : 0) + (line != nullptr ? 1 : 0) + (raw != nullptr ? 1 : 0) != 1) {
        throw ControlError(ErrorCode::bad_request,
                           "send needs one of \"frame\" (a frame of the profile), \"line\" (a line to put "
                           "into a frame) and \"raw\" (bytes as they are).");
    }
    if (frame != nullptr) {
        behaviour::Send entry;
        entry.frame = find_frame(call.board.profile(), frame->get<std::string>());
        call.board.send_frame(call.now, entry);
    } else if (raw != nullptr) {
        call.board.send_raw(call.now, wire_bytes(*raw, most_raw_bytes));
    } else {
        const std::string body = wire_bytes(*line, protocol::max_line_bytes);
        if (protocol::plain_run(body) != body.size()) {
            throw ControlError(ErrorCode::bad_arguments,
                               "A line holds no line end and no NUL; \"raw\" sends any bytes.");
        }
        call.board.send_raw(call.now, protocol::frame(body));
    }
    return Json::object();
}

// hold, advance
// -----------------------------------------------------------------------------------------------

Answer hold(const Call& call) {
    const Json& on = call.at("on");
    if (!on.is_boolean()) {
        throw ControlError(ErrorCode::bad_arguments, "\"on\" is true or false.");
    }
    call.hub.hold(call.session, on.get<bool>());
    return Json::object();
}

Answer advance(const Call& call) {
    const SimTime by = call.time("by", shortest_advance, longest_advance);
    if (call.now + by > latest_time) {
        throw ControlError(ErrorCode::out_of_range,
                           "That would be more than a hundred years of virtual time.");
    }
    call.session.answer_at(call.target.skip(by));
    return std::nullopt;
}

constexpr std::array do_params{
    Param{"do", any, true,
          "an action as in profiles: its name, {\"heater.target\": {\"heater\": \"nozzle\", \"c\": 200}}, a "
          "list of these; or a phrase such as \"filament in\""}};
constexpr std::array world_params{
    Param{"do", text, true, "the phrase, as recordings have it: \"filament in\", \"card out\""}};
constexpr std::array send_params{
    Param{"frame", text, false, "a frame of the profile, by its name"},
    Param{"line", text, false, "a line that is put into a frame: \"L18 P1 S2\""},
    Param{"raw", text, false, "bytes as they are; a line end is added when there is none"}};
constexpr std::array hold_params{Param{"on", any, true, "true: it stands still; false: it goes on"}};
constexpr std::array advance_params{Param{"by", time, true, "1 us to 30 days of virtual time"}};

constexpr std::array machine_table{
    Op{"do", "does something to the machine; when it refuses, actions behind that one in a list are not done",
       do_params, do_actions},
    Op{"world", "does something to the machine by its phrase", world_params, world},
    Op{"send", "sends something to the screen: a frame waits for its tick, line and raw leave at once",
       send_params, send, true},
    Op{"hold",
       "virtual time stands still but for advance and touch, for as long as this client is there and wants "
       "it",
       hold_params, hold, true},
    Op{"advance",
       "virtual time jumps forward, with everything that happens meanwhile; answers when it has got there, "
       "and "
       "this client's further requests wait for that",
       advance_params, advance, true},
};

}  // namespace

std::span<const Op> machine_ops() {
    return machine_table;
}

}  // namespace fauxboard::control::rows
