// What concerns the client and the run: subscribe, unsubscribe, status, quit.

#include <fmt/format.h>

#include <array>
#include <chrono>

#include "emulator/behaviour/nearest.h"
#include "emulator/control/hub.h"
#include "emulator/control/op_rows.h"

namespace fauxboard::control {
namespace {

constexpr std::array topic_table{
    Topic{TopicId::state, "state",
          "values of fields: all at first, then those that changed, looked at each `every` of virtual time",
          R"({"event": "state", "t": 12.5, "fields": {"heaters.nozzle.true": 41.7}})"},
    Topic{
        TopicId::traffic, "traffic",
        "each line of the wire, as recordings have it; one that was not taken says why; with words, if asked",
        R"({"event": "traffic", "t": 12.5, "from": "screen", "line": "N-0 M105*10"})"},
    Topic{
        TopicId::notices, "notices",
        "what a person wants to know: a clamped value, an unknown code, a lost message",
        R"({"event": "notice", "t": 12.5, "level": "warning", "text": "M9 is not in the profile; ignored"})"},
    Topic{TopicId::link, "link", "somebody came to the tested line, or left it",
          R"({"event": "link", "t": 12.5, "state": "up", "why": "somebody opened /dev/pts/5"})"},
    Topic{
        TopicId::spoiled, "spoiled",
        "a fault of the line has acted on this line, which is told as it was before",
        R"({"event": "spoiled", "t": 12.5, "from": "board", "line": "N-0 L7*55", "kind": "drop", "fault": 1})"},
    Topic{
        TopicId::judged, "judged", "a line that a touch screen would not have taken as it was meant, and why",
        R"({"event": "judged", "t": 12.5, "line": "N-0 L18 P26*32", "verdict": "would crash", "why": "..."})"},
    Topic{
        TopicId::screen, "screen",
        "what the touch screen shows, each time it shows something else; as the op screen",
        R"({"event": "screen", "t": 12.5, "screen": {"page": "Main", "title": "Main", "lines": [], "buttons": []}})"},
    Topic{TopicId::scenario, "scenario",
          "how the scenario stands, each time that it gets on; as the op scenario",
          R"({"event": "scenario", "t": 12.5, "scenario": {"name": "home", "steps": [], "branches": []}})"},
    Topic{TopicId::drawing, "drawing", "what the machine draws, as it grows; as the op drawing",
          R"({"event": "drawing", "t": 12.5, "drawing": {"way": {"more": true, "layers": []}}})"},
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

TopicId topic_of(const Call& call) {
    const auto& topic = call.at("topic").get_ref<const std::string&>();
    std::vector<std::string_view> names;
    for (const Topic& each : topics()) {
        if (each.name == topic) {
            return each.id;
        }
        names.push_back(each.name);
    }
    throw ControlError(ErrorCode::bad_request,
                       fmt::format("There is no such topic; expected one of {}.", fmt::join(names, ", ")),
                       behaviour::nearest(topic, names));
}

/// Parameters of one topic alone.
void check_extras(const Call& call, TopicId topic) {
    const bool of_state = call.find("fields") != nullptr || call.find("every") != nullptr;
    if (of_state && topic != TopicId::state) {
        throw ControlError(ErrorCode::bad_request, "\"fields\" and \"every\" are for the topic state only.");
    }
    const Json* words = call.find("words");
    if (words != nullptr && (topic != TopicId::traffic || !words->is_boolean())) {
        throw ControlError(ErrorCode::bad_request,
                           "\"words\" is true or false, and for the topic traffic only.");
    }
}

Answer subscribe(const Call& call) {
    const TopicId topic = topic_of(call);
    check_extras(call, topic);
    Session::Subscriptions& own = call.session.subscriptions;
    if (topic != TopicId::state) {
        own.topics |= bit(topic);
        if (topic == TopicId::traffic) {
            const Json* words = call.find("words");
            own.words = words != nullptr && words->get<bool>();
        }
        call.target.on_wanted();
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
    own.topics |= bit(topic);
    return Json::object();
}

Answer unsubscribe(const Call& call) {
    Session::Subscriptions& own = call.session.subscriptions;
    if (call.find("topic") == nullptr) {
        own = {};
        return Json::object();
    }
    const TopicId topic = topic_of(call);
    own.topics &= ~bit(topic);
    if (topic == TopicId::state) {
        own.places.clear();
        own.last.clear();
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
    Param{"topic", text, true, "one of those below"},
    Param{"fields", names, false, "state: as for get; all if left out"},
    Param{"every", time, false, "state: how often to look, 10ms to 1h of virtual time; 500ms if left out"},
    Param{"words", any, false, "traffic: true adds what each line means"}};
constexpr std::array unsubscribe_params{Param{"topic", text, false, "all if left out"}};

constexpr std::array session_table{
    Op{"subscribe",
       "from now on this client is told unasked, in lines with \"event\" instead of \"ok\"; a topic anew "
       "replaces its former fields",
       subscribe_params, subscribe},
    Op{"unsubscribe", "no more of that", unsubscribe_params, unsubscribe},
    Op{"status", "profile, virtual time, link, counters, clients, faults", {}, status},
    Op{"quit", "ends the run", {}, quit, true},
};

}  // namespace

std::span<const Op> session_ops() {
    return session_table;
}

}  // namespace fauxboard::control::rows
