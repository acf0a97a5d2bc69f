// What concerns the client and the run: subscribe, unsubscribe, status, quit.

#include <algorithm>
#include <array>
#include <chrono>

#include "emulator/behaviour/nearest.h"
#include "emulator/control/hub.h"
#include "emulator/control/op_rows.h"

namespace fauxboard::control {
namespace {

constexpr std::array topic_table{
    Topic{"state",
          "values of fields: all at first, then those that changed, looked at each `every` of virtual time",
          R"({"event": "state", "t": 12.5, "fields": {"heaters.nozzle.true": 41.7}})"},
    Topic{"traffic", "each line of the wire, as recordings have it; one that was not taken says why",
          R"({"event": "traffic", "t": 12.5, "from": "screen", "line": "N-0 M105*10"})"},
    Topic{
        "notices", "what a person wants to know: a clamped value, an unknown code, a lost message",
        R"({"event": "notice", "t": 12.5, "level": "warning", "text": "M9 is not in the profile; ignored"})"},
    Topic{"link", "somebody came to the tested line, or left it",
          R"({"event": "link", "t": 12.5, "state": "up", "why": "somebody opened /dev/pts/5"})"},
};

}  // namespace

std::span<const Topic> topics() {
    return topic_table;
}

}  // namespace fauxboard::control

namespace fauxboard::control::rows {
namespace {

using enum ParamType;

constexpr SimTime shortest_every = std::chrono::milliseconds(10);
constexpr SimTime longest_every = std::chrono::hours(1);
constexpr SimTime usual_every = std::chrono::milliseconds(500);

void check_topic(const std::string& topic) {
    std::vector<std::string_view> names;
    for (const Topic& each : topics()) {
        names.push_back(each.name);
    }
    if (std::find(names.begin(), names.end(), topic) == names.end()) {
        throw ControlError(ErrorCode::bad_request,
                           "There is no such topic; expected state, traffic, notices or link.",
                           behaviour::nearest(topic, names));
    }
}

Answer subscribe(const Call& call) {
    const auto topic = call.at("topic").get<std::string>();
    check_topic(topic);
    Session::Subscriptions& own = call.session.subscriptions;
    if (topic != "state") {
        if (call.find("fields") != nullptr || call.find("every") != nullptr) {
            throw ControlError(ErrorCode::bad_request,
                               "\"fields\" and \"every\" are for the topic state only.");
        }
        (topic == "traffic" ? own.traffic : topic == "notices" ? own.notices : own.link) = true;
        return Json::object();
    }
    std::vector<Place> places;
    for (const std::string& name : call.names("fields", {})) {
        find_places(call.board, name, places);
    }
    if (call.find("fields") == nullptr) {
        places = all_places(call.board);
    }
    own.every =
        call.find("every") != nullptr ? call.time("every", shortest_every, longest_every) : usual_every;
    own.places = std::move(places);
    own.last.assign(own.places.size(), Json::object());  // which no value is
    own.due = call.now;
    own.state = true;
    return Json::object();
}

Answer unsubscribe(const Call& call) {
    Session::Subscriptions& own = call.session.subscriptions;
    if (call.find("topic") == nullptr) {
        own = {};
        return Json::object();
    }
    const auto topic = call.at("topic").get<std::string>();
    check_topic(topic);
    if (topic == "state") {
        own.state = false;
        own.places.clear();
        own.last.clear();
    } else {
        (topic == "traffic" ? own.traffic : topic == "notices" ? own.notices : own.link) = false;
    }
    return Json::object();
}

Json counters(const board::Board& board) {
    const board::Counters& c = board.counters();
    return {{"lines_received", c.lines_received},
            {"lines_sent", c.lines_sent},
            {"bad_frames", c.bad_frames},
            {"lines_too_long", board.lines_too_long()},
            {"unknown_codes", c.unknown_codes},
            {"unmatched", c.unmatched},
            {"requests_lost", c.requests_lost},
            {"messages_lost", c.messages_lost},
            {"lines_cut", c.lines_cut}};
}

Answer status(const Call& call) {
    const behaviour::Profile& profile = call.board.profile();
    Json out{{"profile", profile.name},
             {"title", profile.title},
             {"t", machine::to_seconds(call.now)},
             {"clients", call.hub.size()}};
    fault::FaultControl* const faults = call.target.faults();
    out["faults"] =
        (faults != nullptr ? faults->list().size() : 0) + call.board.machine().faults.list().size();
    out["counters"] = counters(call.board);
    out.update(call.target.status());
    return out;
}

Answer quit(const Call& call) {
    call.target.quit();
    return Json::object();
}

constexpr std::array subscribe_params{
    Param{"topic", text, true, "one of state, traffic, notices, link"},
    Param{"fields", names, false, "state: as for get; all if left out"},
    Param{"every", time, false, "state: how often to look, 10ms to 1h of virtual time; 500ms if left out"}};
constexpr std::array unsubscribe_params{Param{"topic", text, false, "all if left out"}};

constexpr std::array table{
    Op{"subscribe",
       "from now on this client is told unasked, in lines with \"event\" instead of \"ok\"; a topic anew "
       "replaces its former fields",
       subscribe_params, subscribe},
    Op{"unsubscribe", "no more of that", unsubscribe_params, unsubscribe},
    Op{"status", "profile, virtual time, link, counters, clients, faults", {}, status},
    Op{"quit", "ends the run", {}, quit},
};

}  // namespace

std::span<const Op> session_ops() {
    return table;
}

}  // namespace fauxboard::control::rows
